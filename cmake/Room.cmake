# faceprobe_room(NAME SOURCES ... [ROOMS ...] [LIBRARIES ...])
# One room of the house: a library target faceprobe_NAME. ROOMS are the rooms below that its headers may include;
# LIBRARIES stay private to its sources.
function(faceprobe_room name)
  cmake_parse_arguments(ARG "" "" "SOURCES;ROOMS;LIBRARIES" ${ARGN})
  add_library(faceprobe_${name} STATIC ${ARG_SOURCES})
  add_library(faceprobe::${name} ALIAS faceprobe_${name})
  set_target_properties(faceprobe_${name} PROPERTIES EXPORT_NAME ${name})
  target_include_directories(faceprobe_${name}
    PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>
    PRIVATE ${PROJECT_SOURCE_DIR}/src)
  target_compile_features(faceprobe_${name} PUBLIC cxx_std_20)
  target_link_libraries(faceprobe_${name} PUBLIC Eigen3::Eigen PRIVATE $<BUILD_INTERFACE:faceprobe_flags> ${ARG_LIBRARIES})
  foreach(room ${ARG_ROOMS})
    target_link_libraries(faceprobe_${name} PUBLIC faceprobe_${room})
  endforeach()
  if(NOT FACEPROBE_UNITY)  # which reads them once anyway
    target_precompile_headers(faceprobe_${name} PRIVATE <algorithm> <array> <cmath> <string> <vector> <Eigen/Dense>)
  endif()
  set_property(GLOBAL APPEND PROPERTY FACEPROBE_ROOMS faceprobe_${name})
endfunction()

# faceprobe_test(NAME SOURCES ... ROOMS ...): one GoogleTest program; each of its suites is a ctest, NAME.SUITE. Not each case: what reads pictures
# is linked with hundreds of libraries, whose loading took longer than most cases.
function(faceprobe_test name)
  cmake_parse_arguments(ARG "" "" "SOURCES;ROOMS;LIBRARIES" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/tests ${PROJECT_SOURCE_DIR}/src)
  target_link_libraries(${name} PRIVATE faceprobe_flags GTest::gtest GTest::gtest_main ${ARG_LIBRARIES})
  foreach(room ${ARG_ROOMS})
    target_link_libraries(${name} PRIVATE faceprobe_${room})
  endforeach()
  # What a test does itself takes no time; compiling it does.
  target_compile_options(${name} PRIVATE $<$<CONFIG:Release>:-O1>)
  list(LENGTH ARG_SOURCES files)
  if(files GREATER 4)  # for fewer, to read the headers once more costs more than it saves
    target_precompile_headers(${name} PRIVATE <gtest/gtest.h> <Eigen/Dense> <cmath> <string> <vector>)
  endif()
  set(_suites ${CMAKE_CURRENT_BINARY_DIR}/${name}_suites.cmake)
  add_custom_command(TARGET ${name} POST_BUILD
    COMMAND ${CMAKE_COMMAND} -D PROGRAM=$<TARGET_FILE:${name}> -D OUT=${_suites} -P ${PROJECT_SOURCE_DIR}/cmake/ListSuites.cmake
    BYPRODUCTS ${_suites} VERBATIM)
  # A program that was not built is a test that fails.
  set(_include ${CMAKE_CURRENT_BINARY_DIR}/${name}_include.cmake)
  file(WRITE ${_include} "if(EXISTS [=[${_suites}]=])\n  include([=[${_suites}]=])\nelse()\n  add_test(${name}_NOT_BUILT ${name}_NOT_BUILT)\nendif()\n")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${_include})
endfunction()
