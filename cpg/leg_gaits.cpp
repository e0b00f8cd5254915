#include "cpg/leg_gaits.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "core/math/functions.h"

namespace gaitlab::cpg {

namespace {

/// Number of each leg by its angle about the middle, from the front to the left.
std::vector<std::size_t> around(const std::vector<Leg>& legs) {
  constexpr double kRounding = 1e-6;  // rad, so that a leg straight ahead is the first
  const auto turned = [&](std::size_t i) {
    return legs[i].angle < -kRounding ? legs[i].angle + 2 * std::numbers::pi : legs[i].angle;
  };
  std::vector<std::size_t> order(legs.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return turned(a) < turned(b); });
  std::vector<std::size_t> number(legs.size());
  for (std::size_t k = 0; k < order.size(); ++k) number[order[k]] = k;
  return number;
}

/// Largest number of legs on a side.
std::int64_t on_a_side(const std::vector<Leg>& legs) {
  std::int64_t most = 1;
  for (const Leg& leg : legs) most = std::max(most, leg.count);
  return most;
}

bool two_sides(const std::vector<Leg>& legs) {
  return std::all_of(legs.begin(), legs.end(), [](const Leg& leg) { return leg.side != 0; });
}

std::string names_of(const std::vector<Leg>& legs) {
  std::string text;
  for (const Leg& leg : legs) text += (text.empty() ? "" : ", ") + leg.name;
  return text;
}

}  // namespace

double duty_of(Gait gait, const std::vector<Leg>& legs) {
  const auto count = static_cast<double>(two_sides(legs) ? 2 * on_a_side(legs) : static_cast<std::int64_t>(legs.size()));
  switch (gait) {
    case Gait::gallop:
      return 0.4;
    case Gait::walk:
    case Gait::ripple:
      return 0.75;
    case Gait::crawl:
      return 0.85;
    case Gait::wave:
      return 1 - 1 / count;
    default:
      return 0.5;
  }
}

std::vector<double> phases_of(Gait gait, const std::vector<Leg>& legs) {
  constexpr double kAhead = 1e-6;  // a leg with a larger cosine is in front of the middle
  constexpr double kGallop = 0.1;  // lead of the right legs
  const std::vector<std::size_t> number = around(legs);
  const bool even = legs.size() % 2 == 0;
  const bool alternates = gait == Gait::trot || gait == Gait::tripod || gait == Gait::alternate;
  if (alternates && !even) {
    throw std::invalid_argument("gait " + std::string(kGaitNames[static_cast<std::size_t>(gait)]) +
                                " needs an even number of legs; found " + std::to_string(legs.size()) + ": " + names_of(legs));
  }
  const bool sides = two_sides(legs);
  std::vector<double> phases;
  for (std::size_t i = 0; i < legs.size(); ++i) {
    const Leg& leg = legs[i];
    const double right = leg.side < 0 ? 0.5 : 0;
    const double behind = static_cast<double>(leg.count - 1 - leg.rank);  // number from the rear
    const double rear = math::cos(leg.angle) > kAhead ? 0 : 0.5;
    switch (gait) {
      case Gait::pace:
        phases.push_back(right);
        break;
      case Gait::bound:
        phases.push_back(rear);
        break;
      case Gait::gallop:
        phases.push_back(rear + (leg.side < 0 ? kGallop : 0));
        break;
      case Gait::walk:
      case Gait::crawl:
      case Gait::wave:
        phases.push_back(sides ? right - behind * 0.5 / static_cast<double>(leg.count)
                               : -static_cast<double>(number[i]) / static_cast<double>(legs.size()));
        break;
      case Gait::ripple:
        phases.push_back(sides ? right - behind * 0.25 : -0.25 * static_cast<double>(number[i]));
        break;
      default:
        phases.push_back(number[i] % 2 == 0 ? 0 : 0.5);
    }
    phases.back() -= std::floor(phases.back());
  }
  return phases;
}

}  // namespace gaitlab::cpg
