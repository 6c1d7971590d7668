# SPDX-License-Identifier: Apache-2.0
# Part of Groundglass.
# Installs the build tree into a folder, then configures, builds and runs the small project beside
# this file against what was installed.
#   cmake -D BUILD=<build tree> -D WORK=<folder> -D CXX=<compiler> -D SANITIZE=ON|OFF -P test.cmake

cmake_minimum_required(VERSION 3.25)

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE output
                  ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    string(JOIN " " command ${ARGN})
    message(FATAL_ERROR "${command}\n${output}")
  endif()
endfunction()

# A library built with the sanitizers needs them in the program as well.
set(flags "")
if(SANITIZE)
  set(flags "-fsanitize=address,undefined")
endif()

file(REMOVE_RECURSE ${WORK})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/install)
run(${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR} -B ${WORK}/build -G Ninja
    -D CMAKE_PREFIX_PATH=${WORK}/install -D CMAKE_CXX_COMPILER=${CXX}
    -D CMAKE_CXX_FLAGS=${flags})
run(${CMAKE_COMMAND} --build ${WORK}/build)
run(${WORK}/build/consumer)
run(${WORK}/install/bin/groundglass --version)
