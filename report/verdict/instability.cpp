#include "report/verdict/instability.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/scenario/sensor_section.h"
#include "core/settings/wording.h"

namespace gaitlab::report {

namespace {

constexpr double kBeyond = 1;  // rad beyond a range, at which the stop exerts 50 N m
constexpr double kFast = 10;   // m/s
constexpr double kFalls = 2;   // multiple of the speed of a fall

/// Largest value of rows, and the time of the first row above a bound; infinity if there is none.
struct Excess {
  double most = 0, first = INFINITY;
  void add(double t, double value, double bound) {
    most = std::max(most, value);
    if (value > bound) first = std::min(first, t);
  }
};

/// Angle of a joint beyond its range, rad.
Excess beyond(const Scenario& s, const Recording& r, std::size_t joint) {
  const Series t = r.pose("t");
  const Series angle = r.pose(fmt::format("joint.{}.angle", joint));
  const Joint& hinge = s.robot->joints[joint];
  Excess made;
  for (std::size_t k = 0; k < std::min(t.size(), angle.size()); ++k)
    made.add(t[k], std::max(angle[k] - hinge.hi, hinge.lo - angle[k]), kBeyond);
  return made;
}

/// Speed of the base, m/s, at times when it exceeds kFast and kFalls times the speed of a fall.
Excess thrown(const Scenario& s, const Recording& r) {
  const Series t = r.pose("t");
  const std::vector<Series> at{r.pose("base.x"), r.pose("base.y"), r.pose("base.z")};
  Excess made;
  if (std::ranges::any_of(at, &Series::empty)) return made;
  double highest = t.empty() ? 0 : at[2][0];
  for (std::size_t k = 1; k < t.size(); ++k) {
    highest = std::max(highest, at[2][k]);
    double way = 0;  // m^2
    for (const Series& axis : at) way += (axis[k] - axis[k - 1]) * (axis[k] - axis[k - 1]);
    const double speed = std::sqrt(way) / (t[k] - t[k - 1]);
    const double fall = std::sqrt(2 * s.physics.gravity.norm() * (highest - at[2][k]));
    if (speed > std::max(kFast, kFalls * fall)) made.add(t[k], speed, 0);
  }
  return made;
}

/// Gains of a joint, `Kp 600 V/rad, Kd 0.6 V s/rad, `; empty if the controller states no law.
std::string gains(const Scenario& s, std::size_t joint) {
  const std::vector<PositionGains> all = make_controller(s.controller, plugin_info(s))->gains();
  if (all.empty()) return "";
  const PositionGains& law = all[joint];
  std::string text = fmt::format("{} {}, ", law.key, with_unit(law.P / law.per_key, law.unit));
  if (law.D != 0) text += fmt::format("{} {}, ", law.key_of_D, with_unit(law.D, law.unit_of_D));
  return text;
}

}  // namespace

std::string instability(const Scenario& s, const Recording& r) {
  if (s.controller.entry == nullptr || r.joints.size() != s.robot->joints.size()) return "";
  std::size_t worst = 0;
  double most = 0;  // rad beyond its range of joint `worst`
  double from = INFINITY;
  std::size_t joints = 0;
  const Excess base = thrown(s, r);
  for (std::size_t j = 0; j < r.joints.size(); ++j) {
    const JointStatistics& joint = r.joints[j];
    if (!(joint.reversals > 0)) continue;
    const Excess angle = beyond(s, r, j);
    const double first = std::min(angle.first, base.first);
    if (!std::isfinite(first) || first < joint.reversing_from) continue;
    ++joints;
    from = std::min(from, joint.reversing_from);
    if (joints > 1 && angle.most <= most) continue;
    worst = j;
    most = angle.most;
  }
  if (joints == 0) return "";
  const std::string& name = s.robot->joints[worst].name;
  const std::string effect = most > kBeyond ? fmt::format("goes {:.3g} rad beyond its range", most)
                                            : fmt::format("throws the base about at {:.3g} m/s", base.most);
  return fmt::format(
      "the controller is unstable from {:.3g} s on ({}a command every {:.4g} s): the command of {} changes its "
      "sign in most control ticks; {} {}",
      from, gains(s, worst), s.control_period, joints == 1 ? name : fmt::format("{} joints", joints), name, effect);
}

}  // namespace gaitlab::report
