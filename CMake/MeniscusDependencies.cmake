# Scans vtk.module and finds the packages that it and the kernel need.

if (NOT DEFINED MENISCUS_VTK_COMPONENTS)
  set(MENISCUS_VTK_COMPONENTS
    CommonCore CommonDataModel CommonExecutionModel CommonMath CommonTransforms FiltersCore
    FiltersGeneral RenderingCore RenderingVolume RenderingOpenGL2)
endif ()
set(_meniscus_test_components
  FiltersSources ImagingCore InteractionStyle IOImage IOXML RenderingVolumeOpenGL2 TestingCore
  TestingRendering)
find_package(VTK 9.1 REQUIRED COMPONENTS ${MENISCUS_VTK_COMPONENTS}
  OPTIONAL_COMPONENTS ${_meniscus_test_components})
find_package(glm REQUIRED)
find_package(OpenMesh REQUIRED)
