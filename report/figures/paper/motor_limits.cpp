#include "report/figures/paper/motor_limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/analysis/motors.h"

namespace gaitlab::report {

namespace {

constexpr double kNear = 0.8;  // share of the torque at rest above which a curve comes near it
constexpr Style kRestTorque{.stroke = colour::kVermillion, .width = 1, .dash = "10 3 2 3"};

struct LimitLook {
  MotorLimit limit;
  std::string_view fill;
  const char* name;
};
constexpr LimitLook kLimits[] = {{MotorLimit::voltage, "#E3E3E3", "voltage limit"},
                                 {MotorLimit::current, "#F3D3BD", "current limit"}};

}  // namespace

void MotorLimitMarks::shade(const Plot& plot) const {
  for (const Reached& each : reached)
    plot.band(each.from, each.to, std::ranges::find(kLimits, each.limit, &LimitLook::limit)->fill);
}

void MotorLimitMarks::draw(const Plot& plot, Side torque) const {
  for (const double most : rest) plot.level(most, kRestTorque, torque);
}

void MotorLimitMarks::add_to(std::vector<LegendEntry>& legend) const {
  for (const LimitLook& look : kLimits) {
    if (std::ranges::find(reached, look.limit, &Reached::limit) != reached.end())
      legend.push_back(line_entry(look.name, {.stroke = look.fill, .width = 11}, kPrintLine));
  }
  if (!rest.empty())
    legend.push_back(line_entry(fmt::format("torque at rest, {:.3g} N m", std::abs(rest.front())), kRestTorque, kPrintLine));
}

MotorLimitMarks motor_limits(const PaperRun& run, std::size_t joint, const RowRange& rows) {
  MotorLimitMarks found;
  const std::vector<double> time = row_times(run.recording);
  const Series limit = run.recording.joint(joint, "saturation");
  const Series torque = run.recording.joint(joint, "torque");
  Bounds drawn;
  for (std::size_t row = rows.first; row < rows.last; ++row) {
    if (!torque.empty()) drawn.add(torque[row]);
    const MotorLimit at = limit.empty() ? MotorLimit::none : motor_limit(limit[row]);
    if (at == MotorLimit::none) continue;
    auto& all = found.reached;
    if (all.empty() || all.back().limit != at || all.back().to < time[row]) all.push_back({at, time[row], time[row]});
    all.back().to = time[std::min(row + 1, time.size() - 1)];
  }
  const std::vector<double> rest = rest_torques(run.scenario);
  const double most = joint < rest.size() ? rest[joint] : 0;
  if (most > 0 && drawn.hi > kNear * most) found.rest.push_back(most);
  if (most > 0 && drawn.lo < -kNear * most) found.rest.push_back(-most);
  return found;
}

}  // namespace gaitlab::report
