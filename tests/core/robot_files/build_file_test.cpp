#include "core/robot_files/build_file.h"

#include <gtest/gtest.h>

#include "tests/core/scenario/fakes.h"
#include "tests/messages.h"

namespace gaitlab {
namespace {

std::string build_error(const std::string& text) {
  Problems problems;
  read_build(text, "x.dat", problems);
  return test::message_of([&] { problems.raise(); });
}

std::string docks_error(const std::string& text) {
  Problems problems;
  const Node root = parse_yaml("docks: " + text + "\n", "f");
  read_docks(*root.find("docks"), problems);
  return test::message_of([&] { problems.raise(); });
}

TEST(BuildFile, RowsCommentsAndBlankLines) {
  Problems problems;
  const std::vector<Dock> docks = read_build("# five columns\n\n  1 1 4 0 2 # first\r\n1\t2 4 1 0", "x.dat", problems);
  EXPECT_TRUE(problems.empty());
  ASSERT_EQ(docks.size(), 2U);
  EXPECT_EQ(docks[0].child_face, 1);
  EXPECT_EQ(docks[0].child_module, 1);
  EXPECT_EQ(docks[0].parent_face, 4);
  EXPECT_EQ(docks[0].parent_module, 0);
  EXPECT_EQ(docks[0].orientation, 2);
  EXPECT_EQ(to_string(docks[0].place), "x.dat:3:3");
  EXPECT_EQ(to_string(docks[1].place), "x.dat:4:1");
}

TEST(BuildFile, ErrorsNameRowAndColumn) {
  EXPECT_EQ(
      build_error("1 1 4 0 1\n1 2 4 1\n 1 3 x 2 0\n1 100001 4 0 0\n"),
      "x.dat:2:1: error: the row has 4 numbers; expected 5: child_face child_module parent_face parent_module orientation\n"
      "x.dat:3:6: error: parent_face is 'x'; expected a whole number\n"
      "x.dat:4:3: error: child_module is 100001; expected 0 to 100000");
  EXPECT_EQ(build_error("1 1 4 0 1.5\n1 2 4 010 0\n1 2 4 -1 0\n"),
            "x.dat:1:9: error: orientation is 1.5; expected a whole number\n"
            "x.dat:2:7: error: parent_module is 010; expected a whole number without a leading zero\n"
            "x.dat:3:7: error: parent_module is -1; expected 0 to 100000");
}

TEST(BuildFile, InlineRows) {
  Problems problems;
  const Node root = parse_yaml(
      "docks:\n  - [1, 1, 4, 0, 3]\n  - {child_face: 1, child_module: 2, parent_face: 4, parent_module: 1, orientation: 0}\n",
      "f");
  const std::vector<Dock> docks = read_docks(*root.find("docks"), problems);
  ASSERT_EQ(docks.size(), 2U);
  EXPECT_EQ(docks[0].orientation, 3);
  EXPECT_EQ(docks[1].child_module, 2);
  EXPECT_EQ(to_string(docks[1].place), "f:3:5");
}

TEST(BuildFile, InlineErrors) {
  EXPECT_EQ(
      docks_error("3"),
      "f:1:8: error: docks is 3; expected a list of rows [child_face child_module parent_face parent_module orientation]");
  EXPECT_EQ(
      docks_error("[[1, 1, 4, 0], 7, [1, 1, 4, 0, a]]"),
      "f:1:9: error: the row has 4 numbers; expected 5: child_face child_module parent_face parent_module orientation\n"
      "f:1:23: error: docks[1] is 7; expected five numbers: [child_face child_module parent_face parent_module orientation]\n"
      "f:1:39: error: orientation is 'a'; expected a whole number");
  EXPECT_EQ(docks_error("[{child_face: 1, child_modul: 2, parent_face: 4, parent_module: 1, orientation: 0}]"),
            "f:1:25: error: unknown key 'child_modul'; did you mean 'child_module'?");
}

}  // namespace
}  // namespace gaitlab
