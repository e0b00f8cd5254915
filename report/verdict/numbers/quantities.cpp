#include "report/verdict/numbers/quantities.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

namespace gaitlab::report {

std::string short_name(const SummaryNumber& number) { return number.name("").substr(1); }

namespace {

constexpr double kNotKnown = std::numeric_limits<double>::quiet_NaN();

/// Quantities of the whole robot that are known for a run that ended early. Quantities of joints are known if they cover the
/// whole run.
constexpr std::array<std::string_view, 11> kSoFar{
    "simulated",     "displacement.x", "displacement.y",       "distance", "speed", "path_length", "straightness",
    "forward_speed", "heading_change", "tracking_error.worst", "fell"};

std::vector<SummaryQuantity> all_quantities() {
  std::vector<SummaryQuantity> all;
  const auto has = [&](const std::string& name) {
    return std::ranges::any_of(summary_numbers(),
                               [&](const SummaryNumber& n) { return n.of_joint == nullptr && n.key == name; });
  };
  for (const SummaryNumber& number : summary_numbers()) {
    if (number.words || number.list || number.clock) continue;
    if (number.of_joint == nullptr) {
      all.push_back({number.key, &number});
    } else if (!has(short_name(number))) {
      all.push_back({short_name(number), &number, SummaryQuantity::Of::largest});
    }
  }
  return all;
}

}  // namespace

double SummaryQuantity::value(const RunData& run) const {
  if (of == Of::joint) return number->of_joint(run, joint);
  if (of == Of::largest) {
    double most = kNotKnown;
    for (std::size_t j = 0; j < run.record.joints.size(); ++j) {
      const double one = number->of_joint(run, j);
      if (!(one <= most)) most = one;
      if (std::isnan(one)) return one;
    }
    return most;
  }
  const nlohmann::ordered_json value = number->value(run);
  if (value.is_boolean()) return value.get<bool>() ? 1 : 0;
  return value.is_number() ? value.get<double>() : kNotKnown;
}

std::string SummaryQuantity::meaning() const {
  const std::string text = number->definition;
  return of == Of::largest ? "Largest over all joints. " + text : of == Of::joint ? "This joint. " + text : text;
}

const std::vector<SummaryQuantity>& quantities() {
  static const std::vector<SummaryQuantity> kAll = all_quantities();
  return kAll;
}

bool known_so_far(const SummaryQuantity& quantity) {
  const std::string_view key = quantity.number->key;
  if (quantity.of == SummaryQuantity::Of::run) return std::ranges::find(kSoFar, key) != kSoFar.end();
  return key.find(".judged.") == std::string_view::npos;
}

double value_so_far(const SummaryQuantity& quantity, const Scenario& scenario, const Recording& so_far) {
  return quantity.value({scenario, so_far, travelled(so_far)});
}

std::optional<SummaryQuantity> joint_quantity(const std::string& name, const Robot& robot, std::size_t joint) {
  for (const SummaryNumber& number : summary_numbers()) {
    if (number.of_joint != nullptr && short_name(number) == name)
      return SummaryQuantity{name + "[" + robot.joints[joint].name + "]", &number, SummaryQuantity::Of::joint, joint};
  }
  return {};
}

}  // namespace gaitlab::report
