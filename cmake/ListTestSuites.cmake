# SPDX-License-Identifier: Apache-2.0
# What groundglass_test runs once a test program is linked:
#   cmake -D PROGRAM=... -D ROOM=scene -D OUT=suites.cmake -P ListTestSuites.cmake
# Writes a CTest file with one test for each GoogleTest suite of the program. A process of its own for
# each TEST would cost half a second each, nearly all of it for loading OpenImageIO's 260 libraries.
execute_process(COMMAND ${PROGRAM} --gtest_list_tests
                OUTPUT_VARIABLE listed COMMAND_ERROR_IS_FATAL ANY)
# Suites stand at the start of a line and end in a point ("Formats/MeshFuzz."); their tests are indented.
string(REGEX MATCHALL "(^|\n)[A-Za-z0-9_/]+\\." suites "${listed}")
set(tests)
foreach(suite IN LISTS suites)
  string(STRIP "${suite}" suite)
  string(REGEX REPLACE "\\.$" "" name "${suite}")
  string(APPEND tests "add_test([==[${ROOM}/${name}]==] [==[${PROGRAM}]==] [==[--gtest_filter=${suite}*]==])\n"
                      "set_tests_properties([==[${ROOM}/${name}]==] PROPERTIES LABELS ${ROOM})\n")
endforeach()
if(NOT tests)
  message(FATAL_ERROR "${PROGRAM} has no tests")
endif()
file(WRITE ${OUT} "${tests}")
