#include "report/verdict/demand.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/plugin/plugin_instance.h"
#include "core/scenario/built_robot.h"
#include "core/scenario/buses.h"
#include "core/scenario/change_section.h"
#include "core/simulation/simulation.h"
#include "report/analysis/bus.h"
#include "report/analysis/fall.h"
#include "report/analysis/plugin_names.h"

namespace gaitlab::report {

namespace {

constexpr double kThrown =
    0.5;  // share of the standing height; if the twin rises higher than the run by more than this, its robot jumps (thrown_up)

class Raise final : public Fields {
 public:
  bool found = false;
  bool zero = false;  ///< true if a limit is 0, which remains 0
  void visit(const Field& field) override {
    const auto* each = std::get_if<field::EachJoint>(&field.value);
    if (each == nullptr || each->role != field::Role::limit) return;
    found = true;
    if (each->usual != nullptr) state(each->value, *each->usual);
    raise(each->value.common, each->value.each.empty());
    for (double& value : each->value.each) raise(value, true);
  }
  void problem_at(const char*, std::string_view, std::size_t, std::string_view) override {}

 private:
  /// Replaces values that are not stated by `usual`.
  static void state(PerJoint& value, const PerJoint& usual) {
    if (value.each.empty()) value.each.assign(usual.each.size(), value.common);
    for (std::size_t j = 0; j < value.each.size(); ++j) {
      if (value.each[j] == 0) value.each[j] = usual[j];
    }
    if (value.common == 0) value.common = usual.common;
  }
  void raise(double& value, bool counts) {
    zero = zero || (counts && value == 0);
    value *= kDemandTimes;
  }
};

/// Largest rise of the centre of mass above its height at the start, m.
double rise(const std::vector<double>& z) { return *std::ranges::max_element(z) - z.front(); }

/// Largest shortfall among the joints that reach their limit at any time: `0.241 A at m5/passive (needs 0.741 A;
/// largest torque 1.3 N m, largest speed 0.9 rad/s)`.
std::string lack(const Scenario& scenario, const std::vector<JudgedJoint>& own, const std::vector<JudgedJoint>& free,
                 double JudgedJoint::*share, double JudgedJoint::*peak, const char* unit) {
  double most = 0;
  std::string text;
  for (std::size_t j = 0; j < own.size(); ++j) {
    const double missing = free[j].*peak - own[j].*peak;
    if (!(own[j].*share > 0) || !(missing > kLarger * most)) continue;
    most = missing;
    text = fmt::format("{:.3g} {} at {} (needs {:.3g} {}; largest torque {:.3g} N m, largest speed {:.3g} rad/s)", missing,
                       unit, scenario.robot->joints[j].name, free[j].*peak, unit, free[j].torque_peak, free[j].speed_peak);
  }
  return text;
}

/// Keeps the voltage of a duty, and takes away the resistance of the supply, before the limits are raised.
void fix_duty(Scenario& scenario) {
  const std::unique_ptr<Actuator> actuator = make_motors(scenario);
  const In limit = actuator->command_limit();
  scenario.duty_volts.assign(limit.begin(), limit.end());
  for (std::size_t j = 0; j < scenario.duty_volts.size(); ++j) {
    if (const Supply& supply = supply_of(scenario, j); supply.any()) scenario.duty_volts[j] = supply.voltage;
  }
  scenario.supply.resistance = 0;
  for (Battery& battery : scenario.batteries) battery.resistance = 0;
}

}  // namespace

bool thrown_up(const Scenario& scenario, const Recording& free, const Recording& own) {
  if (scenario.base != Base::floating || !scenario.ground.exists()) return false;
  const std::vector<double> z = heights(scenario, own);
  const std::vector<double> thrown = heights(scenario, free);
  return !z.empty() && !thrown.empty() && rise(thrown) > rise(z) + kThrown * std::abs(standing_height(scenario));
}

bool raise_limits(Scenario& scenario) {
  Raise raise;
  if (scenario.actuator.entry == nullptr) return false;
  fix_duty(scenario);
  visit_settings(*scenario.actuator.entry, scenario.actuator.settings.get(), raise);
  if (raise.found && !raise.zero && scenario.controller.entry != nullptr)
    visit_settings(*scenario.controller.entry, scenario.controller.settings.get(), raise);
  return raise.found && !raise.zero;
}

std::optional<SupplyDemand> supply_demand(const Scenario& scenario, const Recording& record, const Judged& judged) {
  const std::vector<MotorBus> all = buses(scenario);
  const std::optional<BusUse> use = bus_use(record, 0, judged.first_row);
  if (all.empty() || !all[0].module.empty() || !use) return {};
  double voltage = 0;
  for (const std::size_t j : all[0].joints) voltage = std::max(voltage, judged.joints[j].voltage_peak);
  const double duration = record.supply.at(record.supply.rows() - 1, 0) - record.supply.at(judged.first_row, 0);
  return SupplyDemand{voltage, use->current_peak, use->current_rms, scenario.supply.voltage * use->current * duration,
                      duration};
}

std::string text_of(const SupplyDemand& demand) {
  return fmt::format("the gait needs {:.3g} V, {:.3g} A RMS, {:.3g} A at most, and {:.3g} J in {:.3g} s from the supply",
                     demand.voltage, demand.current_rms, demand.current_peak, demand.energy, demand.duration);
}

Demand demand(const Scenario& twin, const Recording& record, const Summary& summary,
              const std::function<void(double)>& progress) {
  Demand made;
  Recording free;
  try {
    Simulation simulation({&twin, 1}, {Loads::left_out, false});
    simulation.run(progress);
    free = simulation.take_recording(0);
  } catch (const RunError& error) {
    made.doubt = fmt::format("without motor limits the run breaks off: {}", error.what());
    return made;
  }
  Judged judged = judge(free, summary.limit_cycle, summary.gait.period, summary.gait.start);
  made.supply = supply_demand(twin, free, judged);
  made.joints = std::move(judged.joints);
  made.known = made.joints.size() == summary.judged.joints.size();
  const bool limited = Judged::limited(made.joints) > 0;
  if (thrown_up(twin, free, record)) {
    made.doubt = "without motor limits the robot is thrown up, so that these torques do not belong to the gait";
  } else if (limited) {
    made.doubt = fmt::format("the gait reaches the motor limits even if they are {:g} times as large: it needs more than that",
                             kDemandTimes);
  }
  return made;
}

bool take_demand(Verdict& verdict, const std::string& json) try {
  using Json = nlohmann::json;
  const Json old = Json::parse(json);
  const auto demand = old.find("demand");
  if (demand == old.end()) return true;
  const Json own = Json::parse(to_json(verdict));
  Verdict with = verdict;
  for (const char* const same : {"verdict", "window"}) {
    if (old.at(same) != own.at(same)) return false;
  }
  const auto find = [](const Json& checks, const std::string& id) {
    return std::ranges::find(checks, Json(id), [](const Json& one) { return one.at("id"); });
  };
  for (Check& check : with.checks) {
    if (check.id != "voltage" && check.id != "current") continue;
    const auto of = find(old.at("checks"), check.id);
    if (of == old.at("checks").end()) return false;
    const auto here = find(own.at("checks"), check.id);
    for (const char* const same : {"status", "value", "limit", "worst", "parts"}) {
      if (of->at(same) != here->at(same)) return false;
    }
    check.missing = of->at("missing").get<std::string>();
  }
  const auto number = [](const Json& value) {
    return value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
  };
  with.demand_doubt = demand->at("doubt").get<std::string>();
  for (const Json& of : demand->at("joints")) {
    with.demands.push_back({of.at("joint").get<std::string>(), number(of.at("voltage")), number(of.at("current")),
                            number(of.at("torque")), number(of.at("speed"))});
  }
  if (const auto of = demand->find("supply"); of != demand->end()) {
    with.supply_demand = {number(of->at("voltage")), number(of->at("current_peak")), number(of->at("current_rms")),
                          number(of->at("energy")), number(of->at("duration"))};
  }
  verdict = std::move(with);
  return true;
} catch (const nlohmann::json::exception&) {  // the file was changed and is not valid
  return false;
}

void add_demand(Verdict& verdict, const Scenario& scenario, const Summary& summary, const Demand& demand) {
  verdict.demand_doubt = without_folders(demand.doubt, scenario);
  if (!demand.known) return;
  verdict.supply_demand = demand.supply;
  const std::vector<JudgedJoint>& own = summary.judged.joints;
  for (std::size_t j = 0; j < own.size(); ++j) {
    if (!(own[j].limited() > 0)) continue;
    const JudgedJoint& free = demand.joints[j];
    verdict.demands.push_back(
        {scenario.robot->joints[j].name, free.voltage_peak, free.current_peak, free.torque_peak, free.speed_peak});
  }
  for (Check& check : verdict.checks) {
    if (check.id != "voltage" && check.id != "current") continue;
    if (check.status != CheckStatus::warn && check.status != CheckStatus::fail) continue;
    const bool amperes = std::ranges::any_of(own, [](const JudgedJoint& joint) { return joint.current_peak > 0; });
    check.missing = check.id == "voltage"
                        ? lack(scenario, own, demand.joints, &JudgedJoint::voltage_limited, &JudgedJoint::voltage_peak, "V")
                    : amperes
                        ? lack(scenario, own, demand.joints, &JudgedJoint::current_limited, &JudgedJoint::current_peak, "A")
                        : lack(scenario, own, demand.joints, &JudgedJoint::current_limited, &JudgedJoint::torque_peak, "N m");
  }
}

}  // namespace gaitlab::report
