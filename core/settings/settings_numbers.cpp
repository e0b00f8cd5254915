#include "core/settings/settings_numbers.h"

#include <algorithm>

namespace gaitlab {

SettingsNumbers::SettingsNumbers(const PluginSelection& plugin) {
  if (plugin.entry != nullptr) visit_settings(*plugin.entry, plugin.settings.get(), *this);
}

void SettingsNumbers::visit(const Field& field) {
  if (const auto* number = std::get_if<field::Number>(&field.value)) {
    found_.push_back(
        {prefix_ + field.key, number->spec.unit, PerJoint{number->value}, true, number->spec.min, number->spec.max});
  } else if (const auto* each = std::get_if<field::EachJoint>(&field.value)) {
    found_.push_back(
        {prefix_ + field.key, each->spec.unit, in_force(*each), !not_stated(*each), each->spec.min, each->spec.max});
  } else if (const auto* periods = std::get_if<field::Periods>(&field.value)) {
    found_.push_back({prefix_ + field.key, periods->spec.unit,
                      PerJoint{periods->most == nullptr ? periods->value : *periods->most}, true, periods->spec.min,
                      periods->spec.max});
  } else if (const auto* group = std::get_if<field::Group>(&field.value)) {
    const std::string before = prefix_;
    prefix_ += std::string(field.key) + ".";
    group->visit(group->self, *this);
    prefix_ = before;
  }
}

const SettingsNumbers::Found* SettingsNumbers::find(const std::string& key) const {
  const auto at = std::find_if(found_.begin(), found_.end(), [&](const Found& one) { return one.key == key; });
  return at == found_.end() ? nullptr : &*at;
}

}  // namespace gaitlab
