# Installs into a prefix inside the build tree (with a space in its name, as users have them) and
# builds Testing/Consumer against it: a project that knows nothing but find_package(Meniscus).
set(MENISCUS_TEST_PREFIX "${CMAKE_BINARY_DIR}/Testing/installed prefix")
set(_consumer_dir "${CMAKE_BINARY_DIR}/Testing/Consumer")

add_test(
  NAME Installed.Install
  COMMAND "${CMAKE_COMMAND}"
    "-DBUILD_DIR=${CMAKE_BINARY_DIR}"
    "-DPREFIX=${MENISCUS_TEST_PREFIX}"
    -P "${CMAKE_CURRENT_SOURCE_DIR}/InstallFresh.cmake")
set_tests_properties(Installed.Install PROPERTIES
  LABELS         consumer
  FIXTURES_SETUP installed)

add_test(
  NAME Installed.Consumer
  COMMAND "${CMAKE_CTEST_COMMAND}"
    --build-and-test "${CMAKE_CURRENT_SOURCE_DIR}/Consumer" "${_consumer_dir}"
    --build-generator "${CMAKE_GENERATOR}"
    --build-options
      "-DCMAKE_PREFIX_PATH=${MENISCUS_TEST_PREFIX}"
      "-DVTK_DIR=${VTK_DIR}"
      "-DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER}"
      "-DCMAKE_BUILD_TYPE=${CMAKE_BUILD_TYPE}"
      "-DDOCUMENTATION=${PROJECT_SOURCE_DIR}"
    --test-command "${CMAKE_CTEST_COMMAND}" --output-on-failure --no-tests=error)
set_tests_properties(Installed.Consumer PROPERTIES
  LABELS            consumer
  FIXTURES_REQUIRED installed
  TIMEOUT           600)

# The command of a prefix in which Python looks for no packages.
if (MENISCUS_WRAP_PYTHON)
  add_test(NAME Installed.Command COMMAND "${MENISCUS_TEST_PREFIX}/bin/meniscus" --version)
  set_tests_properties(Installed.Command PROPERTIES
    LABELS            consumer
    FIXTURES_REQUIRED installed
    ENVIRONMENT       "PYTHONPATH=")
endif ()

# As a part of VTK's own build: configures the project of scripts/remote, and checks that vtk.module
# names all modules that the classes use. An installed VTK, with all headers in one folder, does not
# check that.
add_test(NAME Remote.Configure
  COMMAND "${PROJECT_SOURCE_DIR}/scripts/remote" --configure)
set_tests_properties(Remote.Configure PROPERTIES LABELS consumer TIMEOUT 120)
get_property(_hierarchy TARGET VTK::CommonCore PROPERTY INTERFACE_vtk_module_hierarchy)
if (_hierarchy)
  get_filename_component(_hierarchy "${_hierarchy}" DIRECTORY)
  add_test(NAME Remote.Modules
    COMMAND "${Python3_EXECUTABLE}" -B "${CMAKE_CURRENT_SOURCE_DIR}/Remote/CheckModules.py"
      "${PROJECT_SOURCE_DIR}" "${_hierarchy}" "${VTK_DIR}/VTK-vtk-module-properties.cmake")
  set_tests_properties(Remote.Modules PROPERTIES LABELS consumer)
endif ()
