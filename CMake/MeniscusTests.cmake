# Labels of tests: one by kind (unit, pipeline, numeric, ...) and one by room, the folder of the
# code that a test is about. Testing/Module/Volume/Mesh has the tests of the room
# Module/Volume/Mesh. scripts/check builds and runs the tests of rooms by these labels.

option(MENISCUS_GROUP_TESTS "Run the tests of a program and a room in one process" OFF)
set(MENISCUS_LEFT_OUT_TESTS "" CACHE STRING
  "Tests that MENISCUS_GROUP_TESTS leaves out, in the syntax of --gtest_filter")
mark_as_advanced(MENISCUS_GROUP_TESTS MENISCUS_LEFT_OUT_TESTS)

# Makes a program a part of the target meniscus_tests_LABEL, which builds all tests of a kind.
function (meniscus_label_tests target label)
  if (NOT TARGET meniscus_tests_${label})
    add_custom_target(meniscus_tests_${label})
  endif ()
  add_dependencies(meniscus_tests_${label} ${target})
endfunction ()

# Finds the rooms of a GoogleTest program, by the folders of its sources. Sets meniscus_rooms, and
# meniscus_suites_ROOM to the test suites of each room.
function (meniscus_find_rooms target)
  get_target_property(sources ${target} SOURCES)
  get_target_property(folder ${target} SOURCE_DIR)
  set(rooms)
  foreach (source IN LISTS sources)
    get_filename_component(path "${source}" ABSOLUTE BASE_DIR "${folder}")
    file(RELATIVE_PATH room "${PROJECT_SOURCE_DIR}/Testing" "${path}")
    get_filename_component(room "${room}" DIRECTORY)
    if (NOT EXISTS "${path}")
      continue ()
    endif ()
    file(STRINGS "${path}" tests REGEX "^(TYPED_)?TEST(_[FP])?\\(")
    if (tests)
      list(APPEND rooms "${room}")
      list(TRANSFORM tests REPLACE "^[A-Z_]+\\(([A-Za-z0-9_]+),.*" "\\1")
      list(APPEND meniscus_suites_${room} ${tests})
      list(REMOVE_DUPLICATES meniscus_suites_${room})
      set(meniscus_suites_${room} ${meniscus_suites_${room}} PARENT_SCOPE)
      set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${path}")
    endif ()
  endforeach ()
  list(REMOVE_DUPLICATES rooms)
  set(meniscus_rooms ${rooms} PARENT_SCOPE)
endfunction ()

# One test per room of a program: all its suites in one process.
function (meniscus_add_room_tests target label prefix)
  foreach (room IN LISTS meniscus_rooms)
    set(filter "")
    foreach (suite IN LISTS meniscus_suites_${room})
      string(APPEND filter "${suite}.*:*/${suite}.*:${suite}/*.*:")
    endforeach ()
    set(name "${prefix}${target}.${room}")
    add_test(NAME "${name}"
      COMMAND ${target} "--gtest_filter=${filter}-${MENISCUS_LEFT_OUT_TESTS}" --gtest_brief=1)
    set_tests_properties("${name}" PROPERTIES ${ARGN} LABELS "${label};${room}" TIMEOUT 3000)
  endforeach ()
endfunction ()

# Adds the room of each discovered test to its labels, when ctest reads the list TESTS, and limits
# its time to ten times the usual one of Testing/TestTimes.txt, 3 s if it is not listed there.
# Tests that are listed have the label "long" as well.
function (meniscus_label_discovered target label tests)
  string(CONCAT script
    "file(STRINGS \"${PROJECT_SOURCE_DIR}/Testing/TestTimes.txt\" lines REGEX \"^[0-9]+ \")\n"
    "foreach (line IN LISTS lines)\n"
    "  string(REGEX MATCH \"^([0-9]+) (.*)$\" line \"\${line}\")\n"
    "  set(\"meniscus_seconds_\${CMAKE_MATCH_2}\" \"\${CMAKE_MATCH_1}\")\n"
    "endforeach ()\n")
  set(limit 10)
  if (MENISCUS_SANITIZER OR CMAKE_BUILD_TYPE STREQUAL "Debug")
    set(limit 100)
  endif ()
  foreach (room IN LISTS meniscus_rooms)
    foreach (suite IN LISTS meniscus_suites_${room})
      string(APPEND script "set(meniscus_room_${suite} \"${room}\")\n")
    endforeach ()
  endforeach ()
  string(APPEND script
    "foreach (test IN LISTS ${tests})\n"
    "  set(labels \"${label}\")\n"
    "  set(seconds 3)\n"
    "  if (DEFINED \"meniscus_seconds_\${test}\")\n"
    "    set(seconds \"\${meniscus_seconds_\${test}}\")\n"
    "    list(APPEND labels long)\n"
    "  endif ()\n"
    "  math(EXPR seconds \"${limit} * \${seconds}\")\n"
    "  if (test MATCHES \"(^|[./])([A-Za-z0-9_]+)(/[0-9]+)?\\\\.[A-Za-z0-9_]+(/[^.]*)?$\" AND\n"
    "      DEFINED meniscus_room_\${CMAKE_MATCH_2})\n"
    "    list(APPEND labels \"\${meniscus_room_\${CMAKE_MATCH_2}}\")\n"
    "  endif ()\n"
    "  set_tests_properties(\"\${test}\" PROPERTIES\n"
    "    LABELS \"\${labels}\" TIMEOUT \${seconds})\n"
    "endforeach ()\n")
  set(file "${CMAKE_CURRENT_BINARY_DIR}/${tests}_rooms.cmake")
  file(GENERATE OUTPUT "${file}" CONTENT "${script}")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES "${file}")
endfunction ()

# meniscus_discover_tests(TARGET LABEL [PREFIX prefix] [PROPERTY VALUE]...): adds the tests of a
# GoogleTest program. With a prefix the program can be added several times.
function (meniscus_discover_tests target label)
  cmake_parse_arguments(PARSE_ARGV 2 add "" "PREFIX" "")
  set(properties ${add_UNPARSED_ARGUMENTS})
  meniscus_label_tests(${target} ${label})
  meniscus_find_rooms(${target})
  foreach (room IN LISTS meniscus_rooms)
    set_property(GLOBAL APPEND_STRING PROPERTY meniscus_rooms "${room} ${target} ${label}\n")
  endforeach ()
  if (MENISCUS_GROUP_TESTS)
    meniscus_add_room_tests(${target} ${label} "${add_PREFIX}" ${properties})
  else ()
    string(REPLACE "." "" suffix "_${add_PREFIX}")
    gtest_discover_tests(${target}
      TEST_PREFIX "${add_PREFIX}"
      TEST_LIST   ${target}${suffix}
      PROPERTIES  LABELS ${label} ${properties})
    meniscus_label_discovered(${target} ${label} ${target}${suffix})
  endif ()
endfunction ()

# Writes lines "room program kind" for scripts/check to rooms.txt in the build folder.
function (meniscus_write_rooms)
  get_property(rooms GLOBAL PROPERTY meniscus_rooms)
  file(WRITE "${CMAKE_BINARY_DIR}/rooms.txt" "${rooms}")
endfunction ()
