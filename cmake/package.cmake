# Parts of an installation beside the program: the headers of a plugin and a CMake package (docs/ci.md).
include(CMakePackageConfigHelpers)

install(DIRECTORY core/plugin DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/gaitlab/core COMPONENT development
  FILES_MATCHING PATTERN "*.h"
  PATTERN catalog.h EXCLUDE PATTERN plugin_instance.h EXCLUDE PATTERN sensor.h EXCLUDE) # the program's own side

# Debian's name for the compiler that plugins need: g++-12, clang++-14.
string(REGEX MATCH "^[0-9]+" major "${CMAKE_CXX_COMPILER_VERSION}")
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  set(gaitlab_compiler_name g++-${major})
else()
  set(gaitlab_compiler_name clang++-${major})
endif()

set(package ${CMAKE_INSTALL_LIBDIR}/cmake/gaitlab)
configure_package_config_file(cmake/gaitlabConfig.cmake.in ${CMAKE_BINARY_DIR}/generated/gaitlabConfig.cmake
  INSTALL_DESTINATION ${package}
  PATH_VARS CMAKE_INSTALL_BINDIR CMAKE_INSTALL_INCLUDEDIR)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/generated/gaitlabConfigVersion.cmake
  COMPATIBILITY SameMinorVersion) # before 1.0 a minor version may break
install(FILES ${CMAKE_BINARY_DIR}/generated/gaitlabConfig.cmake ${CMAKE_BINARY_DIR}/generated/gaitlabConfigVersion.cmake
  DESTINATION ${package} COMPONENT development)
