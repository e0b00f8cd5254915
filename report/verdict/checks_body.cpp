// Checks of the run, of motion, bodies and ground.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "core/laws/hinge_stop.h"
#include "core/settings/settings_numbers.h"
#include "core/settings/wording.h"
#include "report/analysis/cpg_alone.h"
#include "report/analysis/motors.h"
#include "report/analysis/upright.h"
#include "report/verdict/checks.h"
#include "report/verdict/number_texts.h"

namespace gaitlab::report {

std::string threshold(const char* key, double value, double preset) {
  return value == preset ? fmt::format("chosen (limits.{})", key) : fmt::format("limits.{} of the scenario", key);
}

namespace {

/// Excess of a joint's angle beyond its range.
struct BeyondRange {
  double worst = 0, share = 0;  ///< largest excess, rad; share of the time beyond the range
};

constexpr double kHorizontal = std::numbers::pi / 2;  // rad
constexpr const char* kNoPoses = "the run has no poses";

void judge(Check& made, const char* key, double Limits::*member, const CheckedRun& run) {
  made.limit = run.limits().*member;
  made.source = threshold(key, made.limit, Limits().*member);
}

void name_joint(Check& made, const CheckedRun& run, std::size_t joint) {
  made.part = Part::joint;
  made.worst = run.joint(joint);
}

/// Reason why collisions cannot be judged, for example bodies without a shape. Empty if they can.
std::string no_bodies(const CheckedRun& run) {
  const std::size_t all = run.scenario.robot->bodies.size();
  if (const ContactModel& contact = run.scenario.contact.model(); contact.keeps_bodies_apart)
    return fmt::format("the solver of contact.law {} keeps bodies apart and above the ground", contact.text);
  if (run.overlaps.shaped == 0) return "no body has a shape, or the run has no poses";
  return run.overlaps.shaped == all ? "" : fmt::format("{} of {} bodies have a shape", run.overlaps.shaped, all);
}

}  // namespace

namespace checks {

void outcome(const CheckedRun& run, Check& made) {
  made.value = run.record.simulated;
  made.limit = run.scenario.duration;
  made.status = run.record.outcome.done() ? CheckStatus::pass : CheckStatus::fail;
  made.text = run.record.outcome.done() ? "the run came to its end" : run.record.outcome.text();
}

void height(const CheckedRun& run, Check& made) {
  made.text = "judged only for a floating base above a ground";
  if (run.scenario.base != Base::floating || !run.scenario.ground.exists()) return;
  if (!run.fall) {
    made.text = heights(run.scenario, run.record).empty() ? kNoPoses : "the start pose has its centre of mass in the ground";
    return;
  }
  judge(made, "height", &Limits::height, run);
  made.value = run.fall->share;
  made.from = run.fall->time.value_or(run.fall->lowest_time);
  made.to = run.fall->lowest_time;
  made.status = run.fall->time ? CheckStatus::fail : CheckStatus::pass;
  const std::string share = texts::percent(made.value) + (run.fall->told ? " of the height of its set points' pose"
                                                                         : " of its height above the ground at the start");
  made.text = "the centre of mass keeps at least " + share;
  if (made.status == CheckStatus::pass) return;
  made.text =
      fmt::format("the robot falls at {:.2f} s: the centre of mass comes {}", made.from,
                  run.fall->lowest < 0 ? fmt::format("{:.3g} m below the ground", -run.fall->lowest) : "down to " + share);
  made.first = made.from;
  if (run.fall->stays) {
    made.text += ", and does not rise again";
    made.to = run.record.simulated;
  }
  made.remedy = "take a gait with more support";
}

void upright(const CheckedRun& run, Check& made) {
  made.text = run.scenario.base == Base::floating ? kNoPoses : "judged only for a floating base";
  const Judged& judged = run.summary.judged;
  std::optional<Upright> found = report::upright(run.scenario, run.record, judged, 0);
  if (!found) return;
  if (found->over && judged.periods == 0) {
    const double period = run.summary.gait.period;
    found = report::upright(run.scenario, run.record, judged, period);
    made.text =
        fmt::format("the robot turns over at {:.2f} s, and the run is too short to show whether it rolls", *found->over);
    const bool early = run.record.simulated < kPeriodsNeeded * period;
    if (!found->rolls && early && run.record.simulated - *found->over < period) return;
  }
  made.text = "the base rolls: it makes a whole turn in every period";
  if (found->over && found->rolls) return;
  made.value = found->tilt;
  made.limit = kHorizontal;
  made.source = "the horizontal";
  made.from = found->over.value_or(found->tilt_time);
  made.to = found->tilt_time;
  made.status = found->over ? CheckStatus::fail : made.value > run.limits().tilt ? CheckStatus::warn : CheckStatus::pass;
  made.text = fmt::format("the robot tilts by up to {:.3g} rad from its start", made.value);
  if (made.status == CheckStatus::warn) made.text += fmt::format(", more than {:.3g} rad (limits.tilt)", run.limits().tilt);
  if (!found->over) return;
  made.first = *found->over;
  made.text =
      fmt::format("the robot turns over at {:.2f} s: it tilts by up to {:.3g} rad from its start", made.from, made.value);
  made.remedy = "take a gait with more support";
}

void tracking(const CheckedRun& run, Check& made) {
  made.text = run.unknown(kErrorPeak);
  if (!made.text.empty()) return;
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
  judge(made, "tracking_error", &Limits::tracking_error, run);
  const double warns = made.limit;
  made.limit *= 2;
  made.value = joints[worst].error_peak;
  made.status = graded(made.value, warns, made.limit);
  name_joint(made, run, worst);
  made.parts =
      static_cast<std::size_t>(std::ranges::count_if(joints, [&](const JudgedJoint& j) { return j.error_peak > warns; }));
  std::tie(made.from, made.to) = row_before(run.record, joints[worst].error_peak_time);
  made.text = fmt::format("joint {} is up to {} rad from its set point", made.worst, texts::thousandths(made.value));
}

namespace {

/// Clears the joints that have a fault. Returns true if all have one.
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
constexpr double kRestsBeyond = 0.05;  // rad, 2.5 N m of the stop

/// Judges hinges without a motor, by their angle beyond the stop alone, after the joints with a motor: they decide if they fail
/// by more than these, or if none of these is beyond its range.
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

/// First set points of all joints, within the ranges of the hinges, as text for `initial.angles`: a number if they are equal,
/// else a list. Joints without motor keep their angles. Empty for a CPG of another language, which is called in the run alone.
std::string first_angles(const Scenario& s) try {
  if (s.cpg.entry->context != nullptr) return "";
  const std::vector<double> first = set_points_alone(s, 1);
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

}  // namespace

namespace {

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

void stops(const CheckedRun& run, Check& made) {
  std::vector<BeyondRange> joints;
  for (const JointStatistics& joint : run.record.joints) joints.push_back({joint.range_worst, joint.range_share});
  made.text = kAllFaulty;
  if (leave_faulty_out(run, joints)) return;
  made.text = "statistics of all steps were not recorded";
  if (joints.empty() && !run.scenario.robot->joints.empty()) return;
  made.value = 0;
  judge(made, "beyond_range", &Limits::beyond_range, run);
  made.status = CheckStatus::pass;
  made.text = "no joint leaves its range";
  std::vector<BeyondRange> driven = joints;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    if (!run.scenario.robot->joints[j].driven()) driven[j] = {};
  }
  judge_driven(run, driven, made);
  judge_rests(run, joints, made);
}

void setpoints(const CheckedRun& run, Check& made) {
  made.text = "nothing drives the joints, or statistics of all steps were not recorded";
  if (!run.driven() || run.record.joints.empty()) return;
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

void start(const CheckedRun& run, Check& made) {
  const Scenario& s = run.scenario;
  made.text = "nothing drives the joints, or statistics of all steps were not recorded";
  if (!run.driven() || run.record.joints.empty()) return;
  judge(made, "start_jump", &Limits::start_jump, run);
  const std::size_t worst = texts::worst(run.record, &JointStatistics::start_jump);
  made.value = run.record.joints[worst].start_jump;
  name_joint(made, run, worst);
  made.text = fmt::format("the set point of joint {} is {:.3g} rad from its angle at t = 0", made.worst, made.value);
  made.status = made.value > made.limit ? CheckStatus::warn : CheckStatus::pass;
  if (made.status == CheckStatus::pass) return;
  made.from = made.to = made.first = 0;
  made.text += ", and its motor reacts at once: peaks of the whole run may result from this jump";
  made.remedy = jump_remedy(s);
}

void collision(const CheckedRun& run, Check& made) {
  const std::optional<Collision>& found = run.overlaps.collision;
  made.text = no_bodies(run);
  if (!found && !made.text.empty()) return;
  judge(made, "collision", &Limits::collision, run);
  made.value = found ? found->depth : 0;
  made.status = graded(made.value, run.limits().meeting(), made.limit);
  made.text = "no two bodies overlap more than by design";
  if (!found) return;
  made.from = made.to = found->deepest_time;
  made.first = found->time;
  made.first_part = run.scenario.robot->bodies[found->first].name;
  made.parts = found->pairs;
  made.part = Part::body;
  made.worst = run.scenario.robot->bodies[found->deepest_first].name;
  const Body &one = run.scenario.robot->bodies[found->deepest_first],
             &other = run.scenario.robot->bodies[found->deepest_second];
  made.remedy = "take smaller amplitudes or offsets: with contact.law: penalty, bodies can pass through one another";
  made.remedy += "; or list the pair in robot.may_overlap, if its shapes are rough";
  made.text = fmt::format("{} of bodies pass{} through one another, deepest {} and {}, by {}", counted(found->pairs, "pair"),
                          found->pairs == 1 ? "es" : "", one.name, other.name, texts::length(found->depth));
}

void in_ground(const CheckedRun& run, Check& made) {
  const std::optional<Sunk>& found = run.overlaps.sunk;
  const bool grounded = run.scenario.ground.exists();
  made.text = grounded ? no_bodies(run) : "judged only above a ground";
  if (!found && !made.text.empty()) return;
  judge(made, "sink", &Limits::sink, run);
  made.value = found ? found->depth : 0;
  made.status = found ? CheckStatus::fail : CheckStatus::pass;
  made.text = "no body goes through the ground";
  if (!found) return;
  made.from = made.to = found->deepest_time;
  made.first_part = run.scenario.robot->bodies[found->first].name;
  made.parts = found->bodies;
  made.text =
      fmt::format("body {} goes {} into the ground", run.scenario.robot->bodies[found->body].name, texts::length(found->depth));
  made.first = found->time;
  made.part = Part::body;
  made.worst = run.scenario.robot->bodies[found->body].name;
  made.remedy = run.scenario.contact.on == ContactSet::all
                    ? "take a larger contact.stiffness, if it is too small for this load"
                    : "set contact.on: all, with which all parts of the robot touch the ground";
}

}  // namespace checks

}  // namespace gaitlab::report
