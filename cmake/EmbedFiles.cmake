# SPDX-License-Identifier: Apache-2.0
# groundglass_embed(out.cc HEADER report/report_page.h
#                   FILES kReportTemplate report.mustache kReportStyle report.css)
# A file that the build makes is named by its whole path.
# Makes a source in the build folder that holds files of this folder as strings, so that the program
# need not find them when it runs. HEADER declares them: extern const char kReportTemplate[];
function(groundglass_embed source)
  cmake_parse_arguments(EMBED "" "HEADER" "FILES" ${ARGN})
  set(names_and_files ${EMBED_FILES})
  set(files)
  while(names_and_files)
    list(POP_FRONT names_and_files name file)
    cmake_path(ABSOLUTE_PATH file BASE_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR})
    list(APPEND files ${file})
  endwhile()
  set(script ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/EmbedFilesScript.cmake)
  add_custom_command(
    OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/${source}
    COMMAND ${CMAKE_COMMAND} -D OUT=${CMAKE_CURRENT_BINARY_DIR}/${source}
            -D FOLDER=${CMAKE_CURRENT_SOURCE_DIR} -D HEADER=${EMBED_HEADER}
            -D "FILES=${EMBED_FILES}" -P ${script}
    DEPENDS ${files} ${script}
    VERBATIM)
  # For what reads the sources without building: cmake --build ... --target embedded_files.
  if(NOT TARGET embedded_files)
    add_custom_target(embedded_files)
  endif()
  string(MAKE_C_IDENTIFIER embedded_${source} target)
  add_custom_target(${target} DEPENDS ${CMAKE_CURRENT_BINARY_DIR}/${source})
  add_dependencies(embedded_files ${target})
endfunction()
