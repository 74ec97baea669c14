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
set(CMAKE_INSTALL_RPATH "$ORIGIN/${_meniscus_python_to_library}" ${_meniscus_install_rpath})
vtk_module_wrap_python(
  MODULES            ${_meniscus_modules}
  TARGET             Meniscus::Python
  PYTHON_PACKAGE     meniscus
  MODULE_DESTINATION "${MENISCUS_PYTHON_DIR}"
  BUILD_STATIC       OFF
  INSTALL_HEADERS    OFF)
set(CMAKE_INSTALL_RPATH "${_meniscus_install_rpath}")

# Versions of VTK with the same layout of classes, with which the package may be loaded.
set(MENISCUS_VTK_VERSIONS "${VTK_VERSION}" CACHE STRING "Versions of VTK that the package accepts")
mark_as_advanced(MENISCUS_VTK_VERSIONS)
list(JOIN MENISCUS_VTK_VERSIONS " or " MENISCUS_VTK_VERSIONS_TEXT)
# Message of the package if it finds another VTK.
if (VTK_DIR MATCHES "/vtk_sdk/")
  list(GET MENISCUS_VTK_VERSIONS 0 _meniscus_vtk)
  set(MENISCUS_VTK_HINT "run pip install vtk==${_meniscus_vtk}")
else ()
  string(CONCAT MENISCUS_VTK_HINT "use that of ${Python3_EXECUTABLE}; in a virtual environment use "
    "--system-site-packages and install no other vtk")
endif ()
set(_meniscus_package "${MENISCUS_BUILD_PYTHONPATH}/meniscus")
configure_file("${PROJECT_SOURCE_DIR}/Python/__init__.py.in"
  "${_meniscus_package}/__init__.py" @ONLY)
# All modules of the package, also for its installation.
file(GLOB _meniscus_sources RELATIVE "${PROJECT_SOURCE_DIR}/Python" CONFIGURE_DEPENDS
  "${PROJECT_SOURCE_DIR}/Python/*.py" "${PROJECT_SOURCE_DIR}/Python/api/*.py"
  "${PROJECT_SOURCE_DIR}/Python/viewer/*.py")
list(REMOVE_ITEM _meniscus_sources make_stubs.py)
foreach (_meniscus_source IN LISTS _meniscus_sources)
  configure_file("${PROJECT_SOURCE_DIR}/Python/${_meniscus_source}"
    "${_meniscus_package}/${_meniscus_source}" COPYONLY)
  get_filename_component(_meniscus_folder "${_meniscus_source}" DIRECTORY)
  install(
    FILES       "${PROJECT_SOURCE_DIR}/Python/${_meniscus_source}"
    DESTINATION "${MENISCUS_PYTHON_DIR}/meniscus/${_meniscus_folder}"
    COMPONENT   python)
endforeach ()

# VTK 9.7 has renamed the targets of its wrappers.
set(_meniscus_wrappers vtkMeniscusPython)
if (TARGET PyvtkMeniscusPython)
  set(_meniscus_wrappers PyvtkMeniscusPython)
endif ()

# Types for editors and type checkers, from the signatures that the wrappers put into doc strings.
set(_meniscus_stubs "${_meniscus_package}/vtkMeniscus.pyi")
file(WRITE "${_meniscus_package}/py.typed" "")
add_custom_command(
  OUTPUT  "${_meniscus_stubs}"
  COMMAND "${CMAKE_COMMAND}" -E env "PYTHONPATH=${MENISCUS_BUILD_PYTHONPATH}"
    "${Python3_EXECUTABLE}" -B "${PROJECT_SOURCE_DIR}/Python/make_stubs.py" "${_meniscus_stubs}"
  DEPENDS "${_meniscus_wrappers}" "${PROJECT_SOURCE_DIR}/Python/make_stubs.py"
  COMMENT "Writing vtkMeniscus.pyi"
  VERBATIM)
add_custom_target(meniscus_stubs ALL DEPENDS "${_meniscus_stubs}")
install(
  FILES
    "${_meniscus_package}/__init__.py"
    "${_meniscus_package}/py.typed"
    "${_meniscus_stubs}"
  DESTINATION "${MENISCUS_PYTHON_DIR}/meniscus"
  COMPONENT   python)
# The command `meniscus`; in a wheel it is an entry point.
if (NOT SKBUILD)
  install(
    PROGRAMS    "${PROJECT_SOURCE_DIR}/Python/meniscus-command"
    DESTINATION "${CMAKE_INSTALL_BINDIR}"
    RENAME      meniscus
    COMPONENT   python)
endif ()
