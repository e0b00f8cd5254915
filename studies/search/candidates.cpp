#include "studies/search/candidates.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "studies/study/number.h"

namespace gaitlab::studies {

namespace {

/// Largest difference between two points in a coordinate, as a share of its range. Different listed values give 1.
double apart(const Study& study, const std::vector<std::string>& a, const std::vector<std::string>& b) {
  double most = 0;
  for (std::size_t k = 0; k < study.parameters.size(); ++k) {
    const Parameter& p = study.parameters[k];
    if (!p.values.empty()) {
      if (a[k] != b[k]) return 1;
      continue;
    }
    most = std::max(most, std::abs(share_at(p, number_of(a[k])) - share_at(p, number_of(b[k]))));
  }
  return most;
}

/// Points that divide the front evenly, including its ends.
std::vector<std::size_t> of_front(const Results& results, const std::vector<JournalObjective>& objectives, std::size_t most) {
  const std::vector<std::size_t> all = front(results.points, objectives);
  const std::size_t count = std::min(most, all.size());
  std::vector<std::size_t> chosen;
  for (std::size_t k = 0; k < count; ++k) chosen.push_back(all[count == 1 ? 0 : k * (all.size() - 1) / (count - 1)]);
  return chosen;
}

}  // namespace

std::vector<std::size_t> candidates(const Plan& plan, const Results& results, const std::vector<std::size_t>& tried) {
  constexpr std::array kApart{
      0.1, 0.01};  // least distances, as shares of the box: first for points far apart, then for further points
  const auto most = static_cast<std::size_t>(plan.study().verify.best);
  std::vector<JournalObjective> objectives;
  for (const Objective& o : plan.study().objectives) objectives.push_back({o.expression.text, o.maximize});
  if (objectives.size() > 1) return tried.empty() ? of_front(results, objectives, most) : std::vector<std::size_t>();
  const auto values = [&](std::size_t k) { return plan.points().values(plan.points().point(results.points[k].first_run)); };
  const std::vector<std::size_t> order = ranked(results.points, objectives.front().maximize);
  std::vector<std::size_t> chosen;
  for (const double distance : kApart) {
    for (const std::size_t k : order) {
      if (chosen.size() == most || !results.points[k].kept()) break;
      const auto near = [&](std::size_t other) { return apart(plan.study(), values(k), values(other)) <= distance; };
      if (std::ranges::none_of(chosen, near) && std::ranges::none_of(tried, near)) chosen.push_back(k);
    }
  }
  std::vector<std::size_t> best_first;
  std::ranges::copy_if(order, std::back_inserter(best_first),
                       [&](std::size_t k) { return std::ranges::find(chosen, k) != chosen.end(); });
  return best_first;
}

}  // namespace gaitlab::studies
