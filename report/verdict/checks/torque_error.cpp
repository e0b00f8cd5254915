// The check `torque_error`: torques are accurate.
#include "report/verdict/checks/checked_run.h"

namespace gaitlab::report {

std::vector<CheckKind> checks::torque_error() {
  const auto judge = [](const CheckedRun& run, Check& made) {
    const TorqueError error = report::torque_error(run.record);
    if (left_open(made, error.estimated ? "" : "the error of the torques was not estimated in this run")) return;
    made.value = error.share;
    made.limit = run.limits().most_torque_error();
    made.source = threshold("torque_error", run.limits().torque_error, Limits().torque_error);
    name_joint(made, run, error.joint);
    made.text = fmt::format(
        "the torque of joint {} is off by about {} of its peak, estimated by comparison with other step "
        "lengths{}",
        made.worst, texts::rough_percent(made.value),
        run.scenario.physics.adapts() ? ""
                                      : " in windows of the run; `gaitlab converge` compares whole "
                                        "runs");
    if (passes(made, std::min(torque_error_limit(run.scenario), made.limit))) return;
    // A shorter step does not help in a chaotic motion.
    if (predictability(run.scenario, run.record) != Predictability::chaotic)
      made.remedy = "take " + torque_remedy(run.scenario, error.share);
    const Parting& event = run.record.tally.event;
    if (event.time < 0) return;
    made.first = event.time;
    made.first_part = run.joint(event.joint);
  };
  return {
      {"torque_error", CheckGroup::trust, "", "Torques are accurate",
       "estimated error of a joint's torque, relative to its "
       "peak",
       "",
       fmt::format(
           "above physics.accuracy ({} with a given step); above limits.torque_error, at most {}, the verdict is not judged",
           texts::percent(kAccurate), texts::percent(Limits::kMostTorqueError)),
       CheckSpan::whole_run, "physics.step", kShorter, judge}};
}

}  // namespace gaitlab::report
