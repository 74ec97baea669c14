# Labels of tests: one by kind (unit, pipeline, numeric, ...) and one by room, the folder of the
# code that a test is about. Testing/Module/Volume/Mesh has the tests of the room
# Module/Volume/Mesh. scripts/check builds and runs the tests of rooms by these labels.

# Makes a program a part of the target meniscus_tests_LABEL, which builds all tests of a kind.
function (meniscus_label_tests target label)
  if (NOT TARGET meniscus_tests_${label})
    add_custom_target(meniscus_tests_${label})
  endif ()
  add_dependencies(meniscus_tests_${label} ${target})
endfunction ()

# Collects the rooms of a GoogleTest program: its suites by folder of their source file. Writes
# lines "room program kind" for scripts/check, and returns a script for ctest's TEST_INCLUDE_FILES
# that adds the rooms to the labels of the tests in the lists ARGN.
function (meniscus_label_rooms target label)
  get_target_property(sources ${target} SOURCES)
  get_target_property(folder ${target} SOURCE_DIR)
  set(rooms)
  set(script "")
  foreach (source IN LISTS sources)
    get_filename_component(path "${source}" ABSOLUTE BASE_DIR "${folder}")
    file(RELATIVE_PATH room "${PROJECT_SOURCE_DIR}/Testing" "${path}")
    get_filename_component(room "${room}" DIRECTORY)
    if (NOT room MATCHES "^(Module|Filters|Rendering)(/|$)" OR NOT EXISTS "${path}")
      continue ()
    endif ()
    file(STRINGS "${path}" tests REGEX "^(TYPED_)?TEST(_[FP])?\\(")
    if (NOT tests)
      continue ()
    endif ()
    list(APPEND rooms "${room}")
    list(TRANSFORM tests REPLACE "^[A-Z_]+\\(([A-Za-z0-9_]+),.*" "\\1")
    list(REMOVE_DUPLICATES tests)
    foreach (suite IN LISTS tests)
      string(APPEND script "set(meniscus_room_${suite} \"${room}\")\n")
    endforeach ()
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${path}")
  endforeach ()
  list(REMOVE_DUPLICATES rooms)
  foreach (room IN LISTS rooms)
    set_property(GLOBAL APPEND_STRING PROPERTY meniscus_rooms "${room} ${target} ${label}\n")
  endforeach ()
  set(file "${CMAKE_CURRENT_BINARY_DIR}/${target}_rooms.cmake")
  foreach (tests IN LISTS ARGN)
    string(APPEND script
      "foreach (test IN LISTS ${tests})\n"
      "  if (test MATCHES \"(^|[./])([A-Za-z0-9_]+)(/[0-9]+)?\\\\.[A-Za-z0-9_]+(/[^.]*)?$\" AND\n"
      "      DEFINED meniscus_room_\${CMAKE_MATCH_2})\n"
      "    set_tests_properties(\"\${test}\" PROPERTIES\n"
      "      LABELS \"${label};\${meniscus_room_\${CMAKE_MATCH_2}}\")\n"
      "  endif ()\n"
      "endforeach ()\n")
  endforeach ()
  file(GENERATE OUTPUT "${file}" CONTENT "${script}")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES "${file}")
endfunction ()

# meniscus_discover_tests(TARGET LABEL [PROPERTY VALUE]...): adds the tests of a GoogleTest program.
function (meniscus_discover_tests target label)
  meniscus_label_tests(${target} ${label})
  gtest_discover_tests(${target} PROPERTIES LABELS ${label} ${ARGN})
  meniscus_label_rooms(${target} ${label} ${target}_TESTS)
endfunction ()

# Writes the rooms of all programs to rooms.txt in the build folder.
function (meniscus_write_rooms)
  get_property(rooms GLOBAL PROPERTY meniscus_rooms)
  file(WRITE "${CMAKE_BINARY_DIR}/rooms.txt" "${rooms}")
endfunction ()
