# The VTK modules: Meniscus, described by the top-level vtk.module with Module/CMakeLists.txt as its
# body, and for ParaView a second one with the representation.

set(_meniscus_module_files "${CMAKE_CURRENT_SOURCE_DIR}/vtk.module")
if (MENISCUS_BUILD_PARAVIEW_PLUGIN)
  list(APPEND _meniscus_module_files
    "${CMAKE_CURRENT_SOURCE_DIR}/Plugin/Representations/vtk.module")
  # In the plugin's folder, under another name than the library for plain VTK.
  set(MENISCUS_PLUGIN_DIR "${CMAKE_INSTALL_LIBDIR}/${PARAVIEW_PLUGIN_SUBDIR}")
  list(PREPEND CMAKE_INSTALL_RPATH "$ORIGIN")
  set(_meniscus_host_arguments
    INSTALL_HEADERS     OFF
    LIBRARY_DESTINATION "${MENISCUS_PLUGIN_DIR}/Meniscus"
    LIBRARY_NAME_SUFFIX "pv${ParaView_VERSION_SIMPLE}")
else ()
  set(_meniscus_host_arguments
    INSTALL_EXPORT      Meniscus
    INSTALL_HEADERS     ON
    HEADERS_DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/meniscus"
    CMAKE_DESTINATION   "${MENISCUS_CMAKE_DIR}"
    LIBRARY_NAME_SUFFIX "")
endif ()

vtk_module_scan(
  MODULE_FILES            ${_meniscus_module_files}
  REQUEST_MODULES         Meniscus::Meniscus Meniscus::Representations
  PROVIDES_MODULES        _meniscus_modules
  HIDE_MODULES_FROM_CACHE ON)

# vtk_module_build adds the folder of vtk.module as a subdirectory, which is the source root that is
# being configured. Point it to the folder of the body instead (private property, stable 9.1 to
# 9.6).
set_property(GLOBAL PROPERTY "_vtk_module_Meniscus::Meniscus_file"
  "${CMAKE_CURRENT_SOURCE_DIR}/Module/vtk.module")
if (MENISCUS_BUILD_PARAVIEW_PLUGIN)
  # The plugin's target must be called Meniscus, as the plugin is (likewise a private property).
  set_property(GLOBAL PROPERTY "_vtk_module_Meniscus::Meniscus_target_name" MeniscusModule)
endif ()

# A wheel has copies instead of links, so that a library with versions would be in it twice.
if (NOT SKBUILD)
  list(APPEND _meniscus_host_arguments
    VERSION   "${PROJECT_VERSION}"
    SOVERSION "${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}")
endif ()

vtk_module_build(
  MODULES ${_meniscus_modules}
  PACKAGE Meniscus
  ${_meniscus_host_arguments})
