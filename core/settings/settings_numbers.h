// List of all numbers among the settings of a plugin or in a section.
#pragma once
#include <string>
#include <vector>

#include "core/plugin/plugin_instance.h"

namespace gaitlab {

/// Numbers by key, such as `Kp` or `model.ramp`. Lists are left out, and a range of delays counts as its longest delay.
class SettingsNumbers final : public Fields {
 public:
  struct Found {
    std::string key, unit;
    PerJoint value;
    bool stated = true;       ///< false for a value that follows from other fields
    double min = 0, max = 0;  ///< range of the setting
  };
  explicit SettingsNumbers(const PluginSelection& plugin);
  /// Numbers of a section.
  template <class Section>
  static SettingsNumbers of(Section section) {
    SettingsNumbers made;
    section.fields(made);
    return made;
  }
  void visit(const Field& field) override;
  void problem_at(const char*, std::string_view, std::size_t, std::string_view) override {}

  [[nodiscard]] const std::vector<Found>& all() const { return found_; }
  /// The number with this key, or nullptr if there is none.
  [[nodiscard]] const Found* find(const std::string& key) const;

 private:
  SettingsNumbers() = default;
  std::vector<Found> found_;
  std::string prefix_;
};

}  // namespace gaitlab
