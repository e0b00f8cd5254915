// Trace rows and the end of a run do not change the steps of an integrator that chooses its steps, although they may be within
// a step.
#include <cstring>
#include <map>
#include <mutex>

#include "core/model/pattern.h"
#include "core/simulation/batch.h"
#include "tests/labels.h"
#include "tests/program/bits.h"
#include "tests/program/fixture.h"

namespace gaitlab::test {
namespace {

// Whole walks of both engines.
const Label kRowsOfWalks("Rows.ChangeNothing:Rows.AShortRun*:Rows.AreTheSame*", "long;unsanitized");

namespace fs = std::filesystem;

struct End {
  Recording record;
  std::vector<double> state;  ///< complete state of the simulation at the end
};

End simulate(const Scenario& s) {
  Simulation simulation({&s, 1});
  simulation.run();
  const Out state = simulation.state();
  return {simulation.take_recording(0), {state.begin(), state.end()}};
}

std::vector<double> times(const Trace& trace) {
  std::vector<double> t;
  for (std::size_t k = 0; k < trace.rows(); ++k) t.push_back(trace.at(k, 0));
  return t;
}

/// Values of row k that do not depend on the selected columns of the trace.
std::vector<double> row(const Recording& r, std::size_t k) {
  std::vector<double> all;
  for (const Trace* table : {&r.trace, &r.rest}) {
    for (const Column& column : table->columns) {
      const auto covers = [&](const std::string& pattern) { return glob(pattern, column.name); };
      if (std::ranges::any_of(report_columns(), covers)) all.push_back(table->at(k, table->find(column.name)));
    }
  }
  return all;
}

/// Number of rows of two runs at equal times. Expects that times which differ by less than 1e-9 s and their rows have equal
/// bits.
int same_rows(const Recording& a, const Recording& b) {
  int same = 0;
  const std::vector<double> ta = times(a.trace);
  const std::vector<double> tb = times(b.trace);
  for (std::size_t i = 0, j = 0; i < ta.size() && j < tb.size();) {
    if (std::abs(ta[i] - tb[j]) < 1e-9) {
      EXPECT_EQ(ta[i], tb[j]);
      EXPECT_EQ(row(a, i), row(b, j)) << "t = " << ta[i];
      ++same;
    }
    if (ta[i] < tb[j]) {
      ++i;
    } else {
      ++j;
    }
  }
  return same;
}

const std::vector<std::string> kArticulated{"physics.engine=articulated"};

std::vector<std::string> with(std::vector<std::string> sets) {
  sets.insert(sets.begin(), kArticulated.begin(), kArticulated.end());
  return sets;
}

/// Runs of the tests: the hexapod at its current limit, and the caterpillar at the largest speed of its motors.
const std::vector<std::pair<std::string, std::vector<std::string>>> kRuns{
    {"hexapod.yaml", {"actuator.i_max=0.3"}},
    {"caterpillar.yaml", {"cpg.amplitude=1.5", "cpg.frequency=1", "cpg.phase_lag=0.4"}}};

TEST(Rows, ChangeNothing) {
  const std::vector<std::vector<std::string>> traces{{"trace.period=1e-3"},
                                                     {"trace.period=7e-3"},
                                                     {"trace.period=0.0113"},
                                                     {"trace.period=2.7e-4"},
                                                     {"trace.period=1"},
                                                     {"trace.columns=[t]"},
                                                     {"trace.columns=['*']", "trace.period=0.0113"}};
  for (const auto& [file, sets] : kRuns) {
    for (const char* duration : {"duration=0.36", "duration=0.3127"}) {
      std::vector<std::string> plain = with(sets);
      plain.push_back(duration);
      const End first = simulate(shipped(file, plain));
      EXPECT_GT(first.record.tally.solves, 0);
      for (const auto& trace : traces) {
        std::vector<std::string> all = plain;
        all.insert(all.end(), trace.begin(), trace.end());
        const std::string what = fmt::format("{} {}", file, fmt::join(all, " "));
        const End other = simulate(shipped(file, all));
        EXPECT_EQ(bits(other.record), bits(first.record)) << what;
        EXPECT_EQ(other.state, first.state) << what;
        EXPECT_GE(same_rows(first.record, other.record), 2) << what;
      }
    }
  }
}

TEST(Rows, OfOneTimeAreTheSameBits) {
  for (const auto& [file, sets] : kRuns) {
    std::vector<Recording> runs;
    for (const char* period : {"1e-3", "5e-3", "7e-3", "0.0113"}) {
      std::vector<std::string> all = with(sets);
      all.insert(all.end(), {"duration=0.36", fmt::format("trace.period={}", period)});
      runs.push_back(run(shipped(file, all)));
    }
    EXPECT_EQ(same_rows(runs[0], runs[1]), 73);  // 0, 5 .. 360 ms
    EXPECT_EQ(same_rows(runs[0], runs[2]), 53);  // 0, 7 .. 357, 360 ms
    EXPECT_EQ(same_rows(runs[1], runs[2]), 12);  // 0, 35 .. 350, 360 ms
    EXPECT_EQ(same_rows(runs[0], runs[3]), 5);   // 0, 113, 226, 339, 360 ms
  }
}

TEST(Rows, ARunEndsWithARowAtItsDuration) {
  for (const double duration : {0.3127, 0.3, 0.0031, 0.005, 0.00501, 0.1999999, 0.2000001, 0.1130}) {
    for (const char* period : {"5e-3", "0.0113", "1"}) {
      const Recording r =
          run(shipped("hexapod.yaml", with({fmt::format("duration={}", duration), fmt::format("trace.period={}", period)})));
      const std::vector<double> t = times(r.trace);
      ASSERT_GE(t.size(), 2U);
      EXPECT_DOUBLE_EQ(t.back(), duration) << period;
      EXPECT_DOUBLE_EQ(r.simulated, duration) << period;
      EXPECT_LT(t[t.size() - 2], t.back());
      for (std::size_t k = 0; k + 1 < t.size(); ++k) {
        EXPECT_NEAR(t[k], static_cast<double>(k) * std::stod(period), 1e-12) << k;
      }
      EXPECT_EQ(t.size(), static_cast<std::size_t>(std::ceil(duration / std::stod(period) - 1e-9)) + 1);
    }
  }
}

/// A short run is equal to the start of a longer run, also if it ends within a step. Its statistics cover the steps until its
/// end.
TEST(Rows, AShortRunIsTheBeginningOfALongOne) {
  const Recording whole = run(shipped("hexapod.yaml", with({"actuator.i_max=0.3", "duration=0.36", "trace.period=1e-4"})));
  for (const double duration : {0.3127, 0.0031, 0.2}) {
    const Recording part =
        run(shipped("hexapod.yaml", with({"actuator.i_max=0.3", fmt::format("duration={}", duration), "trace.period=1e-4"})));
    EXPECT_EQ(same_rows(whole, part), std::lround(duration * 1e4) + 1);
  }
}

// Settings of rollouts: changes of every section, ends and rows within steps, a run that diverges, motors at limits, stiff
// contacts.
const std::vector<std::vector<std::string>> kRowsOwn{
    {},
    {"duration=0.2113"},
    {"trace.period=0.0113"},
    {"actuator.i_max=0.1"},
    {"robot.on_ground=false", "robot.position=[99000, 0, 1]", "initial.base_velocity=[9999, 0, 0]", "ground.type=none"},
    {"trace.period=1e-3", "duration=0.1507", "trace.columns=['*']"},
    {"physics.accuracy=1e-3"},
    {"duration=0.0031"},
    {"contact.stiffness=1e6", "contact.damping=1e7", "duration=0.2"},
    {"physics.integrator=implicit", "physics.step=5e-3"},  // this and the next cannot share a lane group with the others
    {"physics.integrator=adaptive", "physics.step=5e-3"},
    {"initial.angles=0.1", "cpg.amplitude=1.5", "trace.period=7e-3"},
    {"actuator.u_max=2", "duration=0.2112"},
};

// Rows have the same bits if rollouts run side by side. The test takes 5 s of CPU time: rollouts of two robots, alone and in
// six combinations of lanes and threads.
TEST(Rows, AreTheSameBesideOthers) {
  for (const char* file : {"hexapod.yaml", "caterpillar.yaml"}) {
    const std::vector<Scenario> all = rollouts(kScenarios + file, with({"duration=0.3"}), kRowsOwn, catalog());
    std::vector<std::string> expected;
    expected.reserve(all.size());
    for (const Scenario& one : all) expected.push_back(alone(one));
    EXPECT_NE(expected[4].find("diverged"), std::string::npos) << expected[4];
    EXPECT_TRUE(can_share(all[0], all[5]));
    EXPECT_FALSE(can_share(all[0], all[9]));
    EXPECT_FALSE(can_share(all[0], all[10]));
    EXPECT_FALSE(can_share(all[9], all[10]));
    for (const std::size_t lanes : {1U, 4U, 8U}) {
      for (const int threads : {1, 2}) {
        std::mutex lock;
        std::vector<std::string> ends(all.size());
        run_batch(all, {threads, lanes}, [&](std::size_t i, Recording&& end) {
          const std::lock_guard hold(lock);
          ends[i] = bits(end, end.outcome.text());
        });
        for (std::size_t i = 0; i < all.size(); ++i) {
          EXPECT_EQ(ends[i], expected[i]) << file << ", rollout " << i << ", " << lanes << " lanes, " << threads << " threads";
        }
      }
    }
  }
}

/// The report of a run that diverges describes the end of the run and does not depend on the rows.
TEST(Rows, ChangeNothingOfARunThatDiverges) {
  std::vector<std::string> ends;
  for (const char* period : {"1e-3", "5e-3", "0.0113", "1"}) {
    const Scenario s = shipped(
        "hexapod.yaml", with({"robot.on_ground=false", "robot.position=[99000, 0, 1]", "ground.type=none",
                              "initial.base_velocity=[9999, 0, 0]", "duration=0.3", fmt::format("trace.period={}", period)}));
    Simulation simulation({&s, 1});
    EXPECT_THROW(simulation.run(), SimulationError);
    ends.push_back(bits(simulation.take_recording(0)));
    EXPECT_EQ(ends.back(), ends.front()) << period;
  }
}

TEST(Rows, WithinStepsAreVerifiedByRerun) {
  const Folder folder;
  fs::create_directory_symlink(kScenarios + "modules", folder / "modules");
  for (const char* duration : {"0.1", "0.0937"}) {
    folder.write("s.yaml", fmt::format("gaitlab: 1\nrobot: {{modules: mtran, docks: [[1, 1, 4, 0, 0]]}}\nphysics: {{engine: "
                                       "articulated}}\ncpg: {{type: sine, frequency: 1, amplitude: 1.5}}\nduration: {}\n"
                                       "trace: {{period: 0.0013}}\n",
                                       duration));
    const std::string run = fmt::format("run-{}", duration);
    ASSERT_EQ(gaitlab("run s.yaml --quiet --out " + run, folder / "").code, 0);
    const Result again = gaitlab("rerun --verify " + run, folder / "");
    EXPECT_EQ(again.code, 0) << again.err;
    EXPECT_NE(again.out.find(": bit-equal: "), std::string::npos) << again.out;
    ASSERT_EQ(gaitlab("rerun " + run + " --quiet --out again-" + duration, folder / "").code, 0);
    EXPECT_EQ(read(folder / (run + "/trace.h5")), read(folder / (std::string("again-") + duration + "/trace.h5")));
  }
}

}  // namespace
}  // namespace gaitlab::test
