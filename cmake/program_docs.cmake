# Texts of an installation: manual page and completion of the program, which prints them itself, the pages, the notices.
find_program(GZIP gzip REQUIRED)
set(man_folder ${CMAKE_BINARY_DIR}/share/man/man1)
set(completion_folder ${CMAKE_BINARY_DIR}/share/bash-completion/completions)
file(MAKE_DIRECTORY ${man_folder} ${completion_folder})
add_custom_command(TARGET gaitlab POST_BUILD
  COMMAND ${CMAKE_COMMAND} -E env ASAN_OPTIONS=detect_leaks=0 $<TARGET_FILE:gaitlab> man > ${man_folder}/gaitlab.1
  COMMAND ${GZIP} -9nf ${man_folder}/gaitlab.1
  COMMAND ${CMAKE_COMMAND} -E env ASAN_OPTIONS=detect_leaks=0 $<TARGET_FILE:gaitlab> completion bash > ${completion_folder}/gaitlab)
install(FILES ${man_folder}/gaitlab.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program)
install(FILES ${completion_folder}/gaitlab DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT program)
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program PATTERN docs/site EXCLUDE)
install(FILES README.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
# A Debian package has changelog and notices in other forms (cmake/debian.cmake).
install(FILES CHANGELOG.md ${CMAKE_BINARY_DIR}/generated/copyright DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT notices)
