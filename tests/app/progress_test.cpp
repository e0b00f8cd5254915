// Tests of the progress lines, and of the width and colour of what is printed on a terminal.
#include "app/shell/progress.h"

#include <cstdlib>

#include "tests/folders.h"
#include "tests/program/fixture.h"

namespace gaitlab::test {
namespace {

using app::progress_line;

TEST(ProgressLines, FitTheTerminal) {
  EXPECT_EQ(progress_line(0.25, "25 %", 21), "[###          ] 25 %");
  EXPECT_EQ(progress_line(1, "100 %", 200), "[" + std::string(40, '#') + "] 100 %");
  for (std::size_t columns = 40; columns <= 200; ++columns) {
    for (const std::size_t text : {4U, 20U, 28U, 29U, 30U, 60U, 190U, 250U}) {
      for (const double share : {0.0, 0.5, 1.0, 2.0})
        EXPECT_LT(progress_line(share, std::string(text, 'x'), columns).size(), columns) << columns << " " << text;
    }
  }
}

TEST(ProgressLines, ALongTextTakesTheRoomOfTheBar) {
  EXPECT_EQ(progress_line(0.5, std::string(28, 'x'), 40), "[####    ] " + std::string(28, 'x'));
  EXPECT_EQ(progress_line(0.5, std::string(29, 'x'), 40), std::string(29, 'x'));
  EXPECT_EQ(progress_line(0.5, std::string(50, 'x'), 40), std::string(39, 'x'));
}

TEST(ProgressLines, TheTimeLeftIsAtThePaceOfAllThatIsDone) {
  const app::TimeLeft::Time start;
  const app::TimeLeft left(start);
  using std::chrono::seconds;
  EXPECT_EQ(left.text(start + seconds(5), 0, 20), "");
  EXPECT_EQ(left.text(start + seconds(5), 0.1, 19.9), "");
  EXPECT_EQ(left.text(start + seconds(10), 8, 24), "30 s left");
  EXPECT_EQ(left.text(start + seconds(20), 24, 8), "7 s left");
  EXPECT_EQ(left.text(start + seconds(30), 32, 0), "0 s left");
}

TEST(ProgressLines, NoTerminalHasTheWidthThatTheCallerNames) {
  EXPECT_EQ(app::terminal_columns(-1), 80U);
  EXPECT_EQ(app::terminal_columns(-1, 100), 100U);
}

/// Output of a command on a terminal of this width, of which `script` of util-linux makes one; empty without that program.
std::string on_terminal(const Folder& folder, int columns, const std::string& environment, const std::string& arguments) {
  const std::string command = fmt::format("stty cols {}; {} '{}/bin/gaitlab' {}", columns, environment,
                                          std::string(gaitlab::test::build_folder()), arguments);
  folder.write("command.sh", command + "\n");
  const int status = std::system(
      fmt::format("cd '{}' && script -qec 'sh command.sh' out </dev/null >/dev/null 2>&1", folder.path().string()).c_str());
  return WEXITSTATUS(status) == 127 ? "" : read(folder / "out");
}

/// Visible lines: between line breaks, without escape sequences, after the last return to the start of the line.
std::vector<std::string> visible(const std::string& text) {
  std::vector<std::string> lines(1);
  for (std::size_t k = 0; k < text.size(); ++k) {
    if (text[k] == '\n') {
      lines.emplace_back();
    } else if (text[k] == '\r') {
      if (k + 1 < text.size() && text[k + 1] != '\n') lines.emplace_back();
    } else if (text[k] == '\033') {
      k = text.find('m', k);
    } else {
      lines.back() += text[k];
    }
  }
  return lines;
}

class OnTerminal : public ::testing::Test {
 protected:
  OnTerminal() {
    std::filesystem::create_directory_symlink(kScenarios + "modules", folder_ / "modules");
    folder_.write("s.yaml",
                  "gaitlab: 1\nrobot: {modules: mtran, docks: [[1, 1, 4, 0, 0], [1, 2, 4, 1, 0]]}\ncontact: {on: all}\n"
                  "cpg: {type: phase_oscillator, frequency: 1, amplitude: 0.4, phase_lag: 1.2}\n"
                  "physics: {engine: articulated}\nduration: 4\n");
  }
  Folder folder_;
};

TEST_F(OnTerminal, SummaryAndBarFitItsWidth) {
  for (const int columns : {40, 60, 120, 200}) {
    const std::string out = on_terminal(folder_, columns, "", fmt::format("run s.yaml --no-report --out r{}", columns));
    if (out.empty()) GTEST_SKIP() << "no `script`";
    std::size_t longest = 0;
    for (const std::string& line : visible(out)) {
      if (line.starts_with("Script") || line.find(':') == 6) continue;
      longest = std::max(longest, line.size());
    }
    EXPECT_LE(longest, static_cast<std::size_t>(columns)) << out;
    EXPECT_TRUE(contains(out, "feasible with")) << out;
  }
}

TEST_F(OnTerminal, ColoursTheVerdict) {
  const std::string good = on_terminal(folder_, 100, "", "run s.yaml --no-report --out good");
  if (good.empty()) GTEST_SKIP() << "no `script`";
  EXPECT_TRUE(contains(good, "verdict   \033[32mfeasible")) << good;
  const std::string bad = on_terminal(folder_, 100, "", "run s.yaml --no-report --set actuator.i_max=0.1 --out bad");
  EXPECT_TRUE(contains(bad, "verdict   \033[31minfeasible")) << bad;
  const std::string plain = on_terminal(folder_, 100, "NO_COLOR=1", "run s.yaml --no-report --out plain");
  EXPECT_TRUE(contains(plain, "verdict   feasible")) << plain;
  EXPECT_FALSE(contains(plain, "\033[3")) << plain;
  EXPECT_FALSE(contains(gaitlab("run s.yaml --no-report --out file", folder_ / "").out, "\033"));
}

}  // namespace
}  // namespace gaitlab::test
