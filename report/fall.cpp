#include "report/fall.h"

#include <algorithm>
#include <cmath>

namespace gaitlab::report {

std::optional<Fall> fall(const Scenario& scenario, const Recording& r) {
  const Ground::Kind ground = scenario.ground.kind;
  const Series height = r.series("com.z");
  if (scenario.base != Base::floating || height.empty() || !r.has_states(*scenario.robot)) return {};
  if (ground != Ground::Kind::plane && ground != Ground::Kind::boxes) return {};
  const auto base = [&](std::size_t row) {
    const auto at = [&](const char* column) { return r.series(column)[row]; };
    return Quat(at("base.qw"), at("base.qx"), at("base.qy"), at("base.qz"));
  };
  const Vec3 up = base(0).inverse() * Vec3::UnitZ();
  const auto time = [&](std::size_t row) { return std::min(static_cast<double>(row) * scenario.trace.period, r.simulated); };
  Fall found{.start = height[0], .lowest = height[0], .fallen_time = r.simulated};
  bool fallen = false;
  double least = 1;  // cosine of the tilt
  for (std::size_t row = 0; row < height.size(); ++row) {
    if (height[row] < found.lowest) {
      found.lowest = height[row];
      found.lowest_time = time(row);
    }
    if (!fallen && found.share() < scenario.limits.height) {
      fallen = true;
      found.fallen_time = time(row);
    }
    if (const double upright = (base(row) * up).z(); upright < least) {
      least = upright;
      found.tilt_time = time(row);
    }
  }
  found.tilt = std::acos(std::clamp(least, -1.0, 1.0));
  return found;
}

}  // namespace gaitlab::report
