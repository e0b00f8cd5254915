// Tests of the messages in tests/data/messages: inputs of new users, each with what the program prints.
#include <sstream>

#include "tests/folders.h"
#include "tests/program/fixture.h"

namespace gaitlab::test {
namespace {

/// A part of a table: a file to write (`file NAME`), or a call of the program (`$ ARGUMENTS`, or `$0` for one that succeeds),
/// with its lines. SCENARIOS/ is the folder of the shipped scenarios. The lines of a call are what it prints on stderr; `...`
/// at the end stands for any further lines, and `| TEXT` for a text within stdout.
struct TablePart {
  std::string head;
  std::vector<std::string> lines = {};
};

/// Parts of a table. Lines of a part are indented by four blanks; lines with # in front are comments.
std::vector<TablePart> parts_of_table(const std::string& text) {
  constexpr const char* kIndent = "    ";
  std::vector<TablePart> parts;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with(kIndent) && !parts.empty()) {
      parts.back().lines.push_back(line.substr(4));
    } else if (!line.empty() && line[0] != '#') {
      parts.push_back({line});
    }
  }
  return parts;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

class MessageTable : public ::testing::TestWithParam<const char*> {
 protected:
  MessageTable() {
    for (const char* name : {"modules", "robots"}) std::filesystem::create_directory_symlink(kScenarios + name, folder_ / name);
    folder_.write("ok.yaml", "gaitlab: 1\nrobot: {modules: mtran, docks: [[1, 1, 4, 0, 0]]}\nduration: 0.1\n");
  }

  void call(const TablePart& part) {
    const bool succeeds = part.head.starts_with("$0");
    const std::string arguments = replaced(part.head.substr(part.head.find(' ') + 1), "SCENARIOS/", kScenarios);
    const Result result = gaitlab(part.head.size() <= 2 ? "" : arguments, folder_.path());
    std::string expected;
    bool open = false;
    for (const std::string& line : part.lines) {
      if (line.starts_with("| ")) {
        EXPECT_TRUE(contains(result.out, line.substr(2))) << part.head << "\n" << line << "\n" << result.out;
      } else if (line == "...") {
        open = true;
      } else {
        expected += line + "\n";
      }
    }
    std::string err = replaced(result.err, kScenarios, "SCENARIOS/");
    if (open) err = err.substr(0, expected.size());
    EXPECT_EQ(result.code, succeeds ? 0 : 2) << part.head << "\n" << result.err;
    EXPECT_EQ(err, expected) << part.head;
  }

  Folder folder_;
};

TEST_P(MessageTable, IsWhatTheProgramPrints) {
  const std::string file = std::string(gaitlab::test::source_folder()) + "/tests/data/messages/" + GetParam();
  std::size_t calls = 0;
  for (const TablePart& part : parts_of_table(read(file))) {
    if (part.head.starts_with("file ")) {
      std::string text;
      for (const std::string& line : part.lines) text += line + "\n";
      folder_.write(part.head.substr(5), text);
    } else {
      call(part);
      ++calls;
    }
  }
  EXPECT_GT(calls, 0U) << file;
}

std::string table_name(const ::testing::TestParamInfo<const char*>& table) {
  const std::string name = table.param;
  return name.substr(0, name.find('.'));
}

INSTANTIATE_TEST_SUITE_P(All, MessageTable,
                         ::testing::Values("files.txt", "keys.txt", "modules.txt", "names.txt", "robots.txt", "studies.txt",
                                           "yaml.txt"),
                         table_name);

}  // namespace
}  // namespace gaitlab::test
