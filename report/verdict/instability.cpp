#include "report/verdict/instability.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/settings/settings_numbers.h"
#include "core/settings/wording.h"

namespace gaitlab::report {

namespace {

constexpr double kBeyond = 1;  // rad beyond a range, 50 N m of its stop
constexpr double kFast = 10;   // m/s
constexpr double kFalls = 2;   // multiple of the speed of a fall

/// Largest angle of a joint beyond its range from a time on, rad.
double beyond(const Scenario& s, const Recording& r, std::size_t joint, double from) {
  const Series t = r.pose("t");
  const Series angle = r.pose(fmt::format("joint.{}.angle", joint));
  const Joint& hinge = s.robot->joints[joint];
  double most = 0;
  for (std::size_t k = 0; k < std::min(t.size(), angle.size()); ++k) {
    if (t[k] >= from) most = std::max({most, angle[k] - hinge.hi, hinge.lo - angle[k]});
  }
  return most;
}

/// Largest speed of the base from a time on, m/s, if it is faster than kFast and than its fall explains; else 0.
double thrown(const Scenario& s, const Recording& r, double from) {
  const Series t = r.pose("t");
  const std::vector<Series> at{r.pose("base.x"), r.pose("base.y"), r.pose("base.z")};
  if (std::ranges::any_of(at, &Series::empty)) return 0;
  double highest = t.empty() ? 0 : at[2][0];
  double most = 0;
  for (std::size_t k = 1; k < t.size(); ++k) {
    highest = std::max(highest, at[2][k]);
    double way = 0;  // m^2
    for (const Series& axis : at) way += (axis[k] - axis[k - 1]) * (axis[k] - axis[k - 1]);
    const double speed = std::sqrt(way) / (t[k] - t[k - 1]);
    const double fall = std::sqrt(2 * s.physics.gravity.norm() * (highest - at[2][k]));
    if (t[k] >= from && speed > std::max(kFast, kFalls * fall)) most = std::max(most, speed);
  }
  return most;
}

/// `Kp 600 V/rad, Kd 0.6 V s/rad, ` of a joint; empty if the controller has no such gains.
std::string gains(const Scenario& s, std::size_t joint) {
  const SettingsNumbers settings(s.controller);
  std::string text;
  for (const char* const key : {"Kp", "Kd"}) {
    if (const SettingsNumbers::Found* const gain = settings.find(key); gain != nullptr)
      text += fmt::format("{} {}, ", key, with_unit(gain->value[joint], gain->unit));
  }
  return text;
}

}  // namespace

std::string instability(const Scenario& s, const Recording& r) {
  if (s.controller.entry == nullptr || r.joints.size() != s.robot->joints.size()) return "";
  std::size_t worst = 0;
  double most = 0;   // rad beyond its range of joint `worst`
  double speed = 0;  // m/s
  double from = INFINITY;
  std::size_t joints = 0;
  for (std::size_t j = 0; j < r.joints.size(); ++j) {
    const JointStatistics& joint = r.joints[j];
    if (!(joint.reversals > 0)) continue;
    const double angle = beyond(s, r, j, joint.reversing_from);
    const double base = thrown(s, r, joint.reversing_from);
    if (angle <= kBeyond && base == 0) continue;
    ++joints;
    from = std::min(from, joint.reversing_from);
    speed = std::max(speed, base);
    if (joints > 1 && angle <= most) continue;
    worst = j;
    most = angle;
  }
  if (joints == 0) return "";
  const std::string& name = s.robot->joints[worst].name;
  const std::string effect = most > kBeyond ? fmt::format("goes {:.3g} rad beyond its range", most)
                                            : fmt::format("throws the base about at {:.3g} m/s", speed);
  return fmt::format(
      "the controller is unstable from {:.3g} s on ({}a command every {:.4g} s): the command of {} changes its "
      "sign in most control ticks; {} {}",
      from, gains(s, worst), s.control_period, joints == 1 ? name : fmt::format("{} joints", joints), name, effect);
}

}  // namespace gaitlab::report
