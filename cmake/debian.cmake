# The Debian packages gaitlab, gaitlab-dev and python3-gaitlab, by CPack from the components `program`, `development` and `python`
# (docs/overview.md): cpack --config BUILD_FOLDER/CPackConfig.cmake -B FOLDER. gaitlab-mpi and CHANGELOG.md are in none of them.

# Notices of everything that is part of a binary: the project, the report page, the fonts, and libraries that are compiled into
# it, if their licences require notices (Boost's does not for binaries).
set(compiled_in libpagmo-dev libcli11-dev nlohmann-json3-dev libeigen3-dev libfmt-dev pybind11-dev)
set(notice "gaitlab, a gait lab for modular robots. Source: the repository of gaitlab.\n\n")
set(rule "\n\n------------------------------------------------------------------------------\n")
file(READ LICENSE text)
string(APPEND notice "${text}")
file(WRITE ${CMAKE_BINARY_DIR}/generated/copyright-dev "${notice}")
foreach(part "report/page/LICENSES.txt;the report page, which is part of the program, contains these two libraries"
    "report/plot/fonts/OFL.txt;the fonts of figures, which are part of the program")
  list(GET part 0 file)
  list(GET part 1 what)
  file(READ ${file} text)
  string(APPEND notice "${rule}${what}:\n\n${text}")
endforeach()
foreach(package ${compiled_in})
  if(EXISTS /usr/share/doc/${package}/copyright)
    file(READ /usr/share/doc/${package}/copyright text)
    string(APPEND notice "${rule}Code of the Debian package ${package} is compiled into the programs. Its notices:\n\n${text}")
  endif()
endforeach()
file(WRITE ${CMAKE_BINARY_DIR}/generated/copyright "${notice}")
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/LICENSE
  ${CMAKE_SOURCE_DIR}/report/page/LICENSES.txt ${CMAKE_SOURCE_DIR}/report/plot/fonts/OFL.txt)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "") # CPack would put it before the descriptions below
set(CPACK_PACKAGE_VENDOR "gaitlab developers")
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_MAINTAINER "${GAITLAB_MAINTAINER}")
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_COMPONENTS_ALL program development)
set(same_version "gaitlab (= ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})")

# debian_package(COMPONENT NAME SECTION COPYRIGHT DESCRIPTION): variables of CPack, and the files in /usr/share/doc/NAME.
function(debian_package component name section copyright description)
  string(TOUPPER ${component} upper)
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${name} PARENT_SCOPE)
  set(CPACK_DEBIAN_${upper}_PACKAGE_SECTION ${section} PARENT_SCOPE)
  set(CPACK_DEBIAN_${upper}_DESCRIPTION "${description}" PARENT_SCOPE)
  set(doc ${CMAKE_INSTALL_DATADIR}/doc/${name})
  install(FILES ${CMAKE_BINARY_DIR}/generated/${copyright} DESTINATION ${doc} RENAME copyright COMPONENT ${component} EXCLUDE_FROM_ALL)
  install(CODE "set(package ${name})
    set(version ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})
    set(maintainer \"${GAITLAB_MAINTAINER}\")
    set(doc \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${doc}\")
    include(\"${CMAKE_SOURCE_DIR}/cmake/debian_changelog.cmake\")" COMPONENT ${component} EXCLUDE_FROM_ALL)
endfunction()

debian_package(program gaitlab science copyright "gait lab for modular robots
gaitlab simulates a modular robot, its motors, controllers and pattern
generator (CPG) on the ground, from a YAML file. It prints a verdict on
motors, docks and falls, and writes a page with the moving robot, every check
and every curve.

This package contains the program, the shipped modules, robots, scenarios and
studies, the schemas for editors, and the documentation.")
debian_package(development gaitlab-dev libdevel copyright-dev "gait lab for modular robots (plugins)
gaitlab simulates a modular robot, its motors, controllers and pattern
generator (CPG) on the ground, from a YAML file.

This package contains the headers of plugins (CPGs, controllers, actuators),
and the CMake package with which plugins are built and gaits are tested.")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "${same_version}")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_RECOMMENDS "cmake, ${gaitlab_compiler_name}, make | ninja-build")
if(GAITLAB_PYTHON)
  list(APPEND CPACK_COMPONENTS_ALL python)
  debian_package(python python3-gaitlab python copyright "gait lab for modular robots (Python package)
gaitlab simulates a modular robot, its motors, controllers and pattern
generator (CPG) on the ground, from a YAML file.

This package contains the Python package gaitlab: single runs, tables of
rollouts with the bits of the program, run folders and studies as arrays, and
pattern generators written in Python.")
  math(EXPR next "${Python_VERSION_MINOR} + 1")
  set(python 3.${Python_VERSION_MINOR})
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "${same_version}, python3 (>= ${python}~), python3 (<< 3.${next}), python3-numpy")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "python3-pandas")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA "${CMAKE_SOURCE_DIR}/cmake/debian/postinst;${CMAKE_SOURCE_DIR}/cmake/debian/prerm")
endif()
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "gaitlab-dev, python3-gaitlab, libmujoco2.2.2") # reads MJCF
include(CPack)
