// The check `stops`: joints stay within the ranges of their hinges.
#include "core/laws/hinge_stop.h"
#include "core/settings/wording.h"
#include "report/verdict/checks/checked_run.h"

namespace gaitlab::report {

namespace {

/// Excess of a joint's angle beyond its range.
struct BeyondRange {
  double worst = 0, share = 0;  ///< largest excess, rad; share of the time beyond the range
};

/// Clears the joints that have a fault. Returns true if all joints have a fault.
bool leave_faulty_out(const CheckedRun& run, std::vector<BeyondRange>& joints) {
  std::size_t faulty = 0;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    if (!run.faulty(j, CheckSpan::whole_run)) continue;
    joints[j] = {};
    ++faulty;
  }
  return faulty > 0 && faulty == joints.size();
}

/// Text of the check `stops`: the joint that is farthest beyond its range, by angle or by share of time.
std::string beyond_text(const Check& made, const BeyondRange& worst, bool by_angle, double most) {
  return fmt::format("{} leave{} the range of the hinge; worst {}: ", counted(made.parts, "joint"), made.parts == 1 ? "s" : "",
                     made.worst) +
         (by_angle ? fmt::format("by {:.3g} rad, for {} of the run", worst.worst, texts::percent(worst.share))
                   : fmt::format("for {} of the run (at most {}), by up to {:.3g} rad", texts::percent(worst.share),
                                 texts::percent(most), worst.worst));
}

// A hinge without a motor is meant to touch its stop.
constexpr double kRestsBeyond = 0.05;  // rad

/// Judges hinges without a motor after the joints with a motor, and only by their angle beyond the stop. These hinges decide
/// the check if they fail by more than the joints with a motor, or if no joint with a motor is beyond its range.
void judge_rests(const CheckedRun& run, const std::vector<BeyondRange>& joints, Check& made) {
  const auto beyond = [&](std::size_t j) { return run.scenario.robot->joints[j].driven() ? 0 : joints[j].worst; };
  const Criterion most{0, std::max(kRestsBeyond, run.limits().beyond_range), "rad"};
  std::size_t worst = 0;
  std::size_t rest = 0;
  std::size_t fail = 0;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    if (beyond(j) > beyond(worst)) worst = j;
    rest += beyond(j) > 0 ? 1 : 0;
    fail += beyond(j) > most.limit ? 1 : 0;
  }
  const Criterion own{joints.empty() ? 0 : beyond(worst), most.limit, most.unit};
  if (rest == 0 || (fail > 0 ? !(own.margin() < made.margin) : made.parts > 0)) return;
  made.criteria = {own};
  made.value = own.value;
  made.limit = own.limit;
  made.unit = own.unit;
  made.source = own.limit > kRestsBeyond ? threshold("beyond_range", own.limit, kRestsBeyond) : "chosen";
  made.margin = own.margin();
  name_joint(made, run, worst);
  made.parts = fail;
  made.status = fail > 0 ? CheckStatus::fail : CheckStatus::pass;
  const std::string by =
      fmt::format("{:.3g} rad beyond its stop, which gives {:.3g} N m", own.value, HingeStop::kStiffness * own.value);
  made.text = fmt::format("no joint with a motor leaves its range; {} without a motor is up to {}", made.worst, by);
  if (fail == 0) return;
  made.text = fmt::format("{} without a motor {} pressed far beyond the stop; worst {}: {}", counted(fail, "hinge"),
                          fail == 1 ? "is" : "are", made.worst, by);
  made.remedy = "take a wider range, a stiffer hinge spring, or a gentler gait";
}

/// Judges joints with a motor; the others have no excess.
void judge_driven(const CheckedRun& run, const std::vector<BeyondRange>& joints, Check& made) {
  const double most = run.limits().beyond_range_share;
  const auto criteria = [&](const BeyondRange& joint) {
    return std::vector<Criterion>{{joint.worst, made.limit, made.unit}, {joint.share, most}};
  };
  const auto margin = [&](const BeyondRange& joint) {
    return std::min(criteria(joint)[0].margin(), criteria(joint)[1].margin());
  };
  made.criteria = criteria({});
  std::size_t worst = 0;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    made.parts += joints[j].worst > 0 ? 1 : 0;
    if (std::pair(-margin(joints[j]), joints[j].worst) > std::pair(-margin(joints[worst]), joints[worst].worst)) worst = j;
  }
  made.margin = joints.empty() ? 1 : margin(joints[worst]);
  if (made.parts == 0) return;
  made.criteria = criteria(joints[worst]);
  const bool by_angle = made.criteria[0].margin() <= made.criteria[1].margin();
  const Criterion& decisive = made.criteria[by_angle ? 0 : 1];
  made.value = decisive.value;
  made.limit = decisive.limit;
  made.unit = decisive.unit;
  if (!by_angle) made.source = threshold("beyond_range_share", most, Limits().beyond_range_share);
  name_joint(made, run, worst);
  made.status = made.margin < 0 ? CheckStatus::fail : CheckStatus::warn;
  made.text = beyond_text(made, joints[worst], by_angle, most);
  if (made.status == CheckStatus::fail)
    made.remedy = "take a smaller amplitude or offset: the motor works against the hinge stop";
}

}  // namespace

std::vector<CheckKind> checks::stops() {
  const auto judge = [](const CheckedRun& run, Check& made) {
    std::vector<BeyondRange> joints;
    for (const JointStatistics& joint : run.record.joints) joints.push_back({joint.range_worst, joint.range_share});
    made.text = kAllFaulty;
    if (leave_faulty_out(run, joints)) return;
    made.text = "statistics of all steps were not recorded";
    if (joints.empty() && !run.scenario.robot->joints.empty()) return;
    made.value = 0;
    take_limit(made, "beyond_range", &Limits::beyond_range, run);
    made.status = CheckStatus::pass;
    made.text = "no joint leaves its range";
    std::vector<BeyondRange> driven = joints;
    for (std::size_t j = 0; j < joints.size(); ++j) {
      if (!run.scenario.robot->joints[j].driven()) driven[j] = {};
    }
    judge_driven(run, driven, made);
    judge_rests(run, joints, made);
  };
  return {
      {"stops", CheckGroup::motion, "rad", "Joints keep their ranges",
       "largest excess over the range of the hinge, over all steps",
       fmt::format(
           "above limits.beyond_range, or for more than limits.beyond_range_share of the time; for a hinge without a motor, "
           "which is meant to touch its stop, above {:g} rad ({:g} N m from the stop), or limits.beyond_range if that is more",
           kRestsBeyond, HingeStop::kStiffness * kRestsBeyond),
       "any excess of a joint with a motor", CheckSpan::whole_run, "cpg", kSmaller, judge, false, false, false, Lost::share}};
}

}  // namespace gaitlab::report
