# The ParaView plugin Meniscus, over the modules that MeniscusModule.cmake has built.
paraview_plugin_scan(
  PLUGIN_FILES     "${CMAKE_CURRENT_SOURCE_DIR}/Plugin/paraview.plugin"
  PROVIDES_PLUGINS _meniscus_plugins
  ENABLE_BY_DEFAULT ON
  HIDE_PLUGINS_FROM_CACHE ON)
paraview_plugin_build(
  PLUGINS              ${_meniscus_plugins}
  LIBRARY_SUBDIRECTORY "${PARAVIEW_PLUGIN_SUBDIR}"
  INSTALL_HEADERS      OFF)
if (MENISCUS_BUILD_TESTING)
  add_subdirectory(Testing/Plugin)
endif ()
