# SPDX-License-Identifier: Apache-2.0
# What groundglass_test runs once a test program is linked:
#   cmake -D PROGRAM=... -D ROOM=scene -D OUT=suites.cmake -P ListTestSuites.cmake
# Writes a CTest file with one test for each four GoogleTest suites of the program, named after them
# ("scene/Csv+DecodeImage+..."). Each process costs nearly a second before its first test, all of it
# for loading OpenImageIO's 260 libraries: one for each TEST, or each suite, would be most of the time.
set(suites_in_a_test 4)
execute_process(COMMAND ${PROGRAM} --gtest_list_tests
                OUTPUT_VARIABLE listed COMMAND_ERROR_IS_FATAL ANY)
# Suites stand at the start of a line and end in a point ("Formats/MeshFuzz."); their tests are indented.
string(REGEX MATCHALL "(^|\n)[A-Za-z0-9_/]+\\." suites "${listed}")
if(NOT suites)
  message(FATAL_ERROR "${PROGRAM} has no tests")
endif()
list(TRANSFORM suites STRIP)
list(LENGTH suites num_suites)
set(tests)
set(first 0)
while(first LESS num_suites)
  list(SUBLIST suites ${first} ${suites_in_a_test} group)
  list(JOIN group "*:" filter)
  list(TRANSFORM group REPLACE "\\.$" "" OUTPUT_VARIABLE names)
  list(JOIN names "+" name)
  string(APPEND tests "add_test([==[${ROOM}/${name}]==] [==[${PROGRAM}]==] [==[--gtest_filter=${filter}*]==])\n"
                      "set_tests_properties([==[${ROOM}/${name}]==] PROPERTIES LABELS ${ROOM})\n")
  math(EXPR first "${first} + ${suites_in_a_test}")
endwhile()
file(WRITE ${OUT} "${tests}")
