# Finds VTK (or ParaView, which brings its own VTK) with the modules that vtk.module names, and the
# libraries of the kernel.

# VTK's wrappers load into one Python only. Debian's VTK is built for the system's, which is not
# always the first in PATH.
find_program(Python3_EXECUTABLE NAMES python3 PATHS /usr/bin NO_DEFAULT_PATH)

# Reads the VTK component names that follow the given keywords of the top-level vtk.module, so that
# they are listed in one place only.
function (meniscus_module_components output)
  file(STRINGS "${CMAKE_CURRENT_SOURCE_DIR}/vtk.module" lines)
  set(components)
  set(keyword)
  foreach (line IN LISTS lines)
    if (line MATCHES "^([A-Z_]+)$")
      set(keyword "${line}")
    elseif (keyword IN_LIST ARGN AND line MATCHES "^ +VTK::([A-Za-z0-9]+)$")
      list(APPEND components "${CMAKE_MATCH_1}")
    endif ()
  endforeach ()
  set("${output}" "${components}" PARENT_SCOPE)
endfunction ()

# meniscus_find(PACKAGE DEBIAN_PACKAGE): finds the package, or reports how to install it.
macro (meniscus_find package debian)
  find_package("${package}" QUIET)
  if (NOT ${package}_FOUND)
    message(FATAL_ERROR
      "Meniscus needs ${package}, which was not found. On Debian: apt-get install "
      "${debian}; elsewhere set CMAKE_PREFIX_PATH or ${package}_DIR to its location.")
  endif ()
endmacro ()

meniscus_module_components(MENISCUS_VTK_COMPONENTS DEPENDS PRIVATE_DEPENDS)
# Modules that only some versions of VTK have: VTK::opengl, up to 9.3.
meniscus_module_components(_meniscus_optional_components OPTIONAL_DEPENDS)
meniscus_module_components(_meniscus_test_components TEST_DEPENDS)

if (MENISCUS_BUILD_PARAVIEW_PLUGIN)
  # ParaView's package uses Python's targets without finding them.
  find_package(Python3 REQUIRED COMPONENTS Interpreter Development)
  find_package(ParaView 5.11 REQUIRED COMPONENTS RemotingViews WrapClientServer ProcessXML)
  # ParaView's own VTK or the one that it was built with, which ParaView has put into VTK_DIR. The
  # package of 5.13 does not look for HDF5 and netCDF on behalf of its other modules.
  find_package(VTK REQUIRED COMPONENTS ${MENISCUS_VTK_COMPONENTS}
    OPTIONAL_COMPONENTS ${_meniscus_optional_components} hdf5 netcdf)
else ()
  find_package(VTK 9.1 REQUIRED COMPONENTS ${MENISCUS_VTK_COMPONENTS}
    OPTIONAL_COMPONENTS ${_meniscus_optional_components} ${_meniscus_test_components}
      WrappingTools Python WrappingPythonCore)
  option(MENISCUS_WRAP_PYTHON "Build the Python package" "${VTK_WRAP_PYTHON}")
endif ()
foreach (_meniscus_component IN LISTS _meniscus_optional_components)
  if (TARGET "VTK::${_meniscus_component}")
    list(APPEND MENISCUS_VTK_COMPONENTS "${_meniscus_component}")
  endif ()
endforeach ()
meniscus_find(glm libglm-dev)
meniscus_find(OpenMesh libopenmesh-dev)
# The kernel's benchmark draws the scenes of its tests.
if ((MENISCUS_BUILD_TESTING OR MENISCUS_BUILD_BENCHMARKS) AND NOT MENISCUS_BUILD_PARAVIEW_PLUGIN)
  meniscus_find(GTest libgtest-dev)
  include(GoogleTest)
endif ()
