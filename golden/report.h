// A golden difference as text for people.
#pragma once
#include <cstddef>
#include <string>

#include "golden/compare.h"

namespace gaitlab::golden {

enum class Shown { failing, worst };  ///< all that fail; the ten that strayed farthest, in bands

/// `since approval 2 (stiffer feet):`, a line.
std::string since_approval(const Golden& golden);

/// What of build, compiler, engine, integrator, step and scenario is not as it was when the golden was approved: a line each,
/// indented by two.
std::string origin_changes(const Golden& golden, const GoldenProvenance& now);

/// Bands that are wider or narrower by more than a fifth than before: the ten that changed most, a line each, indented by two.
std::string band_changes(const Golden& before, const Golden& now);

/// How many columns are outside their bands.
std::size_t strayed_columns(const GoldenDifference& difference);

/// `3 of 29 columns and 1 of 70 numbers outside their bands`: the same on screen, in XML and on a page.
std::string outside(const GoldenDifference& difference);

/// Findings, then a table of columns, then one of numbers, each line indented by two; "" where nothing of it is to be shown.
std::string differences(const GoldenDifference& difference, Shown shown);

/// `0.0123 %`
std::string percent(double share);

/// In bands: `0.0123`, `1250`
std::string bands(double ratio);

/// `max(ensemble 0.2 %, halving 0.03 %, floor 0.001 %)`
std::string parts(const Band& band);

/// `1 column`, `3 columns`
std::string plural(std::size_t count, const std::string& what);

}  // namespace gaitlab::golden
