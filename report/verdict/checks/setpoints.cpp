// The checks `setpoints` and `start`: set points within the ranges of their hinges, and near the joints at t = 0.
#include "core/settings/settings_numbers.h"
#include "core/settings/wording.h"
#include "report/analysis/cpg_alone.h"
#include "report/verdict/checks/checked_run.h"

namespace gaitlab::report {

namespace {

/// First set points of all joints, within the ranges of the hinges, as text for `initial.angles`: a number if they are equal,
/// else a list. Joints without motor keep their angles. Empty for a CPG of another language, which is called only during the
/// run.
std::string first_angles(const Scenario& s) try {
  if (s.cpg.entry->context != nullptr) return "";
  const std::vector<double> first = CpgAlone(s).rows(1);
  std::vector<std::string> all;
  std::size_t driven = 0;
  for (std::size_t j = 0; j < s.robot->joints.size(); ++j) {
    const Joint& joint = s.robot->joints[j];
    const double angle = joint.driven() ? std::clamp(first.at(driven++), joint.lo, joint.hi) : s.initial.angles[j];
    const double rounded = std::round(1e4 * angle) / 1e4 + 0.0;  // + 0.0: no negative zero
    all.push_back(number_text(std::clamp(rounded, joint.lo, joint.hi)));
  }
  return std::ranges::count(all, all.front()) == std::ssize(all) ? all.front() : fmt::format("[{}]", fmt::join(all, ", "));
} catch (const PluginError&) {
  return "";
}

/// Settings that avoid a jump of the set points at t = 0.
std::string jump_remedy(const Scenario& s) {
  const std::string list = s.cpg.entry == nullptr ? "" : first_angles(s);
  std::string text = list.empty() ? "set initial.angles" : "set initial.angles: " + list;
  if (s.cpg.entry == nullptr || s.place("initial.angles") != SourceLocation{s.file}) return text;
  const SettingsNumbers settings(s.cpg);
  const SettingsNumbers::Found* ramp = settings.find("model.ramp");
  return text + (ramp != nullptr && ramp->value[0] == 0 ? ", or cpg.model.ramp" : "");
}

/// Reason why set points are not judged. Empty if they are.
const char* no_set_points(const CheckedRun& run) {
  const bool known = run.driven() && !run.record.joints.empty();
  return known ? "" : "nothing drives the joints, or statistics of all steps were not recorded";
}

void judge_setpoints(const CheckedRun& run, Check& made) {
  if (left_open(made, no_set_points(run))) return;
  const std::size_t worst = texts::worst(run.record, &JointStatistics::setpoint_outside);
  made.value = run.record.joints[worst].setpoint_outside;
  made.limit = 0;
  made.status = made.value > 0 ? CheckStatus::warn : CheckStatus::pass;
  made.text = "no set point leaves the range of its hinge";
  if (!(made.value > 0)) return;
  name_joint(made, run, worst);
  made.text = fmt::format("the set point of joint {} is beyond the range of its hinge for {} of the run", made.worst,
                          texts::percent(made.value));
}

void judge_start(const CheckedRun& run, Check& made) {
  if (left_open(made, no_set_points(run))) return;
  take_limit(made, "start_jump", &Limits::start_jump, run);
  const std::size_t worst = texts::worst(run.record, &JointStatistics::start_jump);
  made.value = run.record.joints[worst].start_jump;
  name_joint(made, run, worst);
  made.text = fmt::format("the set point of joint {} is {:.3g} rad from its angle at t = 0", made.worst, made.value);
  made.status = made.value > made.limit ? CheckStatus::warn : CheckStatus::pass;
  if (made.status == CheckStatus::pass) return;
  made.from = made.to = made.first = 0;
  made.text += ", and its motor reacts at once: peaks of the whole run may result from this jump";
  made.remedy = jump_remedy(run.scenario);
}

}  // namespace

std::vector<CheckKind> checks::setpoints() {
  return {{"setpoints", CheckGroup::motion, "", "Set points keep the ranges",
           "largest share of the time that a set point is beyond the range of its hinge, over all steps", "", "any",
           CheckSpan::whole_run, "cpg", kSmaller, judge_setpoints},
          {"start", CheckGroup::motion, "rad", "Starts at its set points", "largest jump of a set point at t = 0", "",
           "above limits.start_jump", CheckSpan::whole_run, "cpg", "initial.angles", judge_start}};
}

}  // namespace gaitlab::report
