# cmake -DBUILD_DIR=... -DPREFIX=... -P InstallFresh.cmake: installs into an empty PREFIX, so that
# nothing left from an earlier version hides a missing file.
file(REMOVE_RECURSE "${PREFIX}")
execute_process(
  COMMAND "${CMAKE_COMMAND}" --install "${BUILD_DIR}" --prefix "${PREFIX}"
  RESULT_VARIABLE result)
if (result)
  message(FATAL_ERROR "cmake --install failed: ${result}")
endif ()
