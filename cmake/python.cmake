# The Python package gaitlab (docs/python.md): the module _native of python/native, and the package of python/gaitlab beside it.
# -DPython_EXECUTABLE=/its/python3 selects another Python than Debian's. The tests use numpy and pandas of the selected Python.
set(Python_EXECUTABLE /usr/bin/python3 CACHE FILEPATH "Python for which the module is built")
find_package(Python 3.11 REQUIRED COMPONENTS Interpreter Development.Module)
find_package(pybind11 2.10 REQUIRED CONFIG)  # Debian: pybind11-dev

file(GLOB native CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/python/native/*.cpp)
pybind11_add_module(gaitlab_native MODULE NO_EXTRAS ${native})
set(package_folder ${CMAKE_BINARY_DIR}/python/gaitlab)
set_target_properties(gaitlab_native PROPERTIES OUTPUT_NAME _native LIBRARY_OUTPUT_DIRECTORY ${package_folder})
target_compile_options(gaitlab_native PRIVATE ${cold})
# Symbols of the rooms are hidden, because another module in the process may contain the same libraries.
set(exports ${CMAKE_SOURCE_DIR}/python/native/exports.map)
target_link_options(gaitlab_native PRIVATE -Wl,--version-script=${exports} -Wl,--as-needed $<$<CONFIG:Release>:-s>)
set_target_properties(gaitlab_native PROPERTIES LINK_DEPENDS ${exports})
target_link_libraries(gaitlab_native PRIVATE gaitlab_kit gaitlab_flags Threads::Threads)

file(GLOB package CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/python/gaitlab/*.py ${CMAKE_SOURCE_DIR}/python/gaitlab/*.pyi
  ${CMAKE_SOURCE_DIR}/python/gaitlab/py.typed)
file(MAKE_DIRECTORY ${package_folder})
foreach(file ${package})
  get_filename_component(name ${file} NAME)
  file(CREATE_LINK ${file} ${package_folder}/${name} SYMBOLIC)
endforeach()

set(GAITLAB_PYTHON_FOLDER lib/python3/dist-packages CACHE STRING "Folder of Python packages in the installation prefix")
install(TARGETS gaitlab_native DESTINATION ${GAITLAB_PYTHON_FOLDER}/gaitlab COMPONENT python)
install(FILES ${package} DESTINATION ${GAITLAB_PYTHON_FOLDER}/gaitlab COMPONENT python)
