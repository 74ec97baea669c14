# A wheel of Python, and a VTK that may itself be one: VTK's wheel SDK (the package vtk-sdk) has the
# headers, the CMake package and the wrapping tools that belong to the libraries of the wheel vtk.

# The libraries of VTK are in a folder next to the package if they come as a wheel.
list(APPEND CMAKE_INSTALL_RPATH "$ORIGIN/../vtkmodules")

# VTK's wheels for Linux are built with the old std::string of libstdc++. Libraries that link to
# them must use the same one.
include(CheckCXXSourceCompiles)
set(_meniscus_strings [[
#include <vtkInformation.h>
#include <vtkInformationStringKey.h>
#include <string>
int main()
{
  vtkInformation::New()->Set(static_cast<vtkInformationStringKey*>(nullptr), std::string());
}]])
set(CMAKE_REQUIRED_LIBRARIES VTK::CommonCore)
check_cxx_source_compiles("${_meniscus_strings}" MENISCUS_VTK_HAS_OUR_STRINGS)
if (NOT MENISCUS_VTK_HAS_OUR_STRINGS)
  set(CMAKE_REQUIRED_DEFINITIONS -D_GLIBCXX_USE_CXX11_ABI=0)
  check_cxx_source_compiles("${_meniscus_strings}" MENISCUS_VTK_HAS_OLD_STRINGS)
  unset(CMAKE_REQUIRED_DEFINITIONS)
  if (NOT MENISCUS_VTK_HAS_OLD_STRINGS)
    message(FATAL_ERROR "No program can be linked with the VTK of ${VTK_DIR}; see CMakeError.log")
  endif ()
  add_compile_definitions(_GLIBCXX_USE_CXX11_ABI=0)
endif ()
unset(CMAKE_REQUIRED_LIBRARIES)
