// The data that a study records of a rollout give the same verdict as a complete recording.
#include <gtest/gtest.h>

#include <bit>

#include "app/study/study_quantities.h"
#include "core/simulation/simulation.h"
#include "tests/program/fixture.h"

namespace gaitlab::test {
namespace {

/// All columns that a study of this robot can have. If `limits` is true, they include the margin of every check for a changed
/// limit.
std::vector<studies::Quantity> all_columns(const Scenario& scenario, bool limits) {
  const studies::QuantityOffer offer = app::quantity_offer();
  std::vector<studies::Quantity> columns = offer.common;
  for (const studies::CheckOffer& check : offer.checks) {
    if (limits) columns.push_back({"margin." + check.id + "[0.25]", "", ""});
  }
  for (const Joint& joint : scenario.robot->joints) {
    for (const studies::Quantity& quantity : offer.of_joints)
      columns.push_back({quantity.name + "[" + joint.name + "]", "", ""});
  }
  return columns;
}

Recording recorded(const Scenario& scenario, const Records& records) {
  Simulation simulation({&scenario, 1}, records);
  simulation.run();
  return simulation.take_recording(0);
}

class StudyReads : public testing::TestWithParam<std::pair<const char*, std::vector<std::string>>> {};

TEST_P(StudyReads, AllThatIsJudged) {
  auto [name, sets] = GetParam();
  sets.emplace_back("physics.engine=articulated");
  const Scenario scenario = shipped(name, sets);
  const Recording whole = recorded(scenario, Loads::recorded);
  EXPECT_GT(whole.rows(), 1U);
  for (const bool limits : {false, true}) {
    const std::vector<studies::Quantity> columns = all_columns(scenario, limits);
    const studies::Measure measure = app::quantity_measure(columns, scenario);
    const Recording read = recorded(scenario, measure.reads);
    EXPECT_EQ(read.trace.columns.size() + read.rest.columns.size(), 0U);
    EXPECT_LE(read.loads.columns.size(), whole.loads.columns.size());
    if (limits) {
      EXPECT_EQ(read.loads.columns.size(), whole.loads.columns.size());
    }
    const studies::RunMeasured expected = measure(scenario, whole);
    const studies::RunMeasured measured = measure(scenario, read);
    EXPECT_EQ(measured.verdict, expected.verdict);
    EXPECT_EQ(measured.why, expected.why);
    for (std::size_t k = 0; k < columns.size(); ++k) {
      EXPECT_EQ(std::bit_cast<std::uint64_t>(measured.quantities[k]), std::bit_cast<std::uint64_t>(expected.quantities[k]))
          << columns[k].name << ": " << measured.quantities[k] << ", of everything " << expected.quantities[k];
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Scenarios, StudyReads,
                         testing::Values(std::pair("caterpillar.yaml", std::vector<std::string>{"duration=4"}),
                                         std::pair("hexapod.yaml", std::vector<std::string>{"duration=4.003"}),
                                         std::pair("rubble.yaml", std::vector<std::string>{"duration=1"}),
                                         std::pair("pendulum.yaml", std::vector<std::string>{"duration=2"}),
                                         std::pair("library/dtto-caterpillar.yaml", std::vector<std::string>{"duration=3"}),
                                         std::pair("library/molecubes-arm.yaml", std::vector<std::string>{"duration=2"}),
                                         std::pair("library/yamor-worm.yaml",
                                                   std::vector<std::string>{"duration=3", "trace.period=0.017"})));

}  // namespace
}  // namespace gaitlab::test
