# The blend modes, one line each. From these lines the build makes the enumeration and the table of
# BlendModels.h, the dispatch to packet models and to parts of the shader, and the list of ParaView.
# Documentation/extending.md lists the other parts of a mode.
#
# meniscus_blend_mode(NAME NUMBER LABEL MODEL PART OPACITY VISIBLE KEPT SUBJECT)
#   NAME     enumerator of BlendMode; shaders know it as NAME in capitals
#   NUMBER   number in vtkVolumeMapper::BlendModes, or from 1000 on if VTK has no such mode;
#            ascending
#   LABEL    name for people
#   MODEL    class template in Module/Volume/Packet/Models/<MODEL>.h
#   PART     optical model of the shader: Rendering/glsl/vtkTetrahedra<PART>.glsl
#   OPACITY, VISIBLE, KEPT, SUBJECT   see BlendModel in BlendModels.h
set(meniscus_blend_mode_entries)
set(meniscus_blend_mode_models)
set(meniscus_blend_mode_parts)
set(meniscus_blend_mode_xml)

macro (meniscus_blend_mode name number label model part opacity visible kept subject)
  string(APPEND meniscus_blend_mode_entries
    "  MODE(${name}, ${number}, \"${label}\", ${model}, ${part}, ${opacity}, ${visible}, ${kept}, "
    "${subject}) \\\n")
  list(APPEND meniscus_blend_mode_models "${model}")
  list(APPEND meniscus_blend_mode_parts "${part}")
  string(APPEND meniscus_blend_mode_xml
    "          <Entry value=\"${number}\" text=\"${label}\"/>\n")
endmacro ()

meniscus_blend_mode(Composite 0 "Composite"
  CompositeModel Composite Attenuation Attenuation Color Medium)
meniscus_blend_mode(MaximumIntensity 1 "Maximum intensity"
  IntensityProjectionModel Projection Alpha Everything Largest Scalars)
meniscus_blend_mode(MinimumIntensity 2 "Minimum intensity"
  IntensityProjectionModel Projection Alpha Everything Smallest Scalars)
meniscus_blend_mode(AverageIntensity 3 "Average intensity"
  IntensityProjectionModel Projection Alpha Everything Sum Scalars)
meniscus_blend_mode(Additive 4 "Additive"
  IntensityProjectionModel Projection Attenuation Everything Sum Scalars)
meniscus_blend_mode(Isosurfaces 5 "Isosurface"
  IsosurfaceModel Isosurfaces Alpha Isovalues Color Surfaces)

list(REMOVE_DUPLICATES meniscus_blend_mode_models)
list(REMOVE_DUPLICATES meniscus_blend_mode_parts)
