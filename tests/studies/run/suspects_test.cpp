// Tests of runs that are tried in separate processes: the ends of a process that count as a crash of the run.
#include "studies/run/suspects.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <stdexcept>

#include "tests/studies/small_study.h"

namespace gaitlab::test {
namespace {

using studies::Row;

/// A CPG that ends its process by a signal or an exit code, throws, or does nothing.
struct EndingCpg final : Cpg {
  struct Settings {
    std::int64_t signal = 0, code = -1;
    bool throws = false;
    void fields(Fields& f) {
      f.integer("signal", signal, {"", 0, 64, "Ends the process by this signal; 0: none."});
      f.integer("code", code, {"", -1, 255, "Ends the process with this exit code; -1: does not."});
      f.flag("throws", throws, "Throws.");
    }
  };
  EndingCpg(const RobotInfo&, const Settings& given) : settings(given) {}
  void output(double, In, Out setpoint) const override {
    if (settings.signal != 0) {
      const auto number = static_cast<int>(settings.signal);
      std::signal(number, SIG_DFL);  // a sanitizer may have taken it
      (void)std::raise(number);
    }
    if (settings.code >= 0) ::_exit(static_cast<int>(settings.code));
    if (settings.throws) throw std::runtime_error("no");
    for (double& value : setpoint) value = 0;
  }
  Settings settings;
};

Catalog& catalog_with_ends() {
  static Catalog all = [] {
    Catalog made = app::standard_catalog();
    add_cpg<EndingCpg>(made, "ends", "Ends its process.");
    return made;
  }();
  return all;
}

/// A study with one key of this CPG as its parameter.
SmallStudy ending(const std::string& key, const std::string& values) {
  return SmallStudy("set: [cpg.type=ends]\nguards: none\nparameters: {cpg." + key + ": {values: [" + values + "]}}\n",
                    studies::Purpose::sweep, catalog_with_ends());
}

std::vector<Row> crashes(const SmallStudy& study, const std::vector<std::uint64_t>& runs, int jobs = 2) {
  const std::atomic<bool> stop = false;
  return studies::crashes_of(*study.plan, runs, jobs, stop);
}

TEST(Suspects, CrashBySignalsOfTheirOwn) {
  const SmallStudy study = ending("signal", "0, 4, 5, 6, 7, 8, 11, 31");  // ILL, TRAP, ABRT, BUS, FPE, SEGV, SYS
  for (const int jobs : {1, 3}) {
    const std::vector<Row> rows = crashes(study, {7, 0, 1, 2, 3, 4, 5, 6}, jobs);
    ASSERT_EQ(rows.size(), 7U);
    for (std::size_t k = 0; k < rows.size(); ++k) {
      const Row known = study.plan->row(k + 1);
      EXPECT_EQ(rows[k].run, known.run) << "in order of their numbers";
      EXPECT_EQ(rows[k].point, known.point);
      EXPECT_EQ(rows[k].values, known.values);
      EXPECT_EQ(rows[k].outcome, "crashed");
      EXPECT_EQ(rows[k].message, "the process ended by signal " + known.values[0]);
      EXPECT_EQ(rows[k].verdict, Word::failed);
      EXPECT_FALSE(rows[k].score.has_value());
    }
  }
}

/// The signals kill, interrupt, terminate, hang up and CPU time are not caused by the run, which is tried again.
TEST(Suspects, DoNotCrashBySignalsFromOutside) {
  EXPECT_TRUE(crashes(ending("signal", "9, 2, 15, 1, 24"), {0, 1, 2, 3, 4}).empty());
}

TEST(Suspects, DoNotCrashByAnExitOrAnException) {
  EXPECT_TRUE(crashes(ending("code", "0, 1, 134"), {0, 1, 2}).empty());
  EXPECT_TRUE(crashes(ending("throws", "true, false"), {0, 1}).empty());
}

TEST(Suspects, DoNotBeginWhenTheStudyIsStopped) {
  const SmallStudy study = ending("signal", "6, 11");
  const std::atomic<bool> stop = true;
  const std::vector<std::uint64_t> runs{0, 1};
  EXPECT_TRUE(studies::crashes_of(*study.plan, runs, 2, stop).empty());
  EXPECT_TRUE(crashes(study, {}).empty());
  EXPECT_EQ(crashes(study, {1}, 0).size(), 1U) << "without jobs one at a time";
}

}  // namespace
}  // namespace gaitlab::test
