// Scenarios from a template equal scenarios that are read from the file with the same settings. Tests of streams of many
// rollouts.
#include <malloc.h>

#include "core/scenario/read_scenario.h"
#include "core/scenario/resolved.h"
#include "core/simulation/batch.h"
#include "report/analysis/summary.h"
#include "tests/labels.h"
#include "tests/messages.h"
#include "tests/program/fixture.h"

namespace gaitlab::test {
namespace {

const Label kLongTemplate("Stream.KeepsOrderAndBits", "long");

using Sets = std::vector<std::string>;

class Templates : public testing::TestWithParam<const char*> {};

/// Settings of every section, also settings on which others depend, give the scenario, notes, places and errors of a new
/// reading.
TEST_P(Templates, GiveWhatReadingAgainGives) {
  const std::string file = kScenarios + GetParam();
  const Sets common{"duration=0.3", "contact.stiffness=2e4"};
  const ScenarioTemplate from(file, common, catalog());
  const std::vector<Sets> all{{},
                              {"cpg.frequency=0.4"},
                              {"cpg.amplitude=0.2", "controller.Kp=50"},
                              {"controller.period=0.03"},
                              {"controller.period=0.03", "cpg.frequency=0.7"},
                              {"physics.engine=articulated"},
                              {"physics.engine=articulated", "physics.accuracy=0.02"},
                              {"physics.step=1e-5"},
                              {"physics.gravity=[0, 0, -3]"},
                              {"physics={engine: articulated, step: 5e-4}"},
                              {"contact.law=bullet"},
                              {"contact.on=none", "ground.type=none"},
                              {"contact.friction_law=x"},
                              {"ground.friction=0.3"},
                              {"actuator.i_max=0.3"},
                              {"actuator.i_max={default: 0.3, m1/active: 0.2}"},
                              {"actuator.rotor_inertia=1e-8"},
                              {"actuator.rotor_inertia=1e-8", "contact.law=bullet"},
                              {"initial.angles=0.1"},
                              {"initial.angles={m1/active: 0.2}"},
                              {"initial.angles.m1/active=0.2", "initial.speeds=0.1"},
                              {"initial.base_velocity=[0, 0, 1]"},
                              {"trace.columns=[joint.1.*]", "trace.period=0.01"},
                              {"trace={period: 0.015}"},
                              {"seed=7"},
                              {"duration=0.2"},
                              {"name=other"},
                              {"name.x=1"},
                              {"cpg.type=hopf"},
                              {"cpg={type: sine}"},
                              {"actuator.type=torque"},
                              {"robot.position=[0.1, 0]"},
                              // refused settings
                              {"cpg.frequencies=0.4"},
                              {"cpg.frequency=fast", "controller.Kp=-1"},
                              {"nothing=1"},
                              {"trace.period=0.0101"},
                              {"duration=-1"},
                              {"physics.accuracy=0.02"},
                              {"initial.angles=9"},
                              {"initial.angles.m1/nothing=0"},
                              {"=3"},
                              {"cpg"}};
  for (const Sets& own : all) {
    Sets both = common;
    both.insert(both.end(), own.begin(), own.end());
    const std::string what = fmt::format("{}", fmt::join(own, " "));
    std::string expected;
    std::string given;
    std::optional<Scenario> one;
    const std::string refused = message_of([&] {
      one = from.with(own);
      given = resolved(*one);
    });
    EXPECT_EQ(refused, message_of([&] {
                const Scenario again = read_scenario(file, both, catalog());
                expected = resolved(again);
                if (!one) return;
                EXPECT_EQ(one->notes, again.notes) << what;
                for (const auto& [key, place] : *again.places) {
                  EXPECT_EQ(to_string(one->place(key)), to_string(place)) << what << ": " << key;
                }
              }))
        << what;
    EXPECT_EQ(given, expected) << what;
  }
}

INSTANTIATE_TEST_SUITE_P(Shipped, Templates,
                         testing::Values("hexapod.yaml", "caterpillar.yaml", "rubble.yaml", "pendulum.yaml"),
                         [](const auto& info) {
                           const std::string name = info.param;
                           return name.substr(0, name.find('.'));
                         });

/// Rollouts arrive in order, and each has the same summary as alone, for any number of lanes and threads.
TEST(Stream, KeepsOrderAndBits) {
  const ScenarioTemplate from(kScenarios + "hexapod.yaml", {"physics.engine=articulated", "duration=0.06"}, catalog());
  constexpr int kCount = 70;  // more than a window of one thread
  const auto own = [](int i) { return Sets{fmt::format("cpg.frequency={}", 0.2 + 0.01 * i)}; };
  std::vector<std::string> alone;
  for (const int i : {0, 31, 32, 69}) alone.push_back(hash(run(from.with(own(i))).trace));
  for (const auto& [threads, lanes] : {std::pair(1, 1U), std::pair(1, 0U), std::pair(2, 0U)}) {
    int next = 0;
    std::vector<std::string> hashes;
    run_stream(
        [&]() -> std::optional<Scenario> { return next < kCount ? std::optional(from.with(own(next++))) : std::nullopt; },
        {.threads = threads, .lanes = lanes}, [](const Scenario&, Recording&& r) { return hash(r.trace); },
        [&](std::string&& one) { hashes.push_back(std::move(one)); });
    ASSERT_EQ(hashes.size(), static_cast<std::size_t>(kCount));
    EXPECT_EQ((std::vector<std::string>{hashes[0], hashes[31], hashes[32], hashes[69]}), alone) << threads << ' ' << lanes;
  }
}

/// If a rollout is refused, the rollouts before it arrive, and then the error.
TEST(Stream, EndsAtTheFirstRefused) {
  const ScenarioTemplate from(kScenarios + "hexapod.yaml", {"physics.engine=articulated", "duration=0.03"}, catalog());
  int next = 0;
  int arrived = 0;
  const Scenario bad = from.with({"physics.engine=bullet", "physics.step=0.005", "physics.integrator=semi_implicit"});
  const auto with_bad = [&]() -> std::optional<Scenario> {
    if (++next > 6) return std::nullopt;
    return next == 4 ? bad : from.with({});
  };
  EXPECT_THROW(run_stream(
                   with_bad, {}, [](const Scenario&, Recording&& r) { return r.steps; }, [&](std::int64_t&&) { ++arrived; }),
               InputError);
  EXPECT_EQ(arrived, 3);
}

/// If a scenario cannot be constructed, the rollouts before it arrive, for any number of threads.
TEST(Stream, EndsAtTheFirstThatIsNotMade) {
  const ScenarioTemplate from(kScenarios + "hexapod.yaml", {"physics.engine=articulated", "duration=0.03"}, catalog());
  for (const int threads : {0, 1, 2}) {
    int next = 0;
    int arrived = 0;
    EXPECT_THROW(run_stream([&] { return std::optional(from.with({++next == 36 ? "cpg.frequency=-1" : "seed=3"})); },
                            {.threads = threads}, [](const Scenario&, Recording&& r) { return r.steps; },
                            [&](std::int64_t&&) { ++arrived; }),
                 InputError);
    EXPECT_EQ(arrived, 35) << threads;
  }
}

/// Notes of a scenario with their places, one per line.
std::string told(const Scenario& scenario) {
  std::string text;
  for (const Note& note : scenario.notes) text += to_string(note.place) + ": " + note.text + "\n";
  return text;
}

/// A template whose settings select the type of the CPG keeps settings that this type does not use.
TEST(Template, KeepsWhatItsTypeDropped) {
  const Sets common{"cpg.type=hopf", "duration=0.1"};
  const ScenarioTemplate from(kScenarios + "caterpillar.yaml", common, catalog());
  for (const Sets& own : {Sets{"cpg.frequency=0.4"}, Sets{"cpg.model.mu=2"}, Sets{"cpg.model.k=1"}, Sets{"controller.Kp=40"}}) {
    Sets both = common;
    both.insert(both.end(), own.begin(), own.end());
    std::string given;
    std::string expected;
    EXPECT_EQ(message_of([&] { given = resolved(from.with(own)) + told(from.with(own)); }), message_of([&] {
                const Scenario again = read_scenario(kScenarios + "caterpillar.yaml", both, catalog());
                expected = resolved(again) + told(again);
              }))
        << own[0];
    EXPECT_EQ(given, expected) << own[0];
  }
}

/// If a rollout changes values, the source that the file states for them is dropped. Notes on motors appear once.
TEST(Template, DropsTheSourceOfOtherFigures) {
  const Folder folder;
  std::filesystem::create_directory_symlink(kScenarios + "modules", folder / "modules");
  const std::string file = folder.write("s.yaml",
                                        "robot: {modules: dtto}\nduration: 0.1\nphysics: {engine: articulated}\ncpg: {}\n"
                                        "actuator: {type: dc_motor, R: 5, source: data sheet 3}\n");
  for (const Sets& common : {Sets{}, Sets{"actuator.Ks=0.004"}, Sets{"actuator.source=data sheet 4"}}) {
    const ScenarioTemplate from(file, common, catalog());
    for (const Sets& own :
         {Sets{}, Sets{"actuator.Kt=0.004"}, Sets{"cpg.frequency=0.4"}, Sets{"actuator.source=mine"},
          Sets{"actuator.Kt=0.004", "actuator.source=mine"}, Sets{"actuator={type: dc_motor, R: 6, source: mine}"}}) {
      Sets both = common;
      both.insert(both.end(), own.begin(), own.end());
      const Scenario again = read_scenario(file, both, catalog());
      EXPECT_EQ(told(from.with(own)), told(again)) << fmt::format("{}", fmt::join(both, " "));
      EXPECT_EQ(resolved(from.with(own)), resolved(again)) << fmt::format("{}", fmt::join(both, " "));
    }
  }
}

/// The memory in use does not increase with the number of rollouts. If all were kept, ten thousand rollouts of a walk would
/// need gigabytes.
TEST(Stream, KeepsNothingOfWhatIsOver) {
  const ScenarioTemplate from(kScenarios + "pendulum.yaml", {"duration=0.1", "trace.period=1e-4"}, catalog());
  int next = 0;
  std::size_t early = 0;
  std::size_t late = 0;
  int seen = 0;
  run_stream([&]() -> std::optional<Scenario> { return next++ < 256 ? std::optional(from.with({"seed=2"})) : std::nullopt; },
             {.threads = 1}, [](const Scenario& s, Recording&& r) { return report::summarise(s, r, 0).distance; },
             [&](double&&) {
               if (++seen == 33) early = mallinfo2().uordblks;
               if (seen == 225) late = mallinfo2().uordblks;
             });
  EXPECT_EQ(seen, 256);
  EXPECT_LT(late, early + 1000000)
      << "bytes; one recording has 200 000, and those between the two marks are 192: 40 MB if they were kept";
}

}  // namespace
}  // namespace gaitlab::test
