# The Python package `meniscus`, in the build tree under lib/python3/dist-packages and installed
# under the same path; in a wheel at its top, with the library inside the package.
set(MENISCUS_PYTHON_DIR "lib/python3/dist-packages")
if (SKBUILD)
  set(MENISCUS_PYTHON_DIR ".")
endif ()
set(MENISCUS_BUILD_PYTHONPATH "${CMAKE_BINARY_DIR}/${MENISCUS_PYTHON_DIR}")

file(RELATIVE_PATH _meniscus_python_to_library
  "/prefix/${MENISCUS_PYTHON_DIR}/meniscus" "/prefix/${CMAKE_INSTALL_LIBDIR}")
set(_meniscus_install_rpath "${CMAKE_INSTALL_RPATH}")
set(CMAKE_INSTALL_RPATH "$ORIGIN/${_meniscus_python_to_library}")
vtk_module_wrap_python(
  MODULES            ${_meniscus_modules}
  TARGET             Meniscus::Python
  PYTHON_PACKAGE     meniscus
  MODULE_DESTINATION "${MENISCUS_PYTHON_DIR}"
  BUILD_STATIC       OFF
  INSTALL_HEADERS    OFF)
set(CMAKE_INSTALL_RPATH "${_meniscus_install_rpath}")

configure_file("${CMAKE_CURRENT_LIST_DIR}/__init__.py.in"
  "${MENISCUS_BUILD_PYTHONPATH}/meniscus/__init__.py" @ONLY)
install(
  FILES       "${MENISCUS_BUILD_PYTHONPATH}/meniscus/__init__.py"
  DESTINATION "${MENISCUS_PYTHON_DIR}/meniscus"
  COMPONENT   python)

# Types for editors and type checkers, from the signatures that the wrappers put into doc strings.
set(_meniscus_stubs "${MENISCUS_BUILD_PYTHONPATH}/meniscus/vtkMeniscus.pyi")
file(WRITE "${MENISCUS_BUILD_PYTHONPATH}/meniscus/py.typed" "")
add_custom_command(
  OUTPUT  "${_meniscus_stubs}"
  COMMAND "${CMAKE_COMMAND}" -E env "PYTHONPATH=${MENISCUS_BUILD_PYTHONPATH}"
    "${Python3_EXECUTABLE}" -B "${CMAKE_CURRENT_LIST_DIR}/make_stubs.py" "${_meniscus_stubs}"
  DEPENDS vtkMeniscusPython "${CMAKE_CURRENT_LIST_DIR}/make_stubs.py"
  COMMENT "Writing vtkMeniscus.pyi"
  VERBATIM)
add_custom_target(meniscus_stubs ALL DEPENDS "${_meniscus_stubs}")
install(
  FILES       "${_meniscus_stubs}" "${MENISCUS_BUILD_PYTHONPATH}/meniscus/py.typed"
  DESTINATION "${MENISCUS_PYTHON_DIR}/meniscus"
  COMPONENT   python)
