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

# Finds the rooms of sources of a GoogleTest program, by their folders. Sets meniscus_rooms, and
# meniscus_suites_ROOM to the test suites of each room.
function (meniscus_find_rooms)
  set(rooms)
  foreach (source IN LISTS ARGN)
    get_filename_component(path "${source}" ABSOLUTE)
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

# Reads Testing/TestTimes.txt, with a sanitizer Testing/SanitizerTimes.txt: meniscus_long_tests has
# the names of the tests that take long, and meniscus_seconds_NAME their usual time.
function (meniscus_read_times)
  set(file "${PROJECT_SOURCE_DIR}/Testing/TestTimes.txt")
  if (MENISCUS_SANITIZER)
    set(file "${PROJECT_SOURCE_DIR}/Testing/SanitizerTimes.txt")
  endif ()
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${file}")
  file(STRINGS "${file}" lines REGEX "^[0-9]+ ")
  set(names)
  foreach (line IN LISTS lines)
    string(REGEX MATCH "^([0-9]+) ([^ ]+)" line "${line}")
    list(APPEND names "${CMAKE_MATCH_2}")
    set("meniscus_seconds_${CMAKE_MATCH_2}" "${CMAKE_MATCH_1}" PARENT_SCOPE)
  endforeach ()
  set(meniscus_long_tests ${names} PARENT_SCOPE)
endfunction ()

# meniscus_add_process(NAME TARGET FILTER SECONDS LABELS [PROPERTY VALUE]...): one process for the
# tests of a filter. It fails after ten times its usual seconds, so that a hang is seen, and writes
# the time of each of its tests for scripts/test_times.py.
function (meniscus_add_process name target filter seconds labels)
  set(limit 10)
  if (MENISCUS_SANITIZER OR CMAKE_BUILD_TYPE STREQUAL "Debug")
    set(limit 100)
  endif ()
  math(EXPR limit "${limit} * ${seconds}")
  add_test(NAME "${name}" COMMAND ${target} "--gtest_filter=${filter}"
    "--gtest_output=json:${CMAKE_BINARY_DIR}/Testing/Temporary/Times/${name}.json")
  # ctest starts tests of a high cost first.
  set_tests_properties("${name}" PROPERTIES ${ARGN}
    LABELS "${labels}" TIMEOUT ${limit} COST ${seconds})
endfunction ()

# Adds the tests of a suite: one process for those that are quick, and one for each that takes long.
# The label "sanitized" marks what scripts/sanitize runs: quick unit tests and pipeline tests.
function (meniscus_add_suite suite target label room prefix all)
  set(quick_labels "${label};${room}")
  set(long_labels "${label};${room};long")
  if (label MATCHES "^(unit|pipeline)$")
    list(APPEND quick_labels sanitized)
  endif ()
  set(left_out "")
  string(REPLACE "." "\\." start "^${prefix}")
  foreach (test IN LISTS meniscus_long_tests)
    if (test MATCHES "${start}([^.]*/)?${suite}(/[^.]*)?\\.")
      string(LENGTH "${prefix}" length)
      string(SUBSTRING "${test}" ${length} -1 filter)
      string(APPEND left_out ":${filter}")
      if (NOT TEST "${test}") # the name of its instantiation may be that of another suite
        meniscus_add_process("${test}" ${target} "${filter}" ${meniscus_seconds_${test}}
          "${long_labels}" ${ARGN})
      endif ()
    endif ()
  endforeach ()
  meniscus_add_process("${prefix}${suite}" ${target} "${all}-${left_out}" 20 "${quick_labels}"
    ${ARGN})
endfunction ()

# To be called once for a program, after its tests are added. No test may be missed because its
# suite has not been found in the sources: one more process runs all others, usually none. Builds
# with clang's counters of blocks record which code is run (scripts/check_reach.py).
function (meniscus_complete_tests target label)
  get_target_property(found ${target} meniscus_filter)
  meniscus_add_process("${target}.OtherSuites" ${target} "-${found}" 20 "${label}" ${ARGN})
  if (MENISCUS_SANITIZER MATCHES "fuzzer-no-link")
    target_sources(${target} PRIVATE "${PROJECT_SOURCE_DIR}/Testing/Support/CoverageRecorder.cxx")
  endif ()
endfunction ()

# meniscus_discover_tests(TARGET LABEL [PREFIX prefix] [SOURCES source...] [PROPERTIES ...]): adds
# the tests of a GoogleTest program, by suites, because starting a process takes as long as many
# tests do. With a prefix they can be added several times. If only a part of the sources is given,
# meniscus_complete_tests is to be called after the last part.
function (meniscus_discover_tests target label)
  cmake_parse_arguments(PARSE_ARGV 2 add "" "PREFIX" "SOURCES;PROPERTIES")
  set(sources ${add_SOURCES})
  if (NOT sources)
    get_target_property(sources ${target} SOURCES)
  endif ()
  meniscus_label_tests(${target} ${label})
  meniscus_find_rooms(${sources})
  meniscus_read_times()
  foreach (room IN LISTS meniscus_rooms)
    set_property(GLOBAL APPEND_STRING PROPERTY meniscus_rooms "${room} ${target} ${label}\n")
    foreach (suite IN LISTS meniscus_suites_${room})
      set(filter "${suite}.*:*/${suite}.*:${suite}/*.*:*/${suite}/*.*")
      set_property(TARGET ${target} APPEND_STRING PROPERTY meniscus_filter "${filter}:")
      meniscus_add_suite(${suite} ${target} ${label} "${room}" "${add_PREFIX}" "${filter}"
        ${add_PROPERTIES})
    endforeach ()
  endforeach ()
  if (NOT add_SOURCES)
    meniscus_complete_tests(${target} ${label} ${add_PROPERTIES})
  endif ()
endfunction ()

# Writes lines "room program kind" for scripts/check to rooms.txt in the build folder.
function (meniscus_write_rooms)
  get_property(rooms GLOBAL PROPERTY meniscus_rooms)
  file(WRITE "${CMAKE_BINARY_DIR}/rooms.txt" "${rooms}")
endfunction ()
