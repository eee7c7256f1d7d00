# Run when a test program was built (faceprobe_test in Room.cmake): asks it for its suites and makes each a ctest.
#   cmake -D PROGRAM=FILE -D OUT=FILE -P ListSuites.cmake
execute_process(COMMAND ${PROGRAM} --gtest_list_tests OUTPUT_VARIABLE _listed TIMEOUT 60 COMMAND_ERROR_IS_FATAL ANY)
# A suite is a line that begins without a space and whose first word a dot ends; its cases are indented.
string(REGEX MATCHALL "\n[A-Za-z0-9_/]+[.]" _suites "\n${_listed}")
if(NOT _suites)
  message(FATAL_ERROR "${PROGRAM} --gtest_list_tests listed no suite.")
endif()
get_filename_component(_program ${PROGRAM} NAME)
set(_text "")
foreach(_suite IN LISTS _suites)
  string(REGEX REPLACE "[\n.]" "" _suite "${_suite}")
  string(APPEND _text "add_test([=[${_program}.${_suite}]=] [=[${PROGRAM}]=] [=[--gtest_filter=${_suite}.*]=])\n")
endforeach()
file(WRITE ${OUT} "${_text}")
