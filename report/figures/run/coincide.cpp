#include "report/figures/run/coincide.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace gaitlab::report {

namespace {

constexpr double kLeastRange = 1e-3;  // least range, in the panel's unit; a smaller range is only rounding error

bool same_curve(const std::vector<double>& time, double from, const std::vector<double>& a, const std::vector<double>& b) {
  double lo = INFINITY;
  double hi = -INFINITY;
  double apart = 0;
  for (std::size_t k = 0; k < time.size(); ++k) {
    if (time[k] < from) continue;
    if (!std::isfinite(a[k]) || !std::isfinite(b[k])) return false;
    lo = std::min({lo, a[k], b[k]});
    hi = std::max({hi, a[k], b[k]});
    apart = std::max(apart, std::abs(a[k] - b[k]));
  }
  return lo <= hi && apart <= kCoincide * std::max(hi - lo, kLeastRange);
}

}  // namespace

std::vector<std::vector<std::size_t>> coinciding(const std::vector<std::vector<double>>& time,
                                                 const std::vector<RunCurves>& panels) {
  const auto same = [&](std::size_t a, std::size_t b) {
    return time[a] == time[b] && !panels.empty() && std::ranges::all_of(panels, [&](const RunCurves& panel) {
             const auto& values = panel.values;
             return values[a].size() == time[a].size() && values[b].size() == time[b].size() &&
                    same_curve(time[a], panel.from, values[a], values[b]);
           });
  };
  std::vector<std::vector<std::size_t>> groups;
  for (std::size_t run = 0; run < time.size(); ++run) {
    const auto fits = [&](const auto& group) {
      return std::ranges::all_of(group, [&](std::size_t other) { return same(other, run); });
    };
    const auto group = std::ranges::find_if(groups, fits);
    if (group == groups.end()) {
      groups.push_back({run});
    } else {
      group->push_back(run);
    }
  }
  std::erase_if(groups, [](const auto& group) { return group.size() < 2; });
  return groups;
}

std::string run_names(const std::vector<std::size_t>& group, const std::vector<std::string>& of_runs) {
  std::vector<std::string> all;
  for (const std::size_t run : group) all.push_back(of_runs[run]);
  return fmt::format("{}", fmt::join(all, ", "));
}

}  // namespace gaitlab::report
