// A page of two runs; the second run is drawn over the first.
#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "report/page/page_data.h"

namespace gaitlab::report {

/// A signal of the second run that leaves its band around the signal of the first run.
struct Stray {
  std::string signal, unit;      ///< name of the page's channel, for example `joint.3.torque`, and its unit
  double ratio = 0;              ///< RMS of the difference / band
  double tolerance = 0;          ///< allowed deviation at any time, in `unit`
  std::optional<double> from{};  ///< s, first time at which the difference exceeds the tolerance
  /// Second run minus first run, at the rows of the first run, or at fewer rows if the second run is shorter. It is stored
  /// because the quanta of the channels are too coarse for a difference.
  std::vector<double> difference = {};
};

/// Texts of a page of two runs.
struct PageOverlay {
  std::array<std::string, 2> labels{"A", "B"};  ///< short names of the two runs, in the order of the page
  /// Names of the run folders, which distinguish runs of one scenario; empty if a run has no folder.
  std::array<std::string, 2> folders = {};
  std::vector<std::string> differs = {};  ///< one sentence for each setting that is different in the second run
  std::string strayed = {};               ///< sentence on a run that left the bands of its golden; empty on a page that
                                          ///< compares two runs
  std::vector<Stray> strays = {};         ///< signals outside their bands, in the order in which they leave them
};

/// Page of run `a` with run `b` drawn over it (docs/report.md, `overlay`). Throws nlohmann::json::exception if the data were
/// not made by page_data.
PageData overlaid(const PageData& a, const PageData& b, const PageOverlay& overlay);

}  // namespace gaitlab::report
