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

# meniscus_optimize_less(TARGET): for programs whose own code does little, such as tests of a shared
# library: the optimiser takes half of the time of their compilation. Other flags than CMake's
# default are the user's, and stay.
function (meniscus_optimize_less target)
  if (CMAKE_CXX_FLAGS_RELEASE STREQUAL "-O3 -DNDEBUG")
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
  endif ()
endfunction ()

# Headers that many sources include, by subject: kernel, vtk, rendering, and those of tests, without
# VTK and with it.
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
set(meniscus_headers_tests "${PROJECT_SOURCE_DIR}/Testing/Support/TestBasics.h")
set(meniscus_headers_vtk_tests "${PROJECT_SOURCE_DIR}/Testing/Support/VTKTestBasics.h")

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

# meniscus_compile_together(TARGET [FOLDER...]): with MENISCUS_UNITY_BUILD, the sources of a folder,
# by default of all folders, are compiled together, six at a time, because reading headers and
# instantiating templates takes longer than the rest. Names in anonymous namespaces are therefore
# unique in such a folder. Sources with options of their own are compiled by themselves.
option(MENISCUS_UNITY_BUILD "Compile several sources of a folder together" OFF)
function (meniscus_compile_together target)
  get_target_property(aliased "${target}" ALIASED_TARGET)
  if (aliased)
    set(target "${aliased}")
  endif ()
  get_target_property(base ${target} SOURCE_DIR)
  get_target_property(sources ${target} SOURCES)
  list(FILTER sources INCLUDE REGEX "^[^$]*\\.cxx$")
  foreach (source IN LISTS sources)
    get_filename_component(source "${source}" ABSOLUTE BASE_DIR "${base}")
    get_filename_component(folder "${source}" DIRECTORY)
    file(RELATIVE_PATH folder "${PROJECT_SOURCE_DIR}" "${folder}")
    get_source_file_property(generated "${source}" TARGET_DIRECTORY ${target} GENERATED)
    if (generated OR (ARGN AND NOT folder IN_LIST ARGN))
      continue ()
    endif ()
    list(APPEND grouped_${folder} "${source}")
    list(LENGTH grouped_${folder} count)
    math(EXPR part "(${count} + 5) / 6")
    string(MAKE_C_IDENTIFIER "${folder}_${part}" group)
    set_source_files_properties("${source}" TARGET_DIRECTORY ${target}
      PROPERTIES UNITY_GROUP "${group}")
  endforeach ()
  set_target_properties(${target} PROPERTIES
    UNITY_BUILD      ${MENISCUS_UNITY_BUILD}
    UNITY_BUILD_MODE GROUP)
  # GCC takes the sources for headers, in which members of such types would be a mistake.
  if (MENISCUS_UNITY_BUILD AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(${target} PRIVATE -Wno-subobject-linkage)
  endif ()
endfunction ()

# Tests also run on real meshes where they find them.
set(MENISCUS_DATA_DIR "$ENV{MENISCUS_DATA_DIR}" CACHE PATH
  "Folder with blunt_fin.vtu, combustor.vtu, crushed_can.vtu")
if (NOT MENISCUS_DATA_DIR AND EXISTS "${CMAKE_CURRENT_SOURCE_DIR}/../shared/data")
  get_filename_component(MENISCUS_DATA_DIR "${CMAKE_CURRENT_SOURCE_DIR}/../shared/data" ABSOLUTE)
endif ()
