#include "report/demand.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "core/plugin/plugin_instance.h"
#include "core/simulation/simulation.h"

namespace gaitlab::report {

namespace {

constexpr double kThrown = 1.5;  // times the largest height of the run itself

class Raise final : public Fields {
 public:
  bool found = false;
  void visit(const Field& field) override {
    const auto* each = std::get_if<field::EachJoint>(&field.value);
    if (each == nullptr || each->role != field::Role::limit) return;
    found = true;
    each->value.common *= kDemandTimes;
    for (double& value : each->value.each) value *= kDemandTimes;
  }
  void problem_at(const char*, std::string_view, std::size_t, std::string_view) override {}
};

double highest(const Recording& record) {
  double height = -std::numeric_limits<double>::infinity();
  for (const double z : record.series("com.z").values()) height = std::max(height, z);
  return height;
}

/// `11 V (needs 18.3 V at up to 7.4 rad/s)`.
std::string lack(double needs, double has, const char* unit, const JudgedJoint& joint) {
  if (!(needs > has)) return "";
  return fmt::format("{:.3g} {} (needs {:.3g} {}; {:.3g} N m, {:.3g} rad/s at most)", needs - has, unit, needs, unit,
                     joint.torque_peak, joint.speed_peak);
}

}  // namespace

bool raise_limits(Scenario& scenario) {
  Raise raise;
  if (scenario.actuator.entry != nullptr) visit_settings(*scenario.actuator.entry, scenario.actuator.settings.get(), raise);
  return raise.found;
}

Demand demand(const Scenario& twin, const Recording& record, const Summary& summary) {
  Demand made;
  Recording free;
  try {
    Simulation simulation({&twin, 1});
    simulation.run();
    free = simulation.take_recording(0);
  } catch (const RunError& error) {
    made.doubt = fmt::format("with motors without limits the run breaks off: {}", error.what());
    return made;
  }
  made.joints = judge(free, summary.limit_cycle).joints;
  made.known = made.joints.size() == summary.judged.joints.size();
  const bool limited = Judged::limited(made.joints) > 0;
  if (highest(free) > kThrown * highest(record)) {
    made.doubt = "with motors without limits the robot is thrown up, so that what it needs is not what the gait needs";
  } else if (limited) {
    made.doubt = fmt::format("even {:g} times these limits are reached: it needs more than that", kDemandTimes);
  }
  return made;
}

void add_demand(Verdict& verdict, const Scenario& scenario, const Summary& summary, const Demand& demand) {
  verdict.demand_doubt = demand.doubt;
  if (!demand.known) return;
  const std::vector<JudgedJoint>& own = summary.judged.joints;
  for (std::size_t j = 0; j < own.size(); ++j) {
    if (!own[j].reaches_limit()) continue;
    const JudgedJoint& free = demand.joints[j];
    verdict.demands.push_back(
        {scenario.robot->joints[j].name, free.voltage_peak, free.current_peak, free.torque_peak, free.speed_peak});
  }
  for (Check& check : verdict.checks) {
    if (check.id != "voltage" && check.id != "current") continue;
    if (check.status != CheckStatus::warn && check.status != CheckStatus::fail) continue;
    for (std::size_t j = 0; j < own.size(); ++j) {
      if (scenario.robot->joints[j].name != check.joint) continue;
      const JudgedJoint& free = demand.joints[j];
      check.missing = check.id == "voltage"     ? lack(free.voltage_peak, own[j].voltage_peak, "V", free)
                      : own[j].current_peak > 0 ? lack(free.current_peak, own[j].current_peak, "A", free)
                                                : lack(free.torque_peak, own[j].torque_peak, "N m", free);
    }
  }
}

}  // namespace gaitlab::report
