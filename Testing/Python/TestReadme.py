# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""The README's Python example, in a process of its own, writes a picture that shows something."""
import os
import subprocess
import sys

from vtkmodules.vtkIOImage import vtkPNGReader

# Of [0, 255]; an empty picture spans nothing.
LEAST_CONTRAST = 50

if os.path.exists("volume.png"):
    os.remove("volume.png")
subprocess.run([sys.executable, "-B", "readme.py"], check=True)
reader = vtkPNGReader()
reader.SetFileName("volume.png")
reader.Update()
low, high = reader.GetOutput().GetScalarRange()
print("volume.png: values %g to %g" % (low, high))
if high - low < LEAST_CONTRAST:
    sys.exit("the README's picture shows nothing")
