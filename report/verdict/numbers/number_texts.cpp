#include "report/verdict/numbers/number_texts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/settings/wording.h"
#include "report/analysis/motors.h"
#include "report/verdict/trust.h"

namespace gaitlab::report::texts {

namespace {

constexpr double kMostShare = 10, kLeastShare = 1e-6;
constexpr double kVisible = 1e-3;   // share of the energy drawn below which energies are not printed
constexpr std::size_t kWidth = 64;  // columns beside the titles, in a terminal of 80 columns
constexpr double kNoTravel = 1e-3;  // m; on a shorter path the cost of transport is noise

}  // namespace

std::string percent(double share) {
  if (share > kMostShare) return "more than 1000 %";
  if (share < -kMostShare) return "less than -1000 %";
  if (std::abs(share) >= 1) return fmt::format("{:.0f} %", 100 * share);
  if (share > 0 && share < kLeastShare) return "less than 0.0001 %";
  return std::abs(share) < kLeastShare ? "0 %" : fmt::format("{:.3g} %", 100 * share);
}

std::string rough_percent(double share) {
  if (share > kMostShare) return "more than 1000 %";
  if (share > 0 && share < kLeastShare) return percent(share);
  return share >= 1 ? fmt::format("{:.0f} %", 100 * share) : fmt::format("{:.{}g} %", 100 * share, share < 0.1 ? 2 : 3);
}

std::string share_of_time(double share) {
  constexpr double kLeastTold = 1e-4;
  return share > 0 && share < kLeastTold ? "less than 0.01 %" : percent(share);
}

std::string spaced(std::string id) {
  std::ranges::replace(id, '_', ' ');
  return id;
}

std::string length(double metres) {
  const double size = std::abs(metres);
  if (size < 0.9995) return fmt::format("{:.3g} mm", 1000 * metres);
  if (size < 999.5) return fmt::format("{:.3g} m", metres);
  return size < 999.5e3 ? fmt::format("{:.3g} km", metres / 1000) : "more than 1000 km";
}

std::string thousandths(double value) { return value < 1000 ? fmt::format("{:.3f}", value) : fmt::format("{:.3g}", value); }

double created(const Recording& record) {
  double sum = 0;
  for (const JointStatistics& joint : record.joints) sum += joint.created;
  return sum;
}

std::size_t worst(const Recording& record, double JointStatistics::*member) {
  const std::vector<JointStatistics>& all = record.joints;
  const auto less = [&](const JointStatistics& a, const JointStatistics& b) { return a.*member < b.*member; };
  return static_cast<std::size_t>(std::max_element(all.begin(), all.end(), less) - all.begin());
}

// ---- the terminal

Lines simulated(const RunData& run) {
  const Summary& s = run.summary;
  return {fmt::format("{}: {:.6g} s simulated in {:.2f} s", run.scenario.name, s.simulated, s.wall_time)};
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
  const int dof = robot.dof(run.scenario.base);
  return {fmt::format("{}, {} bod{}, {}, {} degree{} of freedom, {:.3f} kg", counted(robot.modules.size(), "module"),
                      robot.bodies.size(), robot.bodies.size() == 1 ? "y" : "ies", counted(robot.joints.size(), "joint"), dof,
                      dof == 1 ? "" : "s", robot.mass)};
}

std::string without_nan(std::string text) {
  const auto within = [&](const char* among, std::size_t at) {
    return std::string_view(among).find(text[at]) != std::string::npos;
  };
  for (const std::string_view word : {"nan", "inf"}) {
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + word.size())) {
      const std::size_t end = at + word.size();
      const std::size_t begin = at > 0 && within("+-", at - 1) ? at - 1 : at;
      const bool alone = (begin == 0 || within(" (\n", begin - 1)) && (end == text.size() || within(" ,;)\n", end));
      if (alone) text.replace(begin, end - begin, std::string(end - begin - 1, ' ') + "-");
    }
  }
  return text;
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
  if (!(run.scenario.robot->mass * run.scenario.physics.gravity.norm() > 0)) return {"cost of transport undefined: no weight"};
  if (s.distance < kNoTravel) return {"cost of transport undefined: travelled less than 1 mm"};
  if (lossless(run)) return {"cost of transport not meaningful: these motors lose next to nothing"};
  Lines lines{
      fmt::format("cost {:.3g} electrical, {:.3g} mechanical (J per N of weight and m)", s.cost_electrical, s.cost_mechanical)};
  if (const std::string much = much_created(run); !much.empty()) lines.push_back(much);
  return lines;
}

bool lossless(const RunData& run) {
  constexpr double kLeastLoss = 0.01, kRails = 0.001;
  const Ledger& e = run.record.ledger;
  return e.copper + e.gear + e.hinges + e.dry < kLeastLoss * e.electrical || std::abs(run.summary.cost_electrical) < kRails;
}

// Without the energy that gears create by eq. 2, the energy drawn would be larger by this share.
std::string much_created(const RunData& run) {
  const double share = created(run.record) / run.record.ledger.electrical;
  return created_share(run.scenario, run.record) > run.scenario.limits.energy_created
             ? fmt::format("the gears create {} of the energy drawn (eq. 2)", percent(share))
             : "";
}

namespace {

std::string joint_name(const RunData& run, std::size_t joint) { return run.scenario.robot->joints[joint].name; }

/// Text `21.5 % of the time (current)`.
std::string share_at_limit(const JudgedJoint& j) {
  if (j.voltage_limited > 0 && j.current_limited > 0) {
    return fmt::format("{} of the time ({} voltage, {} current)", percent(j.limited()), percent(j.voltage_limited),
                       percent(j.current_limited));
  }
  return fmt::format("{} of the time ({})", percent(j.limited()), j.voltage_limited > 0 ? "voltage" : "current");
}

}  // namespace

Lines window(const RunData& run) {
  if (!has_motors(run)) return {};
  const Judged& j = run.summary.judged;
  const std::string stretch = fmt::format("t = {:.4g} to {:.4g} s, ", j.from, j.to);
  if (j.periods == 0) return {stretch + "not a whole period of a limit cycle"};
  return {stretch + fmt::format("the last {} of {:.4g} s", counted(j.periods, "period"), run.summary.limit_cycle.period)};
}

namespace {

/// Lines for each further limit that a joint reaches: another limit than that of the joint `named`, or a joint that is longer
/// at its limit.
Lines other_limits(const RunData& run, std::size_t named) {
  struct Kind {
    MotorLimit limit;
    double JudgedJoint::*share;
  };
  const std::vector<JudgedJoint>& joints = run.summary.judged.joints;
  Lines lines;
  for (const Kind& kind :
       {Kind{MotorLimit::voltage, &JudgedJoint::voltage_limited}, {MotorLimit::current, &JudgedJoint::current_limited}}) {
    const auto share = kind.share;
    const auto longest = std::ranges::max_element(joints, {}, share);
    const auto number = static_cast<std::size_t>(longest - joints.begin());
    if (!((*longest).*share > joints[named].*share)) continue;
    const auto some = std::ranges::count_if(joints, [&](const JudgedJoint& j) { return j.*share > 0; });
    lines.push_back(fmt::format("{} limit: {} joint{}, {} longest, {}", name_of(kind.limit), some, some == 1 ? "" : "s",
                                joint_name(run, number), percent((*longest).*share)));
  }
  return lines;
}

}  // namespace

Lines limits(const RunData& run) {
  if (!has_motors(run)) return {};
  const Judged& judged = run.summary.judged;
  const std::size_t worst = run.summary.most_loaded();
  const std::size_t some = Judged::limited(judged.joints);
  const std::size_t all = Judged::limited(judged.whole);
  const std::string joints = counted(driven_joints(*run.scenario.robot), "joint");
  const std::string reach = fmt::format("{} of {} reach{} a limit", some, joints, some == 1 ? "es" : "");
  Lines lines;
  if (some == 0) {
    lines.emplace_back("no joint at a limit of its motor");
  } else if (judged.joints[worst].limited() > 0) {
    lines.push_back(fmt::format("{}, {} longest:", reach, joint_name(run, worst)));
    lines.push_back("at its limit " + share_at_limit(judged.joints[worst]));
    for (std::string& other : other_limits(run, worst)) lines.push_back(std::move(other));
  } else {
    lines.push_back(reach + ", for an instant");
  }
  if (some == 0 && all > 0) {
    const auto longest = std::ranges::max_element(judged.whole, {}, &JudgedJoint::limited);
    lines.push_back(fmt::format("before: {} of {}, {} longest: {} of the run", all, joints,
                                joint_name(run, static_cast<std::size_t>(longest - judged.whole.begin())),
                                percent(longest->limited())));
  }
  if (all > 0) {
    const std::size_t first = Judged::first(judged.whole);
    lines.push_back(fmt::format("first of the run: {} at t = {:.2f} s ({})", joint_name(run, first),
                                judged.whole[first].first_limit_time, name_of(judged.whole[first].first_limit)));
  }
  return lines;
}

namespace {

/// Line for the joint whose torque peak is nearest to, or beyond, its motor's torque at rest. Empty if a joint is at a limit,
/// because the limit is printed instead.
Lines nearest_to_rest(const RunData& run) {
  const std::vector<double> rest = rest_torques(run.scenario);
  const std::vector<JudgedJoint>& joints = run.summary.judged.joints;
  std::size_t nearest = 0;
  const auto share = [&](std::size_t j) { return rest[j] > 0 ? joints[j].torque_peak / rest[j] : 0; };
  if (rest.size() != joints.size() || Judged::limited(joints) > 0) return {};
  for (std::size_t j = 1; j < joints.size(); ++j) nearest = share(j) > kLarger * share(nearest) ? j : nearest;
  if (!(share(nearest) > 0)) return {};
  return {fmt::format("at most {:.0f} % of what a motor holds at rest, apart from gear losses ({}, {:.3f} N m)",
                      100 * share(nearest), joint_name(run, nearest), rest[nearest])};
}

}  // namespace

Lines most_loaded(const RunData& run) {
  if (!has_motors(run)) return {};
  const Judged& judged = run.summary.judged;
  const std::size_t worst = run.summary.most_loaded();
  const auto text = [&](const JudgedJoint& j) {
    return fmt::format("{:.3f} N m at t = {:.2f} s{}", j.torque_peak, j.torque_peak_time,
                       j.peak_limit == MotorLimit::none ? "" : fmt::format(" ({} limit)", name_of(j.peak_limit)));
  };
  Lines lines{fmt::format("{}: peak {}", joint_name(run, worst), text(judged.joints[worst])),
              fmt::format("RMS {:.3f} N m", judged.joints[worst].torque_rms)};
  const std::size_t most = Judged::strongest(judged.joints);
  if (most != worst && judged.joints[most].torque_peak > kLarger * judged.joints[worst].torque_peak)
    lines.push_back(fmt::format("largest: {}: {}", joint_name(run, most), text(judged.joints[most])));
  const std::size_t ever = Judged::strongest(judged.whole);
  if (judged.whole[ever].torque_peak > kLarger * judged.joints[most].torque_peak)
    lines.push_back(fmt::format("before: {}: {}", joint_name(run, ever), text(judged.whole[ever])));
  for (std::string& line : nearest_to_rest(run)) lines.push_back(std::move(line));
  return lines;
}

Lines tracking(const RunData& run) {
  if (!has_motors(run)) return {};
  const Judged& judged = run.summary.judged;
  const auto text = [&](const std::vector<JudgedJoint>& joints) {
    const std::size_t j = Judged::farthest(joints);
    return fmt::format("{}: {} rad at t = {:.2f} s", joint_name(run, j), thousandths(joints[j].error_peak),
                       joints[j].error_peak_time);
  };
  Lines lines{text(judged.joints)};
  if (text(judged.whole) != lines.front()) lines.push_back("before: " + text(judged.whole));
  return lines;
}

Lines drawn(const RunData& run) {
  if (!has_motors(run)) return {};
  const Ledger& l = run.record.ledger;
  const double share = residual_share(run.scenario, run.record);
  return {fmt::format("{:.4g} J drawn; {:.2g} J unaccounted for{}", l.electrical, std::abs(l.residual()),
                      share < 1 ? fmt::format(" ({:.2g} %)", 100 * share) : "")};
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
  add(l.hinges, "hinges");
  add(l.dry, "joint friction");
  add(l.residual(), "residual");
  return lines;
}

Lines created_energy(const RunData& run) {
  const double energy = created(run.record);
  if (!has_motors(run) || !(energy > kVisible * run.record.ledger.electrical)) return {};
  const std::string remedy = no_created_energy(run.scenario);
  Lines lines{fmt::format("the gears created {:.3g} J: eq. 2 on back-driven joints{}", energy, remedy.empty() ? "" : ";")};
  if (!remedy.empty()) lines.push_back(remedy);
  return lines;
}

Lines range(const RunData& run) {
  std::size_t some = 0;
  for (const JointStatistics& f : run.record.joints) some += f.setpoint_outside > 0 || f.range_share > 0 ? 1 : 0;
  if (some == 0) return {};
  const std::size_t farthest = worst(run.record, &JointStatistics::range_worst);
  const JointStatistics& f = run.record.joints[farthest];
  return {fmt::format("{} of {} joints beyond their range, {} farthest:", some, run.record.joints.size(),
                      joint_name(run, farthest)),
          fmt::format("{:.3g} rad, {} of the time; set point {}", f.range_worst, percent(f.range_share),
                      percent(f.setpoint_outside))};
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
  return has_motors(run) ? fmt::format("{:.3f}", judged.joints[Judged::farthest(judged.joints)].error_peak) : "-";
}

std::string limit_cycle_cell(const RunData& run) {
  const MotionCycle& cycle = run.summary.limit_cycle;
  if (!cycle.found) return " none found";
  return fmt::format(" {:.4g} s from {:.3g} s, to {}", cycle.period, cycle.from, percent(cycle.error));
}

}  // namespace gaitlab::report::texts
