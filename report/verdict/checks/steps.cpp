// The checks `step`, `coarse` and `law`: the steps of the integrator are short enough.
#include "core/simulation/step_advice.h"
#include "report/verdict/checks/checked_run.h"

namespace gaitlab::report {

namespace {

constexpr double kTooLong = 0.01;  // share of control ticks at which the step is too long; above it, the check warns

void judge_step(const CheckedRun& run, Check& made) {
  const Recording& r = run.record;
  if (left_open(made, r.control_ticks == 0 ? "no damping rate (lambda) was recorded" : "")) return;
  made.value = run.summary.stability_share;
  made.limit = kTooLong;
  made.source = "chosen";
  made.text = fmt::format("the step is too long in {} of the control ticks", texts::percent(made.value));
  if (passes(made, made.limit)) return;
  const auto contacts = contact_elements(*run.scenario.robot, run.scenario.contact.on);
  made.from = made.to = r.worst_time;
  made.text = fmt::format("h lambda exceeds 1 in {} of the control ticks", texts::percent(made.value));
  made.remedy = step_advice(run.scenario, contacts, r.worst, fmt::format("at t = {:.2f} s", r.worst_time));
}

void judge_coarse(const CheckedRun& run, Check& made) {
  made.text = "the integrator does not choose its steps by an accuracy";
  if (!run.scenario.physics.adapts() || !(run.record.simulated > 0)) return;
  made.value = run.record.tally.coarse / run.record.simulated;
  made.limit = kTrustedCoarse;
  made.source = "chosen";
  made.text = fmt::format("in {} of the time the shortest steps of the integrator did not reach the accuracy {}",
                          texts::rough_percent(made.value), texts::rough_percent(run.scenario.physics.accuracy));
  if (passes(made, made.limit)) return;
  made.text += ": the result depends on the steps, and smaller steps may not change this";
  made.remedy = "look for joints without damping, or drives without bounds";
}

void judge_law(const CheckedRun& run, Check& made) {
  if (left_open(made, run.driven() ? "" : kUndriven)) return;
  made.value = run.record.tally.off;
  made.limit = 0;
  made.text = "every joint-step satisfies the law of its motor and end stop";
  if (passes(made, made.limit)) return;
  made.text =
      fmt::format("{:.0f} joint-steps do not satisfy the law of their motor or end stop: their torques are wrong", made.value);
  made.remedy = "the torque of the actuator must fall with the joint's speed";
}

}  // namespace

std::vector<CheckKind> checks::steps() {
  return {{"step", CheckGroup::trust, "", "Steps are short enough", "share of the control ticks at which h lambda exceeds 1",
           "", "above " + texts::percent(kTooLong), CheckSpan::whole_run, "physics.step", "a smaller physics.step", judge_step},
          {"coarse", CheckGroup::trust, "", "Steps reach the accuracy",
           "share of the time in which the shortest steps do not reach physics.accuracy", "",
           fmt::format("above {}; the verdict is then not judged", texts::percent(kTrustedCoarse)), CheckSpan::whole_run,
           "physics.step", "damping, or bounds on the drive of the joints", judge_coarse},
          {"law", CheckGroup::trust, "", "Torques satisfy the law of their motor",
           "number of joint-steps that do not satisfy the law of their motor or end stop", "", "any", CheckSpan::whole_run,
           "physics.step", "an actuator whose torque falls with the speed", judge_law}};
}

}  // namespace gaitlab::report
