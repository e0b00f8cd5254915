// A page with two runs: the second one is laid over the first.
#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "report/page/page_data.h"

namespace gaitlab::report {

/// A signal of the second run that left its band around the first one's.
struct Stray {
  std::string signal, unit;      ///< name of a channel of the page, as `joint.3.torque`
  double ratio = 0;              ///< RMS of the difference, in bands
  double tolerance = 0;          ///< in the unit: how far it may be away at a time
  std::optional<double> from{};  ///< s: the first time beyond the tolerance
  /// The second run less the first, at the first one's rows; fewer where the second run has fewer. Channels are too coarse for
  /// it.
  std::vector<double> difference = {};
};

/// What a page says of its two runs together.
struct PageOverlay {
  std::array<std::string, 2> labels{"A", "B"};  ///< short names of the runs, in the order of the page
  std::vector<std::string> differs = {};        ///< where the settings of the second are others, a sentence each
  std::string strayed = {};                     ///< a sentence on a run that strayed from its golden; empty: a page of two runs
  std::vector<Stray> strays = {};               ///< the first to stray first
};

/// The page of run `a`, with run `b` laid over it: docs/report.md, `overlay`. Throws nlohmann::json::exception where the texts
/// are not of page_data.
PageData overlaid(const PageData& a, const PageData& b, const PageOverlay& overlay);

}  // namespace gaitlab::report
