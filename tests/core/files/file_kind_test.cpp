// Tests of the kinds of files, which are recognised by their content.
#include "core/files/file_kind.h"

#include <gtest/gtest.h>

#include "tests/folder.h"

namespace gaitlab {
namespace {

TEST(FileKinds, ByKeysAtTheBeginningOfLines) {
  EXPECT_EQ(kind_of_text("gaitlab: 1\nrobot: {modules: mtran}\nduration: 1\n"), FileKind::scenario);
  EXPECT_EQ(kind_of_text("robot:\n  modules: mtran\n"), FileKind::scenario);
  EXPECT_EQ(kind_of_text("gaitlab: 1\nduration: soon\n"), FileKind::scenario);
  EXPECT_EQ(kind_of_text("# a comment\ngaitlab_module: 1\nname: a\n"), FileKind::module);
  EXPECT_EQ(kind_of_text("name: a\nbodies: {}\n"), FileKind::module);
  EXPECT_EQ(kind_of_text("gaitlab_study: 1\n"), FileKind::study);
  EXPECT_EQ(kind_of_text("scenario: a.yaml\nparameters: {}\n"), FileKind::study);
  EXPECT_EQ(kind_of_text("scenarios: {a: a.yaml}\r\nparameters:\r\n"), FileKind::study);
  EXPECT_EQ(kind_of_text("gaitlab: 1\nruns: {a: b}\npanels: []\n"), FileKind::recipe);
}

TEST(FileKinds, OfNoKind) {
  for (const char* text : {"", "\n# nothing\n", "name: a\n", "gaitlab: 1\n", "notes: {robot: 1}\n", "  robot: 1\n", "robot:1\n",
                           "{\"robot\": 1}\n", "scenario: a.yaml\n", "1 2 3\n", "a text\nrobotics: 1\n"})
    EXPECT_FALSE(kind_of_text(text)) << text;
}

TEST(FileKinds, ABuildFileHasRowsOfFiveWholeNumbers) {
  EXPECT_EQ(kind_of_text("1 1 4 0 0\n"), FileKind::robot);
  EXPECT_EQ(kind_of_text("# two docks\n\n 1 1\t4 0 0   # first\n1 2 4 1 0"), FileKind::robot);
  EXPECT_FALSE(kind_of_text("1 1 4 0 0\n1 2 4 1\n"));
  EXPECT_FALSE(kind_of_text("1 1 4 0 0.5\n"));
  EXPECT_FALSE(kind_of_text("1 1 4 0 0 0\n"));
}

TEST(FileKinds, FilesAndFolders) {
  const test::Folder folder;
  EXPECT_FALSE(kind_of_file(folder / "none.yaml"));
  EXPECT_FALSE(kind_of_file(folder.path().string()));
  EXPECT_EQ(kind_of_file(folder.write("m.yaml", "gaitlab_module: 1\n")), FileKind::module);
  folder.write("trace.csv", "t\n0\n");
  EXPECT_EQ(kind_of_file(folder.path().string()), FileKind::run);
  EXPECT_FALSE(of_another_kind(folder / "m.yaml", FileKind::module));
  EXPECT_FALSE(of_another_kind(folder / "trace.csv", FileKind::scenario));
  EXPECT_NO_THROW(expect_kind(folder / "none.yaml", FileKind::scenario));
  EXPECT_THROW(expect_kind(folder / "m.yaml", FileKind::scenario), InputError);
  const auto problem = of_another_kind(folder.write("s.yaml", "# one\nrobot: {}\n"), FileKind::study);
  ASSERT_TRUE(problem);
  EXPECT_EQ(problem->place.line, 2);
  EXPECT_EQ(problem->text, "this is a scenario, not a study; run it with gaitlab run " + (folder / "s.yaml"));
}

}  // namespace
}  // namespace gaitlab
