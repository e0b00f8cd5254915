#include "report/analysis/harmonic.h"

#include <cmath>
#include <numbers>

#include "core/math/functions.h"

namespace gaitlab::report {

std::vector<Harmonic> first_harmonics(const MotionCycle& cycle, const Series& time, const std::vector<Series>& signals) {
  if (!cycle.found || !(cycle.period > 0) || time.empty()) return {};
  constexpr double kRounding = 1e-9;
  const double end = time.back();
  const double periods = std::max(1.0, std::floor((end - time.front() - cycle.from) / cycle.period + kRounding));
  const double start = end - periods * cycle.period;
  Mat3 normal = Mat3::Zero();
  std::vector<Vec3> basis;
  std::size_t first = 0;
  for (std::size_t row = 0; row < time.size(); ++row) {
    if (time[row] <= start + kRounding) {
      first = row + 1;
      continue;
    }
    const auto [sine, cosine] = math::sincos(2 * std::numbers::pi * time[row] / cycle.period);
    basis.emplace_back(1, sine, cosine);
    normal += basis.back() * basis.back().transpose();
  }
  const auto solver = normal.ldlt();
  std::vector<Harmonic> found;
  for (const Series& signal : signals) {
    Vec3 right = Vec3::Zero();
    for (std::size_t i = 0; i < basis.size() && !signal.empty(); ++i) right += basis[i] * signal[first + i];
    const Vec3 fit = solver.solve(right);
    found.push_back({std::hypot(fit[1], fit[2]), math::atan2(fit[2], fit[1])});
  }
  return found;
}

}  // namespace gaitlab::report
