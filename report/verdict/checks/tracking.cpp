// The check `tracking`: joints follow their set points.
#include <tuple>

#include "report/verdict/checks/checked_run.h"

namespace gaitlab::report {

std::vector<CheckKind> checks::tracking() {
  const auto judge = [](const CheckedRun& run, Check& made) {
    if (left_open(made, run.unknown(kErrorPeak))) return;
    std::vector<JudgedJoint> joints = run.summary.judged.joints;
    std::size_t faulty = 0;
    for (std::size_t j = 0; j < joints.size(); ++j) {
      if (!run.faulty(j, made.span)) continue;
      joints[j] = {};
      ++faulty;
    }
    made.text = kAllFaulty;
    if (faulty > 0 && faulty == driven_joints(*run.scenario.robot)) return;
    const std::size_t worst = Judged::farthest(joints);
    take_limit(made, "tracking_error", &Limits::tracking_error, run);
    const double warns = made.limit;
    made.limit *= 2;
    made.value = joints[worst].error_peak;
    made.status = graded(made.value, warns, made.limit);
    name_joint(made, run, worst);
    made.parts =
        static_cast<std::size_t>(std::ranges::count_if(joints, [&](const JudgedJoint& j) { return j.error_peak > warns; }));
    std::tie(made.from, made.to) = row_before(run.record, joints[worst].error_peak_time);
    made.text = fmt::format("joint {} is up to {} rad from its set point", made.worst, texts::thousandths(made.value));
  };
  return {{"tracking", CheckGroup::motion, "rad", "Joints follow their set points",
           "largest |set point - angle| in the window, over all steps", "above twice limits.tracking_error",
           "above limits.tracking_error", CheckSpan::window, "controller", "larger gains, or a slower gait", judge, false,
           false, false, Lost::peak}};
}

}  // namespace gaitlab::report
