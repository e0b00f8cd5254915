# Run while a package is made. Writes changelog.Debian.gz and, for the program, changelog.gz (CHANGELOG.md) into the folder
# `doc`, with the time SOURCE_DATE_EPOCH if it is set.
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)
file(WRITE "${doc}/changelog.Debian"
  "${package} (${version}) unstable; urgency=medium\n\n  * Changes of the sources: changelog.gz of the package gaitlab.\n\n"
  " -- ${maintainer}  ${date}\n")
set(files "${doc}/changelog.Debian")
if(package STREQUAL "gaitlab")
  configure_file("${CMAKE_CURRENT_LIST_DIR}/../CHANGELOG.md" "${doc}/changelog" COPYONLY)
  list(APPEND files "${doc}/changelog")
endif()
execute_process(COMMAND gzip -9nf ${files} COMMAND_ERROR_IS_FATAL ANY)
