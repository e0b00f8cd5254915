// Tests of the CPG `table`: equal set points as with keyframes, a table file next to the scenario, error messages.
#include "cpg/table.h"

#include "core/scenario/read_scenario.h"
#include "core/scenario/resolved.h"
#include "tests/messages.h"
#include "tests/program/fixture.h"

namespace gaitlab::test {
namespace {

using namespace cpg;

const std::string kCsv = "# measured\ntime, m0/passive\n0, 0.1\n0.3, 0.5\n\n1, 0.1\r\n";
const std::string kTableHead = "gaitlab: 1\nrobot: {modules: mtran}\nduration: 0.06\n";

class TableGait : public ::testing::Test {
 protected:
  TableGait() {
    for (const char* name : {"modules", "robots"}) std::filesystem::create_directory_symlink(kScenarios + name, folder / name);
  }
  Scenario read_with(const std::string& model) {
    return read_scenario(folder.write("s.yaml", kTableHead + "cpg:\n  type: table\n  model: " + model + "\n"), {}, catalog());
  }
  std::string error(const std::string& csv) {
    folder.write("gait.csv", csv);
    const std::string text = message_of([&] { read_with("{file: gait.csv}"); });
    return text == kNoError ? text : text.substr(text.find("error: ") + 7);
  }
  static std::vector<double> setpoints(const Scenario& s) {
    const void* settings = s.cpg.settings.get();
    const std::unique_ptr<Cpg> cpg(static_cast<Cpg*>(s.cpg.entry->make(info(*s.robot), {&settings, 1})));
    std::vector<double> all, q(s.robot->joints.size());
    for (int i = 0; i < 200; ++i) {
      cpg->output(0.01 * i, {}, q);
      all.insert(all.end(), q.begin(), q.end());
    }
    return all;
  }
  Folder folder;
};

TEST_F(TableGait, MovesAsTheSameKeyframes) {
  folder.write("gait.csv", kCsv);
  const Scenario table = read_with("{file: gait.csv}");
  const Scenario frames = scenario(
      kTableHead +
      "cpg: {type: keyframes, model: {frames: [{time: 0, angles: {m0/passive: 0.1}}, {time: 0.3, angles: {m0/passive: 0.5}}, "
      "{time: 1, angles: {m0/passive: 0.1}}]}}\n");
  EXPECT_EQ(setpoints(table), setpoints(frames));
}

TEST_F(TableGait, TheResolvedScenarioHoldsTheText) {
  folder.write("gait.csv", kCsv);
  const std::string once = resolved(read_with("{file: gait.csv}"));
  const Folder elsewhere;
  const Scenario again = read_scenario(elsewhere.write("r.yaml", once), {}, catalog());
  EXPECT_EQ(resolved(again), once);
  EXPECT_EQ(setpoints(again), setpoints(read_with("{file: gait.csv}")));
}

TEST_F(TableGait, ALogHasItsOwnClockAndColumns) {
  folder.write("gait.csv", kCsv);
  folder.write("log.csv", "clock,pwm,goal\n7.25,1,0.1\n7.55,2,0.5\n8.25,3,0.1\n");
  const std::vector<double> log = setpoints(read_with("{file: log.csv, time: clock, columns: {m0/passive: goal}}"));
  const std::vector<double> gait = setpoints(read_with("{file: gait.csv}"));
  ASSERT_EQ(log.size(), gait.size());
  for (std::size_t i = 0; i < log.size(); ++i) EXPECT_NEAR(log[i], gait[i], 1e-13);  // rounding of times from 7.25 s on
}

TEST_F(TableGait, AColumnHasAScale) {
  folder.write("gait.csv", kCsv);
  folder.write("log.csv", "t,ticks\n0,10\n0.3,50\n1,10\n");
  EXPECT_EQ(setpoints(read_with("{file: log.csv, time: t, columns: {1: {column: ticks, scale: 100}}}")),
            setpoints(read_with("{file: gait.csv}")));
}

TEST_F(TableGait, ErrorsNameLineAndColumn) {
  const std::string at = "the table's line ";
  EXPECT_NE(error("x,0\n0,0\n1,0\n").find(at + "1, column 1: expected the column time; found 'x'"), std::string::npos);
  EXPECT_NE(error("time, 7\n").find(at + "1, column 7: no joint '7'"), std::string::npos);
  EXPECT_NE(error("time,0,m0/active\n").find(at + "1, column 8: joint 'm0/active' has a column already"), std::string::npos);
  EXPECT_NE(error("time,0\n0,0\n1\n").find(at + "3, column 1: 1 cells; expected 2"), std::string::npos);
  EXPECT_NE(error("time,0\n0, nan\n").find(at + "2, column 4: 'nan' is not a finite number"), std::string::npos);
  EXPECT_NE(error("time,0\n0,0\n0,0\n").find(at + "3, column 1: times must rise"), std::string::npos);
  EXPECT_NE(error("").find("table is empty"), std::string::npos);
  EXPECT_NE(error("time,0\n0,0\n1,1\n").find("the last frame differs from the first at joint m0/active"), std::string::npos);
  const auto refused = [&](const std::string& columns, const std::string& text) {
    const std::string found = message_of([&] { read_with("{file: gait.csv, columns: " + columns + "}"); });
    EXPECT_NE(found.find(text), std::string::npos) << found;
  };
  refused("{m0/active: '0', 0: '0'}", "s.yaml:6:53: error: joint '0' has a column already");
  refused("{m0/activ: '0'}", "s.yaml:6:37: error: no joint 'm0/activ'; did you mean 'm0/active'?");
  refused("{7: '0'}", "joint is 7; the robot has 2 joints, numbered from 0");
  refused("[a]", "columns is a list; expected a map JOINT: COLUMN");
  refused("{0: goal}", "there is no column 'goal'");
  EXPECT_THROW(read_with("{file: none.csv}"), InputError);
  EXPECT_THROW(read_with("{file: [1]}"), InputError);
}

}  // namespace
}  // namespace gaitlab::test
