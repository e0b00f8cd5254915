#include "report/number_texts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/trust.h"

namespace gaitlab::report::texts {

namespace {

constexpr double kVisible = 1e-3;      // share of what is drawn
constexpr std::size_t kWidth = 64;     // columns beside the titles, of 80
constexpr double kLeastTravel = 1e-3;  // m: the work of a robot that stays is divided by noise

}  // namespace

std::string percent(double share) { return fmt::format("{:.3g} %", 100 * share); }

double created(const Recording& record) {
  double sum = 0;
  for (const JointStatistics& joint : record.joints) sum += joint.created;
  return sum;
}

std::size_t farthest(const RunData& run) {
  const std::vector<JointStatistics>& all = run.record.joints;
  const auto nearer = [](const JointStatistics& a, const JointStatistics& b) { return a.error_peak < b.error_peak; };
  return static_cast<std::size_t>(std::max_element(all.begin(), all.end(), nearer) - all.begin());
}

// ---- the terminal

Lines simulated(const RunData& run) {
  const Summary& s = run.summary;
  return {fmt::format("{}: {:.6g} s simulated in {:.2f} s ({:.2g} times real time)", run.scenario.name, s.simulated,
                      s.wall_time, s.wall_time > 0 ? s.simulated / s.wall_time : 0)};
}

Lines engine(const RunData& run) {
  return {fmt::format("{} ({})", run.scenario.physics.engine->name, run.scenario.physics.integrator->name)};
}

Lines steps(const RunData& run) {
  const std::string text = steps_text(run.scenario, run.record);
  const std::size_t at = text.find("; ");
  if (at == std::string::npos) return {text};
  return {text.substr(0, at), text.substr(at + 2)};
}

Lines robot(const RunData& run) {
  const Robot& robot = *run.scenario.robot;
  return {fmt::format("{} modules, {} bodies, {} joints, {} degrees of freedom, {:.3f} kg", robot.modules.size(),
                      robot.bodies.size(), robot.joints.size(), robot.dof(run.scenario.base), robot.mass)};
}

Lines distance(const RunData& run) {
  if (run.record.series("com.x").empty()) return {};
  const Summary& s = run.summary;
  return {fmt::format("{:.4f} m (x {:+.4f}, y {:+.4f}), heading change {:+.3f} rad", s.distance, s.displacement_x,
                      s.displacement_y, s.heading_change)};
}

Lines speed(const RunData& run) {
  if (run.record.series("com.x").empty()) return {};
  return {fmt::format("{:.4f} m/s over a path of {:.4f} m", run.summary.speed, run.summary.path_length)};
}

Lines limit_cycle(const RunData& run) {
  if (!run.record.has_states(*run.scenario.robot)) return {};
  const MotionCycle& cycle = run.summary.limit_cycle;
  if (!cycle.found) return {"none found"};
  return {fmt::format("from t = {:.2f} s, period {:.4f} s, repeats to {}", cycle.from, cycle.period, percent(cycle.error))};
}

Lines transport(const RunData& run) {
  const Summary& s = run.summary;
  if (!has_motors(run)) return {};
  if (s.distance < kLeastTravel) return {"cost of transport undefined: travelled less than 1 mm"};
  return {
      fmt::format("cost {:.3g} electrical, {:.3g} mechanical (J per N of weight and m)", s.cost_electrical, s.cost_mechanical)};
}

Lines window(const RunData& run) {
  if (!has_motors(run)) return {};
  const Judged& j = run.summary.judged;
  const std::string periods = j.periods == 0 ? ""
                                             : fmt::format(", {} period{} of {:.4g} s", j.periods, j.periods == 1 ? "" : "s",
                                                           run.summary.limit_cycle.period);
  return {fmt::format("t = {:.2f} to {:.2f} s{}", j.from, j.to, periods)};
}

Lines limits(const RunData& run) {
  if (!has_motors(run)) return {};
  const Judged& judged = run.summary.judged;
  const std::size_t worst = run.summary.most_loaded();
  const JudgedJoint& j = judged.joints[worst];
  const std::size_t some = judged.limited();
  if (some == 0) return {fmt::format("no joint at a limit of its motor")};
  std::string limit = j.voltage_limited > 0 ? "voltage" : "current";
  if (j.voltage_limited > 0 && j.current_limited > 0) {
    limit = fmt::format("{} voltage, {} current", percent(j.voltage_limited), percent(j.current_limited));
  }
  return {fmt::format("{} of {} joints reach a limit, {} longest:", some, judged.joints.size(),
                      run.scenario.robot->joints[worst].name),
          fmt::format("at its limit {} of the time ({})", percent(j.limited()), limit)};
}

Lines most_loaded(const RunData& run) {
  if (!has_motors(run)) return {};
  const std::size_t worst = run.summary.most_loaded();
  const JudgedJoint& j = run.summary.judged.joints[worst];
  const auto name = [&](std::size_t joint) { return run.scenario.robot->joints[joint].name; };
  Lines lines{fmt::format("{}: peak {:.3f} N m at t = {:.2f} s{}, RMS {:.3f} N m", name(worst), j.torque_peak,
                          j.torque_peak_time, j.peak_at_limit ? " (its limit)" : "", j.torque_rms)};
  const std::vector<JointStatistics>& all = run.record.joints;
  const auto less = [](const JointStatistics& a, const JointStatistics& b) { return a.torque_peak < b.torque_peak; };
  const auto most = std::max_element(all.begin(), all.end(), less);
  lines.push_back(fmt::format("whole run: {:.3f} N m at t = {:.4g} s ({})", most->torque_peak, most->torque_peak_time,
                              name(static_cast<std::size_t>(most - all.begin()))));
  return lines;
}

Lines tracking(const RunData& run) {
  if (!has_motors(run)) return {};
  const Judged& judged = run.summary.judged;
  const auto name = [&](std::size_t joint) { return run.scenario.robot->joints[joint].name; };
  const JudgedJoint& j = judged.joints[judged.farthest()];
  const std::size_t most = farthest(run);
  const JointStatistics& f = run.record.joints[most];
  return {
      fmt::format("error at most {:.3f} rad at t = {:.2f} s ({})", j.error_peak, j.error_peak_time, name(judged.farthest())),
      fmt::format("whole run: {:.3f} rad at t = {:.2f} s ({})", f.error_peak, f.error_peak_time, name(most))};
}

Lines drawn(const RunData& run) {
  if (!has_motors(run)) return {};
  const Ledger& l = run.record.ledger;
  const std::string missing =
      l.electrical > 0 ? fmt::format("; {:.2g} % unaccounted for", 100 * std::abs(l.residual()) / l.electrical) : "";
  return {fmt::format("{:.4g} J drawn{}", l.electrical, missing)};
}

Lines ledger(const RunData& run) {
  if (!has_motors(run)) return {};
  const Ledger& l = run.record.ledger;
  Lines lines{fmt::format("= {:.4g} copper", l.copper)};
  const auto add = [&](double value, const char* what) {
    if (value == 0) return;
    const std::string text = fmt::format(" {} {:.3g} {}", value < 0 ? '-' : '+', std::abs(value), what);
    if (lines.back().size() + text.size() > kWidth) lines.emplace_back(" ");
    lines.back() += text;
  };
  add(l.gear, "gear");
  add(l.stored, "stored");
  add(l.contact, "contact");
  add(l.friction, "friction");
  add(l.stops, "stops");
  add(l.residual(), "residual");
  return lines;
}

Lines created_energy(const RunData& run) {
  const double energy = created(run.record);
  if (!has_motors(run) || !(energy > kVisible * run.record.ledger.electrical)) return {};
  return {fmt::format("the gears created {:.3g} J: eq. 2 on back-driven joints;", energy),
          "actuator.efficiency_model: directional does not"};
}

Lines range(const RunData& run) {
  Lines lines;
  for (std::size_t j = 0; j < run.record.joints.size(); ++j) {
    const JointStatistics& f = run.record.joints[j];
    if (!(f.setpoint_outside > 0 || f.range_share > 0)) continue;
    lines.push_back(fmt::format("{}: outside {} of the time, by {:.3g} rad; set point {}", run.scenario.robot->joints[j].name,
                                percent(f.range_share), f.range_worst, percent(f.setpoint_outside)));
  }
  return lines;
}

Lines stability(const RunData& run) {
  const Summary& s = run.summary;
  if (s.stability_source.empty()) return {};
  return {
      fmt::format("h lambda at most {:.2f} at t = {:.2f} s: {};", s.stability_max, run.record.worst_time, s.stability_source),
      fmt::format("above 1 in {} of the ticks", percent(s.stability_share))};
}

// ---- the table of `swap`

std::string speed_cell(const RunData& run) { return fmt::format("{:.4f}", run.summary.speed); }

std::string travel_cell(const RunData& run) {
  return fmt::format("{:+.4f}, {:+.4f}", run.summary.displacement_x, run.summary.displacement_y);
}

std::string cost_cell(const RunData& run) {
  return fmt::format("{:>11.3g} {:>10.3g}", run.summary.cost_electrical, run.summary.cost_mechanical);
}

std::string torque_cell(const RunData& run) {
  if (!has_motors(run)) return fmt::format("{:>12.3f} {}", 0.0, "-");
  const std::size_t j = run.summary.most_loaded();
  return fmt::format("{:>12.3f} {}", run.summary.judged.joints[j].torque_peak, run.scenario.robot->joints[j].name);
}

std::string saturated_cell(const RunData& run) {
  return has_motors(run) ? percent(run.summary.judged.joints[run.summary.most_loaded()].limited()) : "-";
}

std::string tracking_cell(const RunData& run) {
  const Judged& judged = run.summary.judged;
  return has_motors(run) ? fmt::format("{:.3f}", judged.joints[judged.farthest()].error_peak) : "-";
}

std::string limit_cycle_cell(const RunData& run) {
  const MotionCycle& cycle = run.summary.limit_cycle;
  if (!cycle.found) return " none found";
  return fmt::format(" {:.4g} s from {:.3g} s, to {}", cycle.period, cycle.from, percent(cycle.error));
}

}  // namespace gaitlab::report::texts
