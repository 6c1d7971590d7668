# SPDX-License-Identifier: Apache-2.0
# What groundglass_embed runs:
#   cmake -D OUT=out.cc -D FOLDER=... -D HEADER=... -D "FILES=kName;file;..." -P EmbedFilesScript.cmake
set(source "// Made by cmake/EmbedFilesScript.cmake.\n#include \"${HEADER}\"\n\nnamespace groundglass {\n")
while(FILES)
  list(POP_FRONT FILES name file)
  cmake_path(ABSOLUTE_PATH file BASE_DIRECTORY ${FOLDER})
  file(READ ${file} text)
  string(FIND "${text}" ")embedded\"" end)
  if(NOT end EQUAL -1)
    message(FATAL_ERROR "${file}: holds )embedded\", which would end it in C++")
  endif()
  string(APPEND source "\nconst char ${name}[] = R\"embedded(${text})embedded\";\n")
endwhile()
string(APPEND source "\n}  // namespace groundglass\n")
file(WRITE ${OUT} "${source}")
