# The VTK module. Its description is the top-level vtk.module; its body is Module/CMakeLists.txt.

set(_meniscus_module_files "${CMAKE_CURRENT_SOURCE_DIR}/vtk.module")
vtk_module_scan(
  MODULE_FILES     ${_meniscus_module_files}
  REQUEST_MODULES  Meniscus::Meniscus
  PROVIDES_MODULES _meniscus_modules)

# vtk_module_build adds the folder of vtk.module as a subdirectory, which is the source root that is
# being configured. Point it to the folder of the body instead (private property, stable 9.1 to 9.5).
set_property(GLOBAL PROPERTY "_vtk_module_Meniscus::Meniscus_file"
  "${CMAKE_CURRENT_SOURCE_DIR}/Module/vtk.module")

vtk_module_build(
  MODULES             ${_meniscus_modules}
  PACKAGE             Meniscus
  INSTALL_EXPORT      Meniscus
  INSTALL_HEADERS     ON
  HEADERS_DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/meniscus"
  CMAKE_DESTINATION   "${CMAKE_INSTALL_LIBDIR}/cmake/Meniscus"
  LIBRARY_NAME_SUFFIX ""
  VERSION             "${PROJECT_VERSION}"
  SOVERSION           "${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}")
