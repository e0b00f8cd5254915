// Sections of a scenario that are read again for a rollout with other settings.
#pragma once
#include <string>
#include <vector>

#include "core/scenario/scenario.h"

namespace gaitlab {

/// Sections to which settings (in the form of --set) belong.
std::vector<std::string> sections_of(const std::vector<std::string>& sets);

class TouchedSections {
 public:
  /// All sections.
  TouchedSections() = default;
  /// These sections, and all sections whose defaults or checks depend on one of these. No names mean all sections.
  explicit TouchedSections(std::vector<std::string> names);

  [[nodiscard]] bool all() const { return names_.empty(); }
  [[nodiscard]] bool has(const std::string& section) const;
  [[nodiscard]] const std::vector<std::string>& names() const { return names_; }
  /// Sets these sections of a scenario to their defaults.
  void restart(Scenario& scenario) const;

 private:
  std::vector<std::string> names_;
};

}  // namespace gaitlab
