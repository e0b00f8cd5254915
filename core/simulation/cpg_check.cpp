#include "core/simulation/cpg_check.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "core/simulation/simulation_error.h"

namespace gaitlab {
namespace {

[[noreturn]] void refuse(const std::string& where, const std::string& what, double value, std::int64_t step, double time) {
  throw SimulationError(Ended::diverged, step, time, where,
                        fmt::format("diverged at step {}, t = {:.6g} s: {} is {}", step, time, what, value));
}

/// Name of the joint whose number is the end of a state's name; empty if there is none.
std::string joint_of(const std::string& state, const Robot& robot) {
  const std::size_t point = state.rfind('.');
  if (point == std::string::npos) return {};
  std::size_t joint = 0;
  const char* const last = state.data() + state.size();
  const auto [end, failure] = std::from_chars(state.data() + point + 1, last, joint);
  return failure == std::errc() && end == last && joint < robot.joints.size() ? robot.joints[joint].name : "";
}

}  // namespace

void check_cpg(const Cpg& cpg, const Robot& robot, In setpoint, In state, std::int64_t step, double time) {
  for (std::size_t i = 0; i < state.size(); ++i) {
    if (std::isfinite(state[i])) continue;
    const std::string name = cpg.state_name(i);
    const std::string joint = joint_of(name, robot);
    refuse(joint.empty() ? name : joint,
           joint.empty() ? fmt::format("the CPG's state {}", name)
                         : fmt::format("joint {}: the CPG's state {}", joint, name.substr(0, name.rfind('.'))),
           state[i], step, time);
  }
  for (std::size_t j = 0; j < setpoint.size(); ++j) {
    if (std::isfinite(setpoint[j])) continue;
    refuse(robot.joints[j].name, fmt::format("joint {}: the CPG's set point", robot.joints[j].name), setpoint[j], step, time);
  }
}

}  // namespace gaitlab
