# SPDX-License-Identifier: Apache-2.0
# Part of Groundglass.
# Shows that bibliography.cmake and doc_links.cmake can fail: writes small trees and expects their
# faults to be told.
#   cmake -D WORK=<empty folder> -P docs_test.cmake

cmake_minimum_required(VERSION 3.25)

# check(SCRIPT EXPECTED): EXPECTED is a regular expression on the complaint, or "fine".
function(check script expected)
  execute_process(
    COMMAND ${CMAKE_COMMAND} -D TREE=${WORK} -P ${CMAKE_CURRENT_LIST_DIR}/${script}.cmake
    RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(expected STREQUAL "fine")
    if(NOT status EQUAL 0)
      message(SEND_ERROR "${script} should pass, but: ${output}")
    endif()
  elseif(status EQUAL 0)
    message(SEND_ERROR "${script} should say '${expected}', but passes")
  elseif(NOT output MATCHES "${expected}")
    message(SEND_ERROR "${script} should say '${expected}', but: ${output}")
  endif()
endfunction()

# check_citation(COMMENT PAGE EXPECTED): a header with this comment beside a page with this line.
function(check_citation comment page expected)
  file(REMOVE_RECURSE ${WORK})
  file(WRITE ${WORK}/scene/lens.h "int a[2];\n${comment}\nint b;\n")
  file(WRITE ${WORK}/docs/papers.md "| ${page} |\n")
  check(bibliography "${expected}")
endfunction()

set(zhang "Z. Zhang, *A technique*, PAMI 22(11), 2000 | `scene/lens`")
check_citation("// By homographies (Zhang, PAMI 2000, section 3)." "${zhang}" fine)
check_citation("// By homographies (Zhang 2000); then" "${zhang}" fine)
check_citation("// By homographies (Zhang, PAMI\n  // 2000)." "${zhang}" fine)
check_citation("// By homographies (Zhang 1999)." "${zhang}" "no line with Zhang, 1999")
check_citation("// As Kim & Zhang 2000 do." "${zhang}" "no line with Kim, 2000")
check_citation("// As Kim and others (TOG 2000) do." "${zhang}" "no line with Kim, 2000")
check_citation("// By Gauss-Seidel (Cryer 1971)." "${zhang}" "no line with Cryer, 1971")
check_citation("// (Zhang 2000)" "Z. Zhang, *A technique*, 2000" "and `scene/lens`")
check_citation("// (Zhang 2000)" "${zhang}, `scene/sold`" "there is no scene/sold")
check_citation("// Nobody is cited." "${zhang}" "gone blind")

# check_page(TEXT EXPECTED): a page with this text, beside one with the heading "How it's done".
function(check_page text expected)
  file(REMOVE_RECURSE ${WORK})
  file(WRITE ${WORK}/scene/lens.h "")
  file(WRITE ${WORK}/docs/how.md "# How it's done\n")
  file(WRITE ${WORK}/docs/page.md "${text}\n")
  check(doc_links "${expected}")
endfunction()

check_page("[a](how.md), [b](how.md#how-its-done), [c](https://example.org), `scene/lens.h`" fine)
check_page("[a](how.md) in `lens.h` and `scene/lens.h`: fine" fine)
check_page("[a](why.md)" "why.md: there is no such file")
check_page("[a](how.md#why)" "no such heading")
check_page("![a](how.jpg)" "how.jpg: there is no such file")
check_page("[a](how.md), `scene/lens.cc`" "there is no scene/lens.cc")
check_page("no link" "gone blind")
