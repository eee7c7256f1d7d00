# Prints the value at KEYS (separated by commas) of the JSON in FILE.
file(READ ${FILE} text)
string(REPLACE "," ";" KEYS "${KEYS}")
string(JSON value GET "${text}" ${KEYS})
execute_process(COMMAND ${CMAKE_COMMAND} -E echo "${value}")
