// Text of the differences between a run and its golden.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "golden/compare.h"

namespace gaitlab::golden {

/// Extent of the text on a difference. Columns and numbers are sorted by deviation in bands, largest first.
/// - brief: the start of a failure message, with the ten columns farthest outside their bands and the distance; if no column is
///   outside, ten numbers.
/// - strayed: all columns and numbers outside their bands.
/// - changed: the ten columns and the ten numbers with the largest changes, within their bands or not.
enum class Shown { brief, strayed, changed };

/// Largest number of changed settings in a text, by default and if the user asks for all settings.
inline constexpr std::size_t kFewSettings = 5, kAllSettings = 1000;

/// Line such as `since approval 2 (stiffer feet):`.
std::string since_approval(const Golden& golden);

/// Changes of build and settings since the golden was approved, one line each, indented by two. After `most` settings, a last
/// line gives the count of the omitted ones.
std::string origin_changes(const GoldenProvenance& then, const GoldenProvenance& now, std::size_t most = kFewSettings);

/// Text `verdict: feasible -> infeasible: ...`, indented by two, in lines of at most `width` characters. "" if both words are
/// equal or if one of them is unknown.
std::string verdict_change(const Golden& golden, const GoldenRun& run, std::size_t width = 100);

/// The ten largest changes of bands whose width changed by more than a fifth, one line each, indented by two. `joints` are
/// joint names, by their numbers in the columns.
std::string band_changes(const Golden& before, const Golden& now, const std::vector<std::string>& joints);

/// Number of columns outside their bands.
std::size_t strayed_columns(const GoldenDifference& difference);

/// Text such as `3 of 29 columns and 1 of 70 numbers outside their bands`, which is equal on screen, in XML and on a page.
std::string outside(const GoldenDifference& difference);

/// Findings, then a table of columns, then a table of numbers, each line indented by two. "" if all of them are empty.
std::string differences(const GoldenDifference& difference, Shown shown);

/// Number of columns and numbers that are outside their bands but not part of differences(Shown::brief).
std::size_t left_out(const GoldenDifference& difference);

/// Percentage, such as `0.0123 %`.
std::string percent(double share);

/// Deviation in bands, such as `0.0123` or `1250`.
std::string bands(double ratio);

/// Parts of a band, as in `max(ensemble 0.2 %, halving 0.03 %, floor 0.001 %)`.
std::string parts(const Band& band);

/// Number with a noun in singular or plural: `1 column`, `3 columns`.
std::string plural(std::size_t count, const std::string& what);

}  // namespace gaitlab::golden
