// Tests of the page of an identification: its numbers are those of the terminal, names from files are text, and neither threads
// nor long logs change it much.
#include <cmath>
#include <regex>

#include "tests/program/fixture.h"

namespace gaitlab::test {
namespace {

namespace fs = std::filesystem;

const std::string kPayload = "<img src=x onerror=alert(1)>";

class IdentifyPage : public ::testing::Test {
 protected:
  IdentifyPage() {
    folder_.write("lever.yaml",
                  "gaitlab_module: 1\nname: lever\nbodies:\n  base: {mass: 1, inertia: [1, 1, 1, 0, 0, 0]}\n"
                  "  arm: {mass: 0.5, com: [0, 0, -0.15], inertia: [1e-4, 1e-4, 1e-4, 0, 0, 0]}\n"
                  "hinges: [{name: hinge, parent: base, child: arm, axis: [0, 1, 0], range: free}]\n");
    write_log("slow.csv", 4, 0.01);
    write_log("fast.csv", 8, 0.01);
    write_log(kPayload + ".csv", 6, 0.01);
    folder_.write("bench.yaml",
                  "gaitlab: 1\nrobot: {modules: ./lever.yaml, base: fixed, position: [0, 0, 1]}\nground: {type: none}\n"
                  "contact: {\"on\": none}\nphysics: {engine: articulated, estimate: off}\nduration: 1\n"
                  "actuator: {type: servo, voltage: 6, stall_torque: 1.5, no_load_speed: 6}\n"
                  "controller: {type: rc_servo, gain: 3, period: 0.005}\ncpg: {type: table, model: {file: log.csv, time: t, "
                  "columns: {m0/hinge: goal}, interpolation: linear, repeat: false}}\nmeasured: {file: log.csv, \"on\": power, "
                  "source: \"<i>bench</i> of 3 May, CC BY 4.0\", columns: {m0/hinge: {angle: angle, duty: duty}}}\n");
  }
  /// Rows of a lagging sine of this rate, rad/s, that are `row` s apart; the torque is off in the last fifth.
  void write_log(const std::string& name, double rate, double row) {
    std::string log = "t,goal,angle,duty,power\n";
    const int rows = static_cast<int>(1 / row);
    for (int k = 0; k <= rows; ++k) {
      const double t = row * k;
      log += fmt::format("{},{},{:.4f},{:.3f},{}\n", t, 0.6 * std::sin(rate * t), 0.5 * std::sin(rate * (t - 0.08)),
                         std::min(1.0, 0.9 + 0.2 * std::sin(rate * t)), t < 0.8 ? 1 : 0);
    }
    folder_.write(name, log);
  }
  /// The call that writes the page `name`.
  Result call(const std::string& name, const std::string& more = "") {
    return gaitlab("identify bench.yaml slow.csv fast.csv '" + kPayload + ".csv' --hold-out '<*' --fit actuator.dry_friction " +
                       "--page " + name + more,
                   folder_ / "");
  }
  Folder folder_;
};

TEST_F(IdentifyPage, HasTheNumbersOfTheTerminalAndNoMarkupOfFiles) {
  const Result one = call("one.html", " --to own.yaml");
  ASSERT_EQ(one.code, 0) << one.err;
  EXPECT_TRUE(contains(one.out, "\nthe page is in one.html\n")) << one.out;
  const std::string page = read(folder_ / "one.html");

  // Rows of the terminal's tables begin with two blanks, and their cells are two blanks apart.
  const std::string cells = std::regex_replace(page, std::regex("<wbr>"), "");
  std::smatch row;
  ASSERT_TRUE(std::regex_search(one.out, row, std::regex("\n  actuator.dry_friction +(\\S+)  (.+?)  +N m  +(\\S+)  +-\n")))
      << one.out;
  for (std::size_t i = 1; i < 4; ++i) EXPECT_TRUE(contains(cells, "<td>" + row[i].str() + "</td>")) << row[i];
  for (const char* logs : {"fitted logs", "held-out logs"}) {
    ASSERT_TRUE(std::regex_search(one.out, row,
                                  std::regex(std::string("\n  angle  +") + logs + "  +\\d  +(\\S+ mrad)  +(\\S+ mrad)\n")))
        << one.out;
    EXPECT_TRUE(contains(cells, "<td>" + row[1].str() + "</td><td>" + row[2].str() + "</td>")) << logs;
  }
  // Logs are in the order of the terminal.
  std::size_t at = 0;
  std::string rest = one.out.substr(one.out.find("\n  log "));
  const std::regex of_log("\n  (slow|fast|<img src=x onerror=alert\\(1\\)>) .*?(\\S+ mrad) +(\\S+ mrad) +(\\S+) +(\\S+)(?=\n)");
  for (int i = 0; i < 3; ++i, rest = row.suffix()) {
    ASSERT_TRUE(std::regex_search(rest, row, of_log)) << rest;
    const std::string caption = fmt::format("{} identified, {} bench; at the limit {} of the time, {} in the log", row[3].str(),
                                            row[2].str(), row[4].str(), row[5].str());
    at = page.find(caption, at);
    ASSERT_NE(at, std::string::npos) << caption;
  }

  EXPECT_TRUE(contains(page, "&lt;img src=x onerror=alert(1)&gt;"));
  for (const char* markup : {"<img", "<i>bench", "<script", "http:", "https:", "url("})
    EXPECT_FALSE(contains(std::regex_replace(page, std::regex(" xmlns=\"[^\"]*\""), ""), markup)) << markup;
  EXPECT_TRUE(contains(page, "logs: &lt;i&gt;bench&lt;/i&gt; of 3 May, CC BY 4.0"));
  EXPECT_TRUE(contains(read(folder_ / "own.yaml"), "<i>bench</i> of 3 May, CC BY 4.0"));
  const auto count = [&](const std::string& part) {
    const std::regex of(part);
    return std::distance(std::sregex_iterator(page.begin(), page.end(), of), {});
  };
  EXPECT_EQ(count("<svg"), 3);
  EXPECT_EQ(count("<i>held out</i>"), 1);
  EXPECT_EQ(count("<rect [^>]*fill=\"#E4E4E4\""), 2 * 2 * 3);  // no torque: in both panels of both quantities of each log

  EXPECT_EQ(call("two.html", " -j 2").code, 0);
  // The text of the servo has its name, which is that of its file.
  const auto unnamed = [](const std::string& text) { return std::regex_replace(text, std::regex("\nname: \\w+\n"), "\n"); };
  EXPECT_EQ(unnamed(read(folder_ / "two.html")), unnamed(page));
}

TEST_F(IdentifyPage, DrawsWhatPixelsShow) {
  // Without thinning 20 times as many rows would take 20 times as much.
  ASSERT_EQ(call("short.html").code, 0);
  for (const char* log : {"slow.csv", "fast.csv"}) write_log(log, log[0] == 's' ? 4 : 8, 0.0005);
  write_log(kPayload + ".csv", 6, 0.0005);
  const Result result = call("long.html");
  ASSERT_EQ(result.code, 0) << result.err;
  // Each curve has at most two points per px of 374, of 12 characters; five curves of each of two quantities in a figure.
  constexpr std::size_t kFigure = 2UL * 5 * 2 * 374 * 12;
  EXPECT_LT(fs::file_size(folder_ / "long.html"), fs::file_size(folder_ / "short.html") + 3 * kFigure);
}

TEST_F(IdentifyPage, IsRefusedBeforeTheFit) {
  folder_.write("there.html", "mine");
  const Result there = call("there.html");
  EXPECT_EQ(there.code, 2);
  EXPECT_EQ(there.err, "there.html: error: exists; nothing was written\n");
  EXPECT_EQ(read(folder_ / "there.html"), "mine");
  const Result same = call("own.html", " --to ./own.html");
  EXPECT_EQ(same.code, 2);
  EXPECT_EQ(same.err, "--page: error: is the file of --to; expected another one\n");
  EXPECT_FALSE(fs::exists(folder_ / "own.html"));
}

}  // namespace
}  // namespace gaitlab::test
