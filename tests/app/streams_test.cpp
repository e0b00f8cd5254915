// Tests of the output streams of the program: output to a full disk, control characters in messages, threads without memory.
#include "tests/folders.h"
#include "tests/program/fixture.h"

namespace gaitlab::test {
namespace {

class Streams : public ::testing::Test {
 protected:
  Streams() {
    std::filesystem::create_directory_symlink(kScenarios + "modules", folder_ / "modules");
    folder_.write("ok.yaml", "gaitlab: 1\nrobot: {modules: mtran, docks: [[1, 1, 4, 0, 0]]}\nduration: 0.1\n");
  }
  Result call(const std::string& arguments) { return gaitlab(arguments, folder_.path()); }
  /// Calls the program by a shell, with the texts `before` and `after` around the call.
  Result shell(const std::string& before, const std::string& arguments, const std::string& after = "") {
    const std::string command = "cd '" + folder_.path().string() + "' && " + before + " '" +
                                std::string(gaitlab::test::build_folder()) + "/bin/gaitlab' " + arguments + " 2>err " + after;
    const int status = std::system(("bash -c \"" + command + "\"").c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, "", read(folder_ / "err")};
  }

  Folder folder_;
};

TEST_F(Streams, WhatCannotBePrintedIsAnError) {
  for (const char* words : {"--help", "--version", "run --help", "help run", "new plugin --help", "list", "list module",
                            "explain", "explain cpg hopf", "explain module mtran", "schema", "check ok.yaml"}) {
    for (const char* stream : {">/dev/full", ">&-"}) {
      const Result result = shell("", words, stream);
      EXPECT_EQ(result.code, 1) << words << stream;
      EXPECT_TRUE(result.err.starts_with("gaitlab: error: ")) << words << stream << ": " << result.err;
    }
  }
}

TEST_F(Streams, AFileIsNotTakenForAClosedStream) {
  EXPECT_EQ(shell("", "run ok.yaml --out run", ">&- <&-").code, 1);
  EXPECT_EQ(call("rerun run --verify").code, 0);
  EXPECT_EQ(gaitlab("run ok.yaml --out silent 2>&-", folder_.path()).code, 0);
  EXPECT_EQ(call("rerun silent --verify").code, 0);
}

TEST_F(Streams, MessagesHoldNoControlCharacters) {
  const Result name = call("check '\x1b[31mred\n.yaml'");
  EXPECT_EQ(name.code, 2);
  EXPECT_EQ(name.err, "\\x1b[31mred\\x0a.yaml: error: cannot be read: No such file or directory\n");
  folder_.write("nul.yaml",
                "gaitlab: 1\nrobot: {modules: mtran}\nduration: 1\n"
                "cpg: {type: equations, model: {states: {phi: \"1\\0+2\"}, output: phi}}\n");
  const Result nul = call("check nul.yaml");
  EXPECT_EQ(nul.code, 2);
  EXPECT_TRUE(nul.err.starts_with("nul.yaml:4:48: error: found '\\x00'")) << nul.err;
  EXPECT_TRUE(nul.err.ends_with("\n")) << nul.err;
  const Result second = call(
      "check '\xc2\x9b"
      "31mred.yaml'");  // escape sequence with a control character of the set C1
  EXPECT_TRUE(second.err.starts_with("\\xc2\\x9b31mred.yaml: error: ")) << second.err;
}

TEST_F(Streams, ANoteOfAFileWithAnOddNameIsOneLine) {
  folder_.write("a\nb.yaml", "gaitlab: 1\nname: ok\nrobot: {modules: mtran, position: [0, 0, -1]}\nduration: 0.1\n");
  const Result result = call("check 'a\nb.yaml'");
  EXPECT_EQ(result.err.find("a\nb"), std::string::npos) << result.err;
  EXPECT_TRUE(result.err.starts_with("a\\x0ab.yaml:3:")) << result.err;
}

TEST_F(Streams, NamesOfFilesArePrintedWithoutThem) {
  ASSERT_EQ(call("run ok.yaml --quiet --out run").code, 0);
  const Result result = call("export run --to csv '\x1b[31mred.csv'");
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_TRUE(result.out.starts_with("\\x1b[31mred.csv: 21 rows of ")) << result.out;
}

TEST_F(Streams, ThreadsWithoutRoomAreTold) {
  // Each thread requests a stack of 4 GB, which exceeds the limit of the whole program.
  const std::string limits = "ulimit -s 4000000; ulimit -v 3900000;";
  if (shell(limits, "--version", ">out").code != 0) GTEST_SKIP() << "a sanitizer, which reserves more than any limit";
  const Result few = shell(limits, "converge ok.yaml --quiet -j 4", ">out");
  EXPECT_EQ(few.code, 0) << few.err;
  EXPECT_TRUE(few.err.starts_with("gaitlab: warning: thread 2 of ")) << few.err;
  EXPECT_TRUE(contains(
      few.err, " cannot be started (Resource temporarily unavailable); the work continues with 1; take fewer threads with -j"))
      << few.err;
  const std::string shown = read(folder_ / "out");
  EXPECT_EQ(shown, call("converge ok.yaml --quiet -j 4").out);
}

TEST_F(Streams, FewMessagesAndShortOnes) {
  std::string patterns;
  for (int k = 0; k < 900; ++k) patterns += fmt::format("{}none{}*", k > 0 ? ", " : "", k);
  folder_.write("many.yaml", "gaitlab: 1\nrobot: {modules: mtran}\nduration: 1\ntrace: {columns: [" + patterns + "]}\n");
  const Result many = call("check many.yaml");
  EXPECT_EQ(many.code, 2);
  EXPECT_EQ(std::count(many.err.begin(), many.err.end(), '\n'), 201);
  EXPECT_TRUE(many.err.ends_with("\nmany.yaml: error: 700 more errors\n")) << many.err.substr(many.err.size() - 200);

  folder_.write("long.yaml",
                "gaitlab: 1\nrobot: {modules: mtran}\nduration: 1\ntrace: {columns: [" + std::string(400000, 'x') + "]}\n");
  const Result longest = call("check long.yaml");
  EXPECT_EQ(longest.code, 2);
  EXPECT_TRUE(longest.err.starts_with("long.yaml:4:18: error: 'xxxxxxxx")) << longest.err.substr(0, 100);
  EXPECT_TRUE(contains(longest.err, "xxx...' matches no column; ")) << longest.err.substr(0, 200);
  EXPECT_LT(longest.err.size(), 300U);

  std::string more = patterns;
  for (int k = 0; k < 101; ++k) more += ", joint.*";
  folder_.write("list.yaml", "gaitlab: 1\nrobot: {modules: mtran}\nduration: 1\ntrace: {columns: [" + more + "]}\n");
  EXPECT_EQ(call("check list.yaml").err,
            "list.yaml:4:18: error: has 1001 names and patterns; expected at most 1000: a pattern with * and ? selects many "
            "columns\n");
}

}  // namespace
}  // namespace gaitlab::test
