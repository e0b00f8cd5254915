#include "core/scenario/chosen_friction.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/plugin/plugin_instance.h"
#include "core/settings/wording.h"

namespace gaitlab {

namespace {

/// Values of a key with those that are chosen multiplied by a factor.
class Multiplied final : public Fields {
 public:
  Multiplied(const Robot& robot, const std::string& key, double factor) : robot_(robot), key_(key), factor_(factor) {}
  void visit(const Field& field) override {
    const auto* each = std::get_if<field::EachJoint>(&field.value);
    if (each == nullptr || each->usual == nullptr || key_ != field.key) return;
    const PerJoint value = in_force(*each);
    for (std::size_t j = 0; j < robot_.joints.size(); ++j) {
      const bool not_stated = each->value[j] == kNotStated;
      values.push_back(number_text(not_stated ? factor_ * value[j] : value[j]));
      chosen = chosen || (not_stated && robot_.joints[j].driven());
    }
  }
  void problem_at(const char*, std::string_view, std::size_t, std::string_view) override {}

  std::vector<std::string> values;
  bool chosen = false;  ///< true if the value of a motor is chosen

 private:
  const Robot& robot_;
  const std::string& key_;
  double factor_;
};

}  // namespace

std::string times_chosen(const Scenario& scenario, const std::string& key, double factor) {
  if (scenario.actuator.entry == nullptr) return "";
  Multiplied made(*scenario.robot, key, factor);
  visit_settings(*scenario.actuator.entry, scenario.actuator.settings.get(), made);
  if (!made.chosen) return "";
  const bool alike = std::ranges::count(made.values, made.values.front()) == std::ssize(made.values);
  return fmt::format("actuator.{}={}", key, alike ? made.values.front() : fmt::format("[{}]", fmt::join(made.values, ", ")));
}

std::vector<std::string> without_chosen_friction(const Scenario& scenario) {
  std::vector<std::string> sets;
  const bool plays = !joints_with_play(*scenario.robot).empty();
  for (const char* const key : kChosenFriction) {
    if (plays && std::string_view(key) == "rotor_inertia") continue;  // a motor within its play needs it
    if (std::string set = times_chosen(scenario, key, 0); !set.empty()) sets.push_back(std::move(set));
  }
  return sets;
}

}  // namespace gaitlab
