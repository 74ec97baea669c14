# extract_example(page language output [lines]): writes a page's first block of code in a language
# to a file, while CMake configures; see ReadmeExample.cmake for the number of lines.
set(_extract_example_script "${CMAKE_CURRENT_LIST_DIR}/ReadmeExample.cmake")
function (extract_example page language output)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${page}")
  execute_process(
    COMMAND "${CMAKE_COMMAND}" "-DLANGUAGE=${language}" "-DREADME=${page}" "-DLINES=${ARGN}"
      "-DOUTPUT=${output}" -P "${_extract_example_script}"
    RESULT_VARIABLE failed)
  if (failed)
    message(FATAL_ERROR "No ${language} example in ${page}")
  endif ()
endfunction ()
