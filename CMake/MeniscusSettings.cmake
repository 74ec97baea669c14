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

# Makes a program a part of the target meniscus_tests_LABEL, which builds all tests of a label.
function (meniscus_label_tests target label)
  if (NOT TARGET meniscus_tests_${label})
    add_custom_target(meniscus_tests_${label})
  endif ()
  add_dependencies(meniscus_tests_${label} ${target})
endfunction ()

# meniscus_discover_tests(TARGET LABEL [PROPERTY VALUE]...): adds the tests of a GoogleTest program.
function (meniscus_discover_tests target label)
  meniscus_label_tests(${target} ${label})
  gtest_discover_tests(${target} PROPERTIES LABELS ${label} ${ARGN})
endfunction ()

# Tests also run on real meshes where they find them.
set(MENISCUS_DATA_DIR "$ENV{MENISCUS_DATA_DIR}" CACHE PATH
  "Folder with blunt_fin.vtu, combustor.vtu, crushed_can.vtu")
if (NOT MENISCUS_DATA_DIR AND EXISTS "${CMAKE_CURRENT_SOURCE_DIR}/../shared/data")
  get_filename_component(MENISCUS_DATA_DIR "${CMAKE_CURRENT_SOURCE_DIR}/../shared/data" ABSOLUTE)
endif ()
