// Page with two runs: the second one is laid over the first.
#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "report/page/page_data.h"

namespace gaitlab::report {

/// A signal of the second run outside its band around the first one's.
struct Stray {
  std::string signal, unit;      ///< name of a channel of the page, as `joint.3.torque`
  double ratio = 0;              ///< RMS of the difference, in bands
  double tolerance = 0;          ///< in the unit: allowed deviation at any time
  std::optional<double> from{};  ///< s: the first time beyond the tolerance
  /// The second run minus the first, at the first one's rows; fewer if the second run has fewer. The channels are too coarse
  /// for it.
  std::vector<double> difference = {};
};

/// Common texts of a page's two runs.
struct PageOverlay {
  std::array<std::string, 2> labels{"A", "B"};  ///< short names of the runs, in the order of the page
  std::vector<std::string> differs = {};        ///< different settings of the second run, a sentence each
  std::string strayed = {};                     ///< a sentence on a run outside its golden's bands; empty: a page of two runs
  std::vector<Stray> strays = {};               ///< in the order of leaving their bands
};

/// The page of run `a`, with run `b` laid over it: docs/report.md, `overlay`. Throws nlohmann::json::exception if the texts are
/// not from page_data.
PageData overlaid(const PageData& a, const PageData& b, const PageOverlay& overlay);

}  // namespace gaitlab::report
