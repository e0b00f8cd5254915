#include "report/remedy/remedy_ratings.h"

#include <algorithm>
#include <cmath>

#include "report/verdict/checks/loads.h"

namespace gaitlab::report {

namespace {

/// True if all parts with this check have the same rating.
bool same_ratings(const Scenario& scenario, const RemedySettings& settings, const CheckKind& kind) {
  if (const std::optional<DockQuantity> quantity = dock_quantity(kind.id)) {
    std::vector<double> limits = dock_limits(*scenario.robot, *quantity);
    std::erase_if(limits, [](double limit) { return std::isnan(limit); });
    return std::ranges::adjacent_find(limits, std::ranges::not_equal_to()) == limits.end();
  }
  return settings.uniform(kind.key);
}

/// Key of a rating, without its section for a motor or a dock.
std::string setting_of(const CheckKind& kind) {
  const std::string key = kind.key;
  return kind.group == CheckGroup::run ? key : key.substr(key.rfind('.') + 1);
}

bool exceeds(const Check& check) { return check.status == CheckStatus::fail || check.status == CheckStatus::too_close; }

const CheckKind& kind_of(const Check& check) {
  return *std::ranges::find_if(check_kinds(), [&](const CheckKind& kind) { return kind.id == check.id; });
}

}  // namespace

bool only_ratings(const Verdict& verdict) {
  return std::ranges::none_of(verdict.checks, [](const Check& check) { return exceeds(check) && !kind_of(check).rating; });
}

std::vector<RatingNeeded> ratings_needed(const Scenario& scenario, const Verdict& verdict, const RemedySettings& settings) {
  std::vector<RatingNeeded> ratings;
  for (const Check& check : verdict.checks) {
    if (!exceeds(check)) continue;
    const CheckKind& kind = kind_of(check);
    if (!kind.rating) continue;
    ratings.push_back({check.id, check.worst, setting_of(kind), rounded_setting(check.value * (1 + check.error), 0, true),
                       check.limit, check.unit, check.parts, same_ratings(scenario, settings, kind)});
  }
  return ratings;
}

}  // namespace gaitlab::report
