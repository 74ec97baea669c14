# Files that find_package(Meniscus) reads, in the build tree and installed.
include(CMakePackageConfigHelpers)

configure_file("${CMAKE_CURRENT_LIST_DIR}/MeniscusConfig.cmake.in"
  "${CMAKE_BINARY_DIR}/${MENISCUS_CMAKE_DIR}/MeniscusConfig.cmake" @ONLY)
write_basic_package_version_file(
  "${CMAKE_BINARY_DIR}/${MENISCUS_CMAKE_DIR}/MeniscusConfigVersion.cmake"
  VERSION       "${PROJECT_VERSION}"
  COMPATIBILITY SameMinorVersion)
install(
  FILES
    "${CMAKE_BINARY_DIR}/${MENISCUS_CMAKE_DIR}/MeniscusConfig.cmake"
    "${CMAKE_BINARY_DIR}/${MENISCUS_CMAKE_DIR}/MeniscusConfigVersion.cmake"
  DESTINATION "${MENISCUS_CMAKE_DIR}"
  COMPONENT   development)
vtk_module_export_find_packages(
  CMAKE_DESTINATION "${MENISCUS_CMAKE_DIR}"
  FILE_NAME         "Meniscus-vtk-module-find-packages.cmake"
  MODULES           ${_meniscus_modules})
