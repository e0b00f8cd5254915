// A figure of two runs that shows signals of one run, those of the reference, and their differences.
#pragma once
#include <optional>
#include <string>
#include <vector>

namespace gaitlab::report {

struct OverlayPanel {
  std::string name, unit;
  std::vector<double> time = {};                 ///< s, rising
  std::vector<double> reference = {}, now = {};  ///< in `unit`, as long as `time`; values not finite leave a gap
  double tolerance = 0;                          ///< allowed difference in `unit`, above 0
  std::string others = {};                       ///< remark on signals that are not drawn, behind the name
  std::optional<double> outside = {};            ///< s, first time at which the difference exceeds the tolerance; it is marked
};

/// SVG document, 1000 px wide. Each panel shows both signals and, below them on a logarithmic axis, the magnitude of their
/// difference as a multiple of the tolerance, which is often a thousandth of the signals. Panels without rows are left out.
std::string overlay_svg(const std::string& title, const std::vector<OverlayPanel>& panels);

}  // namespace gaitlab::report
