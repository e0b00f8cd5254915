// Signals of a run drawn over those of another, with their differences.
#pragma once
#include <optional>
#include <string>
#include <vector>

namespace gaitlab::report {

struct OverlayPanel {
  std::string name, unit;
  std::vector<double> time = {};                 ///< s, rising
  std::vector<double> reference = {}, now = {};  ///< in the unit, as long as `time`; not finite: a gap
  double tolerance = 0;                          ///< in the unit; drawn in the difference
  std::optional<double> outside = {};            ///< s, first time beyond the tolerance: marked
};

/// An SVG document, 1000 px wide, from top to bottom per panel both signals and, on a separate axis, their difference. Panels
/// without rows are left out.
std::string overlay_svg(const std::string& title, const std::vector<OverlayPanel>& panels);

}  // namespace gaitlab::report
