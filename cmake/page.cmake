# The page of a run, made by report/page and committed as one file, becomes a string in the program, so that a build needs no
# node.
set(page_file ${CMAKE_SOURCE_DIR}/report/page/dist/page.html)
set(page_source ${CMAKE_BINARY_DIR}/generated/page.cpp)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${page_file})
file(READ ${page_file} page)
foreach(mark TITLE META DATA)
  string(FIND "${page}" "/*${mark}*/" first)
  string(FIND "${page}" "/*${mark}*/" last REVERSE)
  if(first EQUAL -1 OR NOT first EQUAL last)
    message(FATAL_ERROR "report/page/dist/page.html must hold the mark /*${mark}*/ exactly once, where the program puts a run in; "
      "build it again: cd report/page && npm ci --ignore-scripts && npm run build")
  endif()
endforeach()
string(FIND "${page}" ")page\"" end)
if(NOT end EQUAL -1)
  message(FATAL_ERROR "report/page/dist/page.html holds )page\", which ends the string in generated/page.cpp; "
    "choose another delimiter in cmake/page.cmake")
endif()
# Not configure_file: it would look for variables in the page.
set(code "#include \"report/page/page.h\"
#pragma GCC diagnostic ignored \"-Woverlength-strings\"
namespace gaitlab::report {
std::string_view page_template() { return R\"page(${page})page\"; }
}  // namespace gaitlab::report
")
set(written "")
if(EXISTS ${page_source})
  file(READ ${page_source} written)
endif()
if(NOT written STREQUAL code)
  file(WRITE ${page_source} "${code}")
endif()
set_source_files_properties(${page_source} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
target_sources(gaitlab_report PRIVATE ${page_source})
