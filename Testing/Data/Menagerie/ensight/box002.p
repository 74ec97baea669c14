p
part
         1
hexa8
 0.00000e+00
 1.00000e+00
