# Debian packages, by `cpack` in a build folder: the library, its development files and the Python
# package, or, in the build of the plugin, the plugin. scripts/package makes all of them.
set(CPACK_GENERATOR "DEB")
set(CPACK_PACKAGE_VENDOR "the Meniscus authors")
set(CPACK_PACKAGE_CONTACT "the Meniscus authors <meniscus@example.org>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY
  "Ray casting of tetrahedral meshes and geometry behind refracting surfaces")
set(CPACK_PACKAGE_VERSION "${PROJECT_VERSION}")
set(CPACK_RESOURCE_FILE_LICENSE "${PROJECT_SOURCE_DIR}/LICENSE")
set(CPACK_PACKAGING_INSTALL_PREFIX "/usr")
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS "${CMAKE_LIBRARY_OUTPUT_DIRECTORY}")
set(CPACK_DEB_COMPONENT_INSTALL ON)

if (MENISCUS_BUILD_PARAVIEW_PLUGIN)
  set(CPACK_PACKAGE_NAME paraview-meniscus)
  # The plugin and its library are one package. ParaView 5.11 installs the plugin itself
  # without a component.
  set(CPACK_COMPONENTS_ALL runtime Unspecified)
  set(CPACK_COMPONENTS_GROUPING ALL_COMPONENTS_IN_ONE)
  set(CPACK_DEBIAN_PACKAGE_NAME paraview-meniscus)
  math(EXPR _next_minor "${ParaView_VERSION_MINOR} + 1")
  set(CPACK_DEBIAN_PACKAGE_DEPENDS "paraview (>= ${ParaView_VERSION_SIMPLE}), \
paraview (<< ${ParaView_VERSION_MAJOR}.${_next_minor})")
  set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${CPACK_PACKAGE_DESCRIPTION_SUMMARY} (ParaView plugin)")
else ()
  set(_abi "${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}")
  set(CPACK_PACKAGE_NAME meniscus)
  set(CPACK_COMPONENTS_ALL runtime development python)
  set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME "libmeniscus${_abi}")
  set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libmeniscus-dev)
  set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
  set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
    "libmeniscus${_abi} (= ${PROJECT_VERSION}), libvtk9-dev")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-meniscus)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
    "libmeniscus${_abi} (= ${PROJECT_VERSION}), python3-vtk9")
  set(CPACK_COMPONENT_RUNTIME_DESCRIPTION "${CPACK_PACKAGE_DESCRIPTION_SUMMARY} (library)")
  set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "${CPACK_PACKAGE_DESCRIPTION_SUMMARY} (headers)")
  set(CPACK_COMPONENT_PYTHON_DESCRIPTION "${CPACK_PACKAGE_DESCRIPTION_SUMMARY} (Python)")
endif ()
include(CPack)
