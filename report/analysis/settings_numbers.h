// Numbers among the settings of any plugin.
#pragma once
#include <string>
#include <vector>

#include "core/plugin/plugin_instance.h"

namespace gaitlab::report {

/// Numbers by key: `Kp`, `model.ramp`; those in lists are left out.
class SettingsNumbers final : public Fields {
 public:
  struct Found {
    std::string key, unit;
    PerJoint value;
  };
  explicit SettingsNumbers(const PluginSelection& plugin);
  void visit(const Field& field) override;
  void problem_at(const char*, std::string_view, std::size_t, std::string_view) override {}

  [[nodiscard]] const std::vector<Found>& all() const { return found_; }
  /// nullptr: no such number.
  [[nodiscard]] const Found* find(const std::string& key) const;

 private:
  std::vector<Found> found_;
  std::string prefix_;
};

}  // namespace gaitlab::report
