// A golden difference as text.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "golden/compare.h"

namespace gaitlab::golden {

/// Extent of a difference's text. brief: the start of a failure message, with the ten columns farthest outside their bands and
/// the distance (if no column is outside, ten numbers). strayed: all outside their bands. changed: the ten columns and numbers
/// with the largest changes, within their bands or not. Ordered by deviation in bands, largest first.
enum class Shown { brief, strayed, changed };

inline constexpr std::size_t kFewSettings = 5, kAllSettings = 1000;  ///< kAllSettings: on request

/// `since approval 2 (stiffer feet):`, a line.
std::string since_approval(const Golden& golden);

/// Changes of build and settings since the golden was approved: a line each, indented by two. At most `most` settings, and a
/// line with the number of the others.
std::string origin_changes(const GoldenProvenance& then, const GoldenProvenance& now, std::size_t most = kFewSettings);

/// `verdict: feasible -> infeasible: ...`, indented by two, in lines of at most `width` characters; "" if the word is the same,
/// or unknown for one of them.
std::string verdict_change(const Golden& golden, const GoldenRun& run, std::size_t width = 100);

/// Bands whose width changed by more than a fifth: the ten with the largest changes, a line each, indented by two. joints:
/// names, by their numbers in the columns.
std::string band_changes(const Golden& before, const Golden& now, const std::vector<std::string>& joints);

/// Number of columns outside their bands.
std::size_t strayed_columns(const GoldenDifference& difference);

/// `3 of 29 columns and 1 of 70 numbers outside their bands`: the same on screen, in XML and on a page.
std::string outside(const GoldenDifference& difference);

/// Findings, then a table of columns, then one of numbers, each line indented by two; "" if there is nothing to show.
std::string differences(const GoldenDifference& difference, Shown shown);

/// Number of columns and numbers outside their bands that differences(Shown::brief) does not name.
std::size_t left_out(const GoldenDifference& difference);

/// `0.0123 %`
std::string percent(double share);

/// Deviation in bands: `0.0123`, `1250`
std::string bands(double ratio);

/// `max(ensemble 0.2 %, halving 0.03 %, floor 0.001 %)`
std::string parts(const Band& band);

/// `1 column`, `3 columns`
std::string plural(std::size_t count, const std::string& what);

}  // namespace gaitlab::golden
