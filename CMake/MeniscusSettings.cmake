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
set(MENISCUS_CMAKE_DIR "${CMAKE_INSTALL_LIBDIR}/cmake/Meniscus")

option(MENISCUS_WARNINGS_AS_ERRORS "Treat warnings in our own code as errors" OFF)
set(MENISCUS_SANITIZER "" CACHE STRING "Sanitizer for our own targets: address, undefined or thread")

# Applies the project's warning and sanitizer flags to a target of ours. The flags are private:
# nothing reaches a consumer.
function (meniscus_target_flags target)
  target_compile_options("${target}" PRIVATE -Wall -Wextra -Wshadow -Wno-unused-parameter)
  if (MENISCUS_WARNINGS_AS_ERRORS)
    target_compile_options("${target}" PRIVATE -Werror)
  endif ()
  if (MENISCUS_SANITIZER)
    target_compile_options("${target}" PRIVATE
      -fsanitize=${MENISCUS_SANITIZER} -fno-omit-frame-pointer -fno-sanitize-recover=all)
    target_link_options("${target}" PRIVATE -fsanitize=${MENISCUS_SANITIZER})
  endif ()
endfunction ()
