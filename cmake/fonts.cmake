# The fonts of figures, made by report/plot/fonts/subset.py and committed, become arrays of bytes in the program.
set(fonts_source ${CMAKE_BINARY_DIR}/generated/fonts.cpp)
foreach(font GaitlabSans GaitlabSans-Bold)
  set(file ${CMAKE_SOURCE_DIR}/report/plot/fonts/${font}.ttf)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
  file(READ ${file} bytes HEX)
  string(REGEX REPLACE "(..)" "0x\\1," ${font} "${bytes}")
endforeach()
set(code "#include \"report/plot/font.h\"
namespace gaitlab::report {
std::string_view font_file(Face face) {
  static const unsigned char kRegular[] = {${GaitlabSans}};
  static const unsigned char kBold[] = {${GaitlabSans-Bold}};
  if (face == Face::bold) return {reinterpret_cast<const char*>(kBold), sizeof kBold};
  return {reinterpret_cast<const char*>(kRegular), sizeof kRegular};
}
}  // namespace gaitlab::report
")
set(written "")
if(EXISTS ${fonts_source})
  file(READ ${fonts_source} written)
endif()
if(NOT written STREQUAL code)
  file(WRITE ${fonts_source} "${code}")
endif()
set_source_files_properties(${fonts_source} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
target_sources(gaitlab_report PRIVATE ${fonts_source})
