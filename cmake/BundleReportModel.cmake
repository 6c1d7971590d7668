# SPDX-License-Identifier: Apache-2.0
# The script that turns the model in report.html, from npm's packages of report/web:
#   cmake -D SOURCE=report/web -D WORK=... -D OUT=model.bundle.js -D NPM=... -D NODE=... -P ...
# Where npm, node or the network are missing the script is empty, and the page says that it has no
# model to turn: the build goes on.
function(without_model why)
  message(STATUS "report.html without a model to turn: ${why}")
  file(WRITE ${OUT} "")
endfunction()

if(NOT NPM OR NOT NODE)
  without_model("npm or node is not installed")
  return()
endif()
file(COPY ${SOURCE}/package.json ${SOURCE}/package-lock.json ${SOURCE}/model.js ${SOURCE}/build.mjs
     DESTINATION ${WORK})
execute_process(
  COMMAND ${NPM} ci --no-audit --no-fund
  WORKING_DIRECTORY ${WORK} TIMEOUT 180 RESULT_VARIABLE failed OUTPUT_QUIET ERROR_VARIABLE said)
if(NOT failed EQUAL 0)
  without_model("npm ci did not get its packages (${failed})")
  return()
endif()
execute_process(
  COMMAND ${NODE} build.mjs ${OUT}
  WORKING_DIRECTORY ${WORK} TIMEOUT 120 RESULT_VARIABLE failed OUTPUT_QUIET ERROR_VARIABLE said)
if(NOT failed EQUAL 0)
  without_model("esbuild failed: ${said}")
endif()
