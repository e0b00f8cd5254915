// Torque errors of sixteen gaits at the default accuracy (docs/decisions/0048-tolerances-of-quiet-motion.md).
#include "report/verdict/trust.h"
#include "tests/labels.h"
#include "tests/program/fixture.h"
#include "tests/program/torque_error.h"
#include "tests/validation.h"

namespace gaitlab::test {
namespace {

const Label kLongGaitErrors("*GaitErrors.*", "long;unsanitized");

/// A gait, its duration, and the start of the comparison of torques, s.
struct CompareGait {
  const char *name, *file;
  double duration, from;
  std::vector<std::string> sets = {};
};
void PrintTo(const CompareGait& gait, std::ostream* out) { *out << gait.name; }

class GaitErrors : public testing::TestWithParam<std::tuple<CompareGait, const char*>> {};

/// The error refers to a run at accuracy 1e-5, as RMS over the joint's peak, for the worst joint. The output is a row of the
/// table of decision 48.
TEST_P(GaitErrors, AreWithinTheAccuracy) {
  const CompareGait& gait = std::get<0>(GetParam());
  const std::string gears = std::get<1>(GetParam());
  const auto made = [&](const std::string& accuracy, const std::string& estimate) {
    std::vector<std::string> sets{
        "physics.engine=articulated",   "physics.integrator=adaptive",   "physics.step=auto",
        "physics.accuracy=" + accuracy, "physics.estimate=" + estimate,  fmt::format("duration={}", gait.duration),
        "trace.period=0.005",           "trace.columns=[joint.*.torque]"};
    const bool servo = std::string(gait.file).starts_with("library/");
    if (!servo) sets.push_back("actuator.efficiency_model=" + gears);
    for (const char* key : {"load_friction", "dry_friction", "viscous_friction", "rotor_inertia"}) {
      if (servo && gears == "paper") sets.push_back(fmt::format("actuator.{}=0", key));  // else a servo's usual losses
    }
    sets.insert(sets.end(), gait.sets.begin(), gait.sets.end());
    return shipped(gait.file, sets);
  };
  const Recording truth = run(made("1e-5", "off"));
  const Recording ours = run(made("0.01", "full"));
  const double error = torque_error(ours, truth, gait.from);
  validate_below({"limits.gaits", "sixteen gaits at accuracy 1 %, torque at rows: worst joint, RMS over its peak",
                  "engine articulated at accuracy 1e-5", ""},
                 error, 0.01, "the accuracy that was requested");
  fmt::print("| {}, {} | {:.2f} %, told {:.2f}, {:.0f} |\n", gait.name, gears, 100 * error,
             100 * report::torque_error(ours).share, ours.tally.solves);
}

INSTANTIATE_TEST_SUITE_P(
    Of, GaitErrors,
    testing::Combine(
        testing::Values(
            CompareGait{"hexapod", "hexapod.yaml", 8, 4}, CompareGait{"caterpillar", "caterpillar.yaml", 8, 4},
            CompareGait{"hexapod_limited", "hexapod.yaml", 8, 4, {"actuator.i_max=0.3"}},
            CompareGait{"caterpillar_limited", "caterpillar.yaml", 8, 4, {"actuator.i_max=0.25"}},
            CompareGait{"octopod", "octopod.yaml", 8, 4}, CompareGait{"y1_sidewinding", "library/y1-sidewinding.yaml", 8, 4},
            CompareGait{"hexapod_fast", "hexapod.yaml", 4, 2, {"cpg.frequency=3", "cpg.amplitude=0.7"}},
            CompareGait{"caterpillar_in_step", "caterpillar.yaml", 1.5, 0, {"cpg.frequency=1", "cpg.phase_lag=0.4"}}),
        testing::Values("paper", "directional")),
    [](const auto& info) { return std::string(std::get<0>(info.param).name) + "_" + std::get<1>(info.param); });

}  // namespace
}  // namespace gaitlab::test
