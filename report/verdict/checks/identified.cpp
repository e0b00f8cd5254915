// The check `identified`: the joints stay within the speeds and torques of the logs to which their motors were fitted.
#include "report/verdict/checks/checked_run.h"

namespace gaitlab::report {

namespace {

/// A quantity of a joint, as a share of the largest in the logs.
struct LogShare {
  double value, limit, time;  ///< in its unit, and s
  const char *verb, *noun, *unit;
  [[nodiscard]] double share() const { return value / limit; }
};

/// Speed and torque of a joint, as far as its logs have them.
std::vector<LogShare> log_shares(const Identification& of, const JudgedJoint& joint) {
  std::vector<LogShare> all;
  if (of.speed > 0) all.push_back({joint.speed_peak, of.speed, joint.speed_peak_time, "turns at", "speed", "rad/s"});
  if (of.torque > 0) all.push_back({joint.torque_peak, of.torque, joint.torque_peak_time, "takes", "torque", "N m"});
  return all;
}

std::string log_share_text(const LogShare& one, const std::string& joint, std::int64_t logs) {
  const std::string reached = fmt::format("joint {} {} up to {:.3g} {}", joint, one.verb, one.value, one.unit);
  return one.share() > 1 ? fmt::format("{}, beyond the {} of the {} of its motor: up to {:.3g} {}", reached, one.noun,
                                       counted(static_cast<std::size_t>(logs), "log"), one.limit, one.unit)
                         : fmt::format("{}, {:.3g} {} in the logs of its motor", reached, one.limit, one.unit);
}

void judge_log_shares(const CheckedRun& run, Check& made) {
  made.text = "no number of the motors was fitted to logs";
  if (std::ranges::none_of(run.identifications, &Identification::any)) return;
  if (left_open(made, run.unknown(kSpeedPeak)) || left_open(made, run.unknown(kTorquePeak))) return;
  made.text = "the logs of the motors state neither speed nor torque";
  made.source = "largest values in the logs of the motors";
  double worst = -1;
  std::string worst_text;
  for (std::size_t j = 0; j < run.summary.judged.joints.size(); ++j) {
    if (!run.judges(j, made.span) || !run.identifications[j].any()) continue;
    bool out = false;
    for (const LogShare& one : log_shares(run.identifications[j], run.summary.judged.joints[j])) {
      out = out || one.share() > 1;
      if (!(one.share() > kLarger * worst)) continue;
      worst = one.share();
      worst_text = log_share_text(one, run.joint(j), run.identifications[j].logs);
      name_joint(made, run, j);
      std::tie(made.from, made.to) = row_before(run.record, one.time);
    }
    if (out) ++made.parts;
  }
  if (worst < 0) return;
  made.value = worst;
  made.limit = 1;
  made.text = worst_text;
  passes(made, 1);
}

}  // namespace

std::vector<CheckKind> checks::identified() {
  const auto concerns = [](const Scenario& scenario) {
    return std::ranges::any_of(identifications(scenario), &Identification::any);
  };
  return {{"identified", CheckGroup::trust, "", "Within the logs of its motors",
           "largest speed or torque of a joint, as a share of the largest in the logs to which its motor was fitted", "",
           "above the largest speed or torque in the logs", CheckSpan::window, "actuator.identified",
           "logs of faster motions or larger loads; or a slower gait", judge_log_shares, false, false, false, Lost::never,
           concerns}};
}

}  // namespace gaitlab::report
