# SPDX-License-Identifier: Apache-2.0
# Part of Groundglass.
# Holds docs/papers.md to what the code cites:
#   cmake -D TREE=<source folder> -P bibliography.cmake
# A citation in a comment is an author, perhaps others or a venue, and a year: (Zhang, PAMI 2000),
# Brown and Lowe (IJCV 2007), Keys 1981. Some line of the page must have the author, the year and
# the citing file without its ending; and the files that the page names must exist. Prints one line
# for each fault and fails if there is one.

cmake_minimum_required(VERSION 3.25)

set(rooms scene calibrate register ask session invrender viewer gui drawing exchange report datasets-synthetic evaluate pipeline cli)
set(name "[A-Z][A-Za-z]*[a-z]")
set(others "((, ${name})*,? (and|&) ${name}|,? (and|&) others| et al\\.)?")
set(venue "([A-Z][A-Za-z. ]*[ ,]+)?")
set(citation "${name}${others}( do)?[, (]+${venue}(18|19|20)[0-9][0-9]")

# Square brackets and semicolons would break CMake's lists.
file(READ ${TREE}/docs/papers.md page)
string(REGEX REPLACE "[][;]" "." page "${page}")
string(REPLACE "\n" ";" lines "${page}")

set(faults 0)
set(num_citations 0)
foreach(room IN LISTS rooms)
  file(GLOB_RECURSE sources RELATIVE ${TREE} ${TREE}/${room}/*.h ${TREE}/${room}/*.cc)
  foreach(source IN LISTS sources)
    file(READ ${TREE}/${source} text)
    string(REGEX REPLACE "[][;]" "." text "${text}")
    string(REGEX MATCHALL "//[^\n]*(\n[ \t]*//[^\n]*)*" comments "${text}")
    string(REGEX REPLACE "\\.(h|cc)$" "" stem ${source})
    foreach(comment IN LISTS comments)
      string(REGEX REPLACE "\n[ \t]*//" "" comment "${comment}")
      string(REGEX MATCHALL "${citation}" citations "${comment}")
      foreach(cited IN LISTS citations)
        string(REGEX MATCH "^${name}" author "${cited}")
        # A method's name, and then the author: Seidel (Cryer 1971).
        if(cited MATCHES "\\((${name}) ")
          set(author ${CMAKE_MATCH_1})
        endif()
        string(REGEX MATCH "[0-9]+$" year "${cited}")
        math(EXPR num_citations "${num_citations} + 1")
        set(is_listed FALSE)
        foreach(line IN LISTS lines)
          if(line MATCHES "[^A-Za-z]${author}[^a-z]" AND line MATCHES "[^0-9]${year}[^0-9]"
             AND line MATCHES "`${stem}`")
            set(is_listed TRUE)
          endif()
        endforeach()
        if(NOT is_listed)
          math(EXPR faults "${faults} + 1")
          set(wanted "${author}, ${year} and `${stem}`")
          message("${source} cites \"${cited}\": docs/papers.md has no line with ${wanted}")
        endif()
      endforeach()
    endforeach()
  endforeach()
endforeach()

string(REGEX MATCHALL "`[a-z0-9_/-]+/[a-z0-9_-]+`" named "${page}")
foreach(path IN LISTS named)
  string(REPLACE "`" "" path ${path})
  file(GLOB found ${TREE}/${path}.h ${TREE}/${path}.cc)
  if(NOT found AND NOT IS_DIRECTORY ${TREE}/${path})
    math(EXPR faults "${faults} + 1")
    message("docs/papers.md: there is no ${path}")
  endif()
endforeach()

if(num_citations EQUAL 0)
  message(FATAL_ERROR "no citation was found in the code: this test has gone blind")
endif()
if(faults)
  message(FATAL_ERROR "${faults} citations and paths of docs/papers.md do not agree with the code")
endif()
