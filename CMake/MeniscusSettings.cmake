# Language level, output layout and the flags of our own targets.

if (NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif ()
set(CMAKE_CXX_STANDARD 17)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_CXX_VISIBILITY_PRESET hidden)
set(CMAKE_VISIBILITY_INLINES_HIDDEN ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/${CMAKE_INSTALL_BINDIR}")
set(CMAKE_LIBRARY_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/${CMAKE_INSTALL_LIBDIR}")
set(CMAKE_ARCHIVE_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/${CMAKE_INSTALL_LIBDIR}")
set(CMAKE_INSTALL_RPATH_USE_LINK_PATH ON)
if (SKBUILD) # a wheel: everything in the package, where its module finds the library
  set(CMAKE_INSTALL_LIBDIR meniscus)
endif ()
set(MENISCUS_CMAKE_DIR "${CMAKE_INSTALL_LIBDIR}/cmake/Meniscus")

option(MENISCUS_WARNINGS_AS_ERRORS "Treat warnings in our own code as errors" OFF)
set(MENISCUS_SANITIZER "" CACHE STRING
  "Sanitizers for our own targets, as -fsanitize takes them: address,undefined or thread")
option(MENISCUS_CLANG_TIDY "Run clang-tidy on our own targets while they compile" OFF)
if (MENISCUS_CLANG_TIDY)
  find_program(MENISCUS_CLANG_TIDY_EXECUTABLE NAMES clang-tidy clang-tidy-14 REQUIRED)
endif ()

# Applies the project's warning and sanitizer flags to a target of ours. The flags are private:
# nothing reaches a consumer.
function (meniscus_target_flags target)
  get_target_property(aliased "${target}" ALIASED_TARGET)
  if (aliased)
    set(target "${aliased}")
  endif ()
  target_compile_options("${target}" PRIVATE -Wall -Wextra -Wshadow -Wno-unused-parameter)
  if (MENISCUS_WARNINGS_AS_ERRORS)
    target_compile_options("${target}" PRIVATE -Werror)
  endif ()
  if (MENISCUS_SANITIZER)
    target_compile_options("${target}" PRIVATE
      -fsanitize=${MENISCUS_SANITIZER} -fno-omit-frame-pointer -fno-sanitize-recover=all)
    target_link_options("${target}" PRIVATE -fsanitize=${MENISCUS_SANITIZER})
  endif ()
  if (MENISCUS_CLANG_TIDY)
    set_property(TARGET "${target}" PROPERTY CXX_CLANG_TIDY "${MENISCUS_CLANG_TIDY_EXECUTABLE}")
  endif ()
endfunction ()

# Headers that many sources include, by subject: kernel, vtk, rendering, tests.
set(meniscus_headers_kernel
  <algorithm> <array> <cmath> <cstddef> <cstdint> <functional> <limits> <memory> <numeric> <string>
  <utility> <vector>
  <glm/common.hpp> <glm/geometric.hpp> <glm/mat3x3.hpp> <glm/matrix.hpp> <glm/vec2.hpp>
  <glm/vec3.hpp> <glm/vec4.hpp>)
set(meniscus_headers_vtk
  <vtkCellArray.h> <vtkCellData.h> <vtkDoubleArray.h> <vtkFloatArray.h> <vtkIdList.h>
  <vtkIdTypeArray.h> <vtkInformation.h> <vtkInformationVector.h> <vtkMath.h>
  <vtkMultiBlockDataSet.h> <vtkNew.h> <vtkObjectFactory.h> <vtkPointData.h> <vtkPoints.h>
  <vtkPolyData.h> <vtkSMPTools.h> <vtkSmartPointer.h> <vtkUnstructuredGrid.h>)
set(meniscus_headers_rendering
  <vtkCamera.h> <vtkColorTransferFunction.h> <vtkPiecewiseFunction.h> <vtkRenderWindow.h>
  <vtkRenderer.h> <vtkVolume.h> <vtkVolumeProperty.h>)
set(meniscus_headers_tests <gtest/gtest.h>)

# meniscus_precompile_headers(TARGET SUBJECT...): reads the headers of these subjects once for all
# sources of a target. No source relies on it: each includes the headers that it uses, and
# CMAKE_DISABLE_PRECOMPILE_HEADERS builds without.
function (meniscus_precompile_headers target)
  get_target_property(aliased "${target}" ALIASED_TARGET)
  if (aliased)
    set(target "${aliased}")
  endif ()
  set(headers)
  foreach (subject IN LISTS ARGN)
    list(APPEND headers ${meniscus_headers_${subject}})
  endforeach ()
  target_precompile_headers(${target} PRIVATE ${headers})
endfunction ()

# Tests also run on real meshes where they find them.
set(MENISCUS_DATA_DIR "$ENV{MENISCUS_DATA_DIR}" CACHE PATH
  "Folder with blunt_fin.vtu, combustor.vtu, crushed_can.vtu")
if (NOT MENISCUS_DATA_DIR AND EXISTS "${CMAKE_CURRENT_SOURCE_DIR}/../shared/data")
  get_filename_component(MENISCUS_DATA_DIR "${CMAKE_CURRENT_SOURCE_DIR}/../shared/data" ABSOLUTE)
endif ()
