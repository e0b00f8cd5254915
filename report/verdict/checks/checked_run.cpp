#include "report/verdict/checks/checked_run.h"

namespace gaitlab::report {

std::string CheckedRun::unknown(TickColumn column) const {
  if (!driven()) return kUndriven;
  if (record.ticked() == 0 || record.ticks.rows() < 2) return "the run ended at once";
  return record.tick(0, column).empty() ? "this quantity was not recorded" : "";
}

bool CheckedRun::faulty(std::size_t joint, CheckSpan span) const {
  const double from = span == CheckSpan::window ? summary.judged.from : 0;
  return std::ranges::any_of(
      faults, [&](const FaultSpan& fault) { return fault.joint == joint && fault.to > from && fault.from < record.simulated; });
}

double CheckedRun::torque_error(std::size_t joint) const { return joint < torque_errors.size() ? torque_errors[joint] : 0; }

std::string CheckedRun::of_motors() const {
  if (motor_source.empty()) return "";
  return fmt::format("; motors: {}{}{}", motor_source, motor_defaults.empty() ? "" : "; ", motor_defaults);
}

std::string CheckedRun::unknown_bodies() const {
  const std::size_t all = scenario.robot->bodies.size();
  if (const ContactModel& contact = scenario.contact.model(); contact.keeps_bodies_apart)
    return fmt::format("the solver of contact.law {} keeps bodies apart and above the ground", contact.text);
  if (overlaps.shaped == 0) return "no body has a shape, or the run has no poses";
  return overlaps.shaped == all ? "" : fmt::format("{} of {} bodies have a shape", overlaps.shaped, all);
}

bool left_open(Check& made, std::string reason) {
  made.text = std::move(reason);
  return !made.text.empty();
}

CheckStatus graded(double value, double pass, double warn) {
  return value <= pass ? CheckStatus::pass : value <= warn ? CheckStatus::warn : CheckStatus::fail;
}

bool passes(Check& made, double limit) {
  made.status = made.value <= limit ? CheckStatus::pass : CheckStatus::warn;
  return made.status == CheckStatus::pass;
}

void take_limit(Check& made, const char* key, double Limits::*member, const CheckedRun& run) {
  made.limit = run.limits().*member;
  made.source = threshold(key, made.limit, Limits().*member);
}

std::string threshold(const char* key, double value, double preset) {
  return value == preset ? fmt::format("chosen (limits.{})", key) : fmt::format("limits.{} of the scenario", key);
}

void name_joint(Check& made, const CheckedRun& run, std::size_t joint) {
  made.part = Part::joint;
  made.worst = run.joint(joint);
}

std::pair<double, double> row_before(const Recording& record, double time) {
  const Series t(record.ticks, 0);
  for (std::size_t k = 1; k < t.size(); ++k) {
    if (t[k] >= time) return {t[k - 1], t[k]};
  }
  return {time, time};
}

}  // namespace gaitlab::report
