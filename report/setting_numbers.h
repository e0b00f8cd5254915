// The settings of a plugin as numbers by key, whichever plugin it is.
#pragma once
#include <algorithm>
#include <string>
#include <variant>
#include <vector>

#include "core/plugin/plugin_instance.h"

namespace gaitlab::report {

/// The numbers of a plugin's settings, by key: `Kp`, `model.ramp`.
class SettingNumbers final : public Fields {
 public:
  struct Found {
    std::string key, unit;
    PerJoint value;
  };
  explicit SettingNumbers(const PluginSelection& plugin) {
    if (plugin.entry != nullptr) visit_settings(*plugin.entry, plugin.settings.get(), *this);
  }
  void visit(const Field& field) override {
    if (const auto* number = std::get_if<field::Number>(&field.value)) {
      found_.push_back({prefix_ + field.key, number->spec.unit, PerJoint{number->value}});
    } else if (const auto* each = std::get_if<field::EachJoint>(&field.value)) {
      found_.push_back({prefix_ + field.key, each->spec.unit, each->value});
    } else if (const auto* group = std::get_if<field::Group>(&field.value)) {
      const std::string before = prefix_;
      prefix_ += std::string(field.key) + ".";
      group->visit(group->self, *this);
      prefix_ = before;
    }
  }
  void problem_at(const char*, std::string_view, std::size_t, std::string_view) override {}

  [[nodiscard]] const std::vector<Found>& all() const { return found_; }
  [[nodiscard]] const Found* find(const std::string& key) const {
    const auto at = std::find_if(found_.begin(), found_.end(), [&](const Found& one) { return one.key == key; });
    return at == found_.end() ? nullptr : &*at;
  }

 private:
  std::vector<Found> found_;
  std::string prefix_;
};

}  // namespace gaitlab::report
