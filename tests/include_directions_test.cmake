# SPDX-License-Identifier: Apache-2.0
# Part of Groundglass.
# Shows that include_directions.cmake can fail: writes small trees with one include each, and
# expects the arrow to be refused, or let through.
#   cmake -D WORK=<empty folder> -P include_directions_test.cmake

cmake_minimum_required(VERSION 3.25)

# check_one(FILE INCLUDE EXPECTED): EXPECTED is a regular expression on the complaint, or "fine".
function(check_one file include expected)
  file(REMOVE_RECURSE ${WORK})
  file(WRITE ${WORK}/register/CMakeLists.txt
       "groundglass_room(register SOURCES a.cc\n  INTERNAL secret.h)\n")
  file(WRITE ${WORK}/invrender/CMakeLists.txt
       "groundglass_room(invrender PUBLIC bake.h\n  SOURCES a.cc)\n")
  file(WRITE ${WORK}/invrender/bake.h "#include \"invrender/charts.h\"\n")
  file(WRITE ${WORK}/invrender/charts.h "")
  file(WRITE ${WORK}/invrender/mixer.h "")
  file(WRITE ${WORK}/${file} "#include ${include}\n")
  execute_process(
    COMMAND ${CMAKE_COMMAND} -D TREE=${WORK} -P ${CMAKE_CURRENT_LIST_DIR}/include_directions.cmake
    RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(expected STREQUAL "fine")
    if(NOT status EQUAL 0)
      message(SEND_ERROR "${file} with ${include} should pass, but: ${output}")
    endif()
  elseif(status EQUAL 0)
    message(SEND_ERROR "${file} with ${include} should be refused")
  elseif(NOT output MATCHES "${expected}")
    message(SEND_ERROR "${file} with ${include} should say '${expected}', but: ${output}")
  endif()
endfunction()

check_one(register/a.cc "\"scene/camera.h\"" fine)
check_one(register/a.cc "\"register/b.h\"" fine)
check_one(register/a.cc "<vector>" fine)
check_one(register/a.cc "<ceres/ceres.h>" fine)
check_one(evaluate/a.cc "\"viewer/render.h\"" fine)
check_one(cli/a.cc "\"datasets-synthetic/wiesner.h\"" fine)
check_one(scene/a.h "<Eigen/Dense>" fine)

check_one(scene/a.cc "\"register/b.h\"" "scene may not include register")
check_one(register/a.cc "\"invrender/b.h\"" "register may not include invrender")
check_one(viewer/deep/a.h "\"calibrate/b.h\"" "viewer may not include calibrate")
check_one(invrender/a.cc "\"datasets-synthetic/b.h\"" "may not include datasets-synthetic")
check_one(datasets-synthetic/a.cc "\"cli/commands.h\"" "may not include cli")
check_one(register/a.cc "\"util/b.h\"" "util is no room")
check_one(register/a.cc "\"b.h\"" "name the room")
check_one(register/a.cc "  <embree3/rtcore.h>" "belongs to")
check_one(scene/formats/model_io.cc "<OpenImageIO/imageio.h>" "belongs to")
check_one(register/a.h "<ceres/ceres.h>" "belongs to")
check_one(calibrate/a.h "<opencv2/core.hpp>" "belongs to")
check_one(register/a.cc "<apriltag/apriltag.h>" "belongs to")
check_one(invrender/a.cc "<GL/osmesa.h>" "belongs to")
check_one(register/a.cc "<CLI/CLI.hpp>" "belongs to")
check_one(register/a.h "\"register/secret.h\"" "internal and an installed header is not")
check_one(evaluate/a.cc "\"register/secret.h\"" "internal to register")
check_one(register/a.cc "\"register/secret.h\"" fine)
check_one(register/secret.h "<ceres/ceres.h>" fine)
check_one(register/secret.h "<GL/gl.h>" "belongs to")
check_one(register/a.cc "<boost/any.hpp>" "nobody owns <boost/...>")
check_one(evaluate/a.cc "\"invrender/bake.h\"" fine)
check_one(evaluate/a.cc "\"invrender/charts.h\"" "other headers for other rooms")
check_one(invrender/charts.h "<opencv2/core.hpp>" "belongs to")
check_one(invrender/mixer.h "<opencv2/core.hpp>" fine)
check_one(register/search/a.h "\"register/edges/b.h\"" fine)
check_one(register/search/a.h "\"register/search/b.h\"" fine)
check_one(register/a.cc "\"register/verdict/b.h\"" fine)
check_one(register/edges/a.h "\"register/search/b.h\"" "a floor includes itself and those below")
check_one(register/verdict/a.h "\"register/register.h\"" "a floor includes itself and those below")
file(REMOVE_RECURSE ${WORK})
