// The check `measured`: the run moves as the real robot did in a log.
#include "report/verdict/checks/checked_run.h"

namespace gaitlab::report {

namespace {

constexpr double kMostError = 0.2;  // share of the measured range; chosen
constexpr double kMostLimit = 0.1;  // difference of shares of the time; chosen

/// A joint's mean error of the angle, as a share of the angles that were measured; NaN if they do not differ.
double share_of_range(const LogError& error) {
  return error.span > 0 ? error.mae / error.span : std::numeric_limits<double>::quiet_NaN();
}

std::string at_limit(const JointLogErrors& joint) {
  return fmt::format("at the limit of its supply for {:.3g} % of the time, {:.3g} % in the log", 100 * *joint.at_limit,
                     100 * *joint.measured_at_limit);
}

void judge(const CheckedRun& run, Check& made) {
  made.text = "the scenario has no log of the real robot";
  if (!run.scenario.measured.any()) return;
  made.text = "the run ends before the second row of the log, or its trace lacks columns";
  const std::optional<LogErrors>& log = run.summary.log;
  if (!log) return;
  made.limit = kMostError;
  made.source = fmt::format("a mean error of the angle of {} of the range in the log (chosen)", texts::percent(kMostError));
  const JointLogErrors* worst = nullptr;
  const JointLogErrors* off_limit = nullptr;
  for (const JointLogErrors& joint : log->joints) {
    const std::optional<LogError>& angle = joint.of(Logged::angle);
    if (angle && !std::isnan(share_of_range(*angle)) && !(share_of_range(*angle) <= made.value)) {
      made.value = share_of_range(*angle);
      worst = &joint;
    }
    const auto apart = [](const JointLogErrors& one) { return std::abs(*one.at_limit - *one.measured_at_limit); };
    if (joint.at_limit && joint.measured_at_limit && (off_limit == nullptr || apart(joint) > apart(*off_limit)))
      off_limit = &joint;
  }
  std::vector<std::string> parts;
  if (worst != nullptr) {
    const LogError& angle = *worst->of(Logged::angle);
    name_joint(made, run, worst->joint);
    made.from = made.to = angle.peak_time;
    parts.push_back(fmt::format("the angle of joint {} is {:.3g} mrad off on average, {} of its range, and at most {:.3g} mrad",
                                made.worst, 1000 * angle.mae, texts::percent(made.value), 1000 * angle.peak));
    passes(made, kMostError);
  }
  if (off_limit != nullptr) {
    const double apart = std::abs(*off_limit->at_limit - *off_limit->measured_at_limit);
    parts.push_back(fmt::format("joint {} is {}", run.joint(off_limit->joint), at_limit(*off_limit)));
    if (worst != nullptr) made.criteria = {{made.value, kMostError, ""}};
    made.criteria.push_back({apart, kMostLimit, ""});
    if (worst == nullptr) {
      made.value = apart;
      made.limit = kMostLimit;
      name_joint(made, run, off_limit->joint);
    }
    made.margin = std::numeric_limits<double>::infinity();
    for (const Criterion& one : made.criteria) made.margin = std::min(made.margin, one.margin());
    if (!(apart <= kMostLimit)) made.status = CheckStatus::warn;
    if (made.status == CheckStatus::not_judged) made.status = CheckStatus::pass;
  }
  made.text = "the log has neither angles nor duties";
  if (parts.empty()) return;
  made.text = fmt::format("{}, over {:.3g} s of a log of {:.3g} s", fmt::join(parts, "; "), log->compared, log->from_log);
  if (const std::string& origin = run.scenario.measured.source; !origin.empty()) made.text += fmt::format(" ({})", origin);
}

}  // namespace

std::vector<CheckKind> checks::measured() {
  const auto concerns = [](const Scenario& scenario) { return scenario.measured.any(); };
  return {{"measured", CheckGroup::trust, "", "Moves as the log",
           "mean error of a joint's angle, as a share of the range of the log's angles; and the difference of the shares of "
           "the time at the limit of the supply",
           "", "above 20 % of the range, or if the shares of the time differ by more than 10 %", CheckSpan::whole_run,
           "measured", "another friction, rotor inertia or latency; the data of the motor; mass and length of what it moves",
           judge, false, false, false, Lost::never, concerns}};
}

}  // namespace gaitlab::report
