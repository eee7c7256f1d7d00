# Pages for man and completions for shells, written by the command once it is built (apps/cli/manual_command.cpp), so that they know its verbs and
# options. A command for another processor cannot run here, and one with sanitizers is not what anybody installs.
if(CMAKE_CROSSCOMPILING OR FACEPROBE_SANITIZE OR FACEPROBE_BUILD_FUZZ)
  return()
endif()

find_program(GZIP_PROGRAM gzip REQUIRED)
mark_as_advanced(GZIP_PROGRAM)
set(_manual ${PROJECT_BINARY_DIR}/manual)
add_custom_command(
  OUTPUT ${_manual}/pages_written ${_manual}/faceprobe.bash ${_manual}/_faceprobe ${_manual}/faceprobe.fish
  # Which pages there are only the command knows; those of verbs that are no more go.
  COMMAND ${CMAKE_COMMAND} -E rm -rf ${_manual}/man1
  COMMAND faceprobe -q manual --folder ${_manual}/man1
  COMMAND ${GZIP_PROGRAM} -9nr ${_manual}/man1
  COMMAND ${CMAKE_COMMAND} -E touch ${_manual}/pages_written
  COMMAND faceprobe completion bash > ${_manual}/faceprobe.bash
  COMMAND faceprobe completion zsh > ${_manual}/_faceprobe
  COMMAND faceprobe completion fish > ${_manual}/faceprobe.fish
  DEPENDS faceprobe
  COMMENT "Writing the manual and the shell completions"
  VERBATIM)
add_custom_target(faceprobe_manual ALL
                  DEPENDS ${_manual}/pages_written ${_manual}/faceprobe.bash ${_manual}/_faceprobe ${_manual}/faceprobe.fish)

install(DIRECTORY ${_manual}/man1/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT faceprobe FILES_MATCHING PATTERN "*.gz")
install(FILES ${_manual}/faceprobe.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME faceprobe COMPONENT faceprobe)
install(FILES ${_manual}/_faceprobe DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions COMPONENT faceprobe)
install(FILES ${_manual}/faceprobe.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d COMPONENT faceprobe)
