# SPDX-License-Identifier: Apache-2.0
# A room is one folder, one static library, one subject. Rooms see one another only through
# NEEDS; tests/include_directions.cmake holds the #include lines to the same table.

# GCC 12 sees overlapping copies in plain std::string assignments (its bug 105651): -Wno-restrict.
# It takes the sources of a unity build for headers: -Wno-subobject-linkage.
set(GROUNDGLASS_WARNINGS -Wall -Wextra -Wshadow -Wnon-virtual-dtor
    $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict;-Wno-subobject-linkage> -Werror)

# GCC looks for memory to reuse whenever what it holds has doubled; below a gigabyte that takes more
# of its time than it is worth.
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  add_compile_options("SHELL:--param ggc-min-heapsize=1000000")
endif()

include(${CMAKE_CURRENT_LIST_DIR}/HeaderClosure.cmake)

# groundglass_room(scene SOURCES a.cc b.cc NEEDS Eigen3::Eigen PRIVATE embree)
# NEEDS: what a user of the room's headers needs; PRIVATE: what only its sources use.
# QUICK: sources in which little time is spent, so the compiler optimises them less (-O1), which takes
# a third less of its time; QUICK_TO_BUILD: all of them are.
# PUBLIC: the headers that other rooms include; they are installed with those of the room that they
# include themselves. Without it all headers are, but for
# INTERNAL (last): headers that are not installed and may show third-party types.
function(groundglass_room name)
  cmake_parse_arguments(ROOM "QUICK_TO_BUILD" "" "PUBLIC;SOURCES;QUICK;NEEDS;PRIVATE;INTERNAL" ${ARGN})
  string(REPLACE "-" "_" target_suffix ${name})
  set(target groundglass_${target_suffix})
  add_library(${target} STATIC ${ROOM_SOURCES})
  add_library(groundglass::${target_suffix} ALIAS ${target})
  target_include_directories(${target}
    PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
           $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/groundglass>)
  target_link_libraries(${target} PUBLIC ${ROOM_NEEDS} PRIVATE ${ROOM_PRIVATE})
  target_compile_options(${target} PRIVATE ${GROUNDGLASS_WARNINGS})
  if(ROOM_QUICK_TO_BUILD)
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
    groundglass_precompile(${target} precompiled_quick ${GROUNDGLASS_COMMON_HEADERS})
  endif()
  if(ROOM_QUICK)
    add_library(${target}_quick OBJECT ${ROOM_QUICK})
    target_include_directories(${target}_quick PRIVATE ${PROJECT_SOURCE_DIR})
    target_link_libraries(${target}_quick PRIVATE ${ROOM_NEEDS} ${ROOM_PRIVATE})
    target_compile_options(${target}_quick PRIVATE ${GROUNDGLASS_WARNINGS} $<$<CONFIG:Release>:-O1>)
    groundglass_precompile(${target}_quick precompiled_quick ${GROUNDGLASS_COMMON_HEADERS})
    target_sources(${target} PRIVATE $<TARGET_OBJECTS:${target}_quick>)
  endif()
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${target_suffix})
  if(NOT GROUNDGLASS_EVERY_COMMAND)
    return()  # only whole rooms are installed, and all of them
  endif()
  install(TARGETS ${target} EXPORT groundglassTargets
          ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
  if(ROOM_PUBLIC)
    groundglass_header_closure(headers ${PROJECT_SOURCE_DIR} ${name} ${ROOM_PUBLIC})
  else()
    file(GLOB_RECURSE headers RELATIVE ${CMAKE_CURRENT_SOURCE_DIR} *.h)
    list(REMOVE_ITEM headers ${ROOM_INTERNAL})
  endif()
  foreach(header IN LISTS headers)
    get_filename_component(folder ${header} DIRECTORY)
    install(FILES ${header}
            DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/groundglass/${name}/${folder})
  endforeach()
endfunction()

# groundglass_precompile(target NAME HEADERS...): reads the headers once for all targets of that name,
# which are compiled with -O1. Much of the compiling is the reading of Eigen and the standard library.
# Not where each source is to be compiled alone, so that it includes what it uses; nor with -O3, where
# GCC 12 then warns falsely of std::string's own copies.
function(groundglass_precompile target name)
  if(NOT CMAKE_UNITY_BUILD)
    return()
  endif()
  if(NOT TARGET ${name})
    set(source ${PROJECT_BINARY_DIR}/${name}.cc)
    file(CONFIGURE OUTPUT ${source} CONTENT "\n")
    add_library(${name} OBJECT ${source})
    target_link_libraries(${name} PRIVATE Eigen3::Eigen)
    if("<gtest/gtest.h>" IN_LIST ARGN)
      target_link_libraries(${name} PRIVATE GTest::gtest GTest::gmock)
    endif()
    target_compile_options(${name} PRIVATE ${GROUNDGLASS_WARNINGS} $<$<CONFIG:Release>:-O1>)
    target_precompile_headers(${name} PRIVATE ${ARGN})
  endif()
  target_precompile_headers(${target} REUSE_FROM ${name})
endfunction()

# What nearly every source reads.
set(GROUNDGLASS_COMMON_HEADERS <Eigen/Dense> <algorithm> <array> <cmath> <filesystem> <fstream>
    <functional> <map> <optional> <random> <set> <span> <sstream> <string> <vector>)

# groundglass_test(register NEEDS groundglass::register SOURCES a_test.cc)
# One GoogleTest program for each room; a few of its suites at a time are a ctest.
function(groundglass_test room)
  cmake_parse_arguments(T "" "" "SOURCES;NEEDS" ${ARGN})
  string(REPLACE "-" "_" suffix ${room})
  set(target ${suffix}_tests)
  add_executable(${target} ${T_SOURCES})
  target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR})
  target_link_libraries(${target} PRIVATE ${T_NEEDS} GTest::gtest GTest::gmock GTest::gtest_main)
  # Tests wait for the compiler more than for themselves: less is optimised, and a few are compiled
  # at once, so that after a change to one not all are.
  if(CMAKE_UNITY_BUILD_BATCH_SIZE GREATER 8)
    set_target_properties(${target} PROPERTIES UNITY_BUILD_BATCH_SIZE 8)
  endif()
  target_compile_options(${target} PRIVATE ${GROUNDGLASS_WARNINGS} $<$<CONFIG:Release>:-O1>)
  target_compile_definitions(${target} PRIVATE
    GROUNDGLASS_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  groundglass_precompile(${target} precompiled_for_tests <gmock/gmock.h> <gtest/gtest.h>
                         ${GROUNDGLASS_COMMON_HEADERS})
  set(suites ${CMAKE_CURRENT_BINARY_DIR}/${target}_suites.cmake)
  set(script ${PROJECT_SOURCE_DIR}/cmake/ListTestSuites.cmake)
  add_custom_command(TARGET ${target} POST_BUILD
    COMMAND ${CMAKE_COMMAND} -D PROGRAM=$<TARGET_FILE:${target}> -D ROOM=${room} -D OUT=${suites}
            -P ${script}
    BYPRODUCTS ${suites}
    VERBATIM)
  # As long as it is not built there is one test, which fails.
  file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/${target}_include.cmake
    "if(EXISTS [==[${suites}]==])\n  include([==[${suites}]==])\nelse()\n"
    "  add_test([==[${room}/NOT_BUILT]==] NOT_BUILT)\nendif()\n")
  set_property(DIRECTORY APPEND PROPERTY
    TEST_INCLUDE_FILES ${CMAKE_CURRENT_BINARY_DIR}/${target}_include.cmake)
endfunction()

function(groundglass_install_package)
  include(CMakePackageConfigHelpers)
  set(where ${CMAKE_INSTALL_LIBDIR}/cmake/groundglass)
  install(EXPORT groundglassTargets NAMESPACE groundglass:: DESTINATION ${where})
  configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/groundglassConfig.cmake.in
    ${PROJECT_BINARY_DIR}/groundglassConfig.cmake INSTALL_DESTINATION ${where})
  write_basic_package_version_file(${PROJECT_BINARY_DIR}/groundglassConfigVersion.cmake
    COMPATIBILITY SameMinorVersion)
  install(FILES ${PROJECT_BINARY_DIR}/groundglassConfig.cmake
                ${PROJECT_BINARY_DIR}/groundglassConfigVersion.cmake DESTINATION ${where})
endfunction()
