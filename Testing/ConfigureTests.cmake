# Messages of a build if a required package is missing: configures again as if it were missing.

# meniscus_add_configure_test(NAME MESSAGE CMAKE_ARGUMENT...)
function (meniscus_add_configure_test name message)
  set(folder "${CMAKE_BINARY_DIR}/Testing/Configure/${name}")
  add_test(
    NAME "Configure.${name}"
    COMMAND "${CMAKE_COMMAND}" -S "${PROJECT_SOURCE_DIR}" -B "${folder}" -G "${CMAKE_GENERATOR}"
      "-DVTK_DIR=${VTK_DIR}" -DMENISCUS_BUILD_TESTING=OFF -DMENISCUS_BUILD_EXAMPLES=OFF
      -DMENISCUS_WRAP_PYTHON=OFF ${ARGN})
  set_tests_properties("Configure.${name}" PROPERTIES
    LABELS                  consumer
    TIMEOUT                 120
    PASS_REGULAR_EXPRESSION "${message}")
endfunction ()

meniscus_add_configure_test(NoOpenMesh "apt-get[ \n]+install[ \n]+libopenmesh-dev"
  -DCMAKE_DISABLE_FIND_PACKAGE_OpenMesh=ON)
meniscus_add_configure_test(NoGLM "apt-get[ \n]+install[ \n]+libglm-dev"
  -DCMAKE_DISABLE_FIND_PACKAGE_glm=ON)
meniscus_add_configure_test(NoTetGen "MENISCUS_WITH_TETGEN[ \n]+needs[ \n]+TetGen"
  -DMENISCUS_BUILD_BENCHMARKS=ON -DMENISCUS_WITH_TETGEN=ON -DTETGEN_LIBRARY=)
