// A golden difference as text for people.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "golden/compare.h"

namespace gaitlab::golden {

/// What of a difference is shown. brief: how a failure begins, the ten columns that strayed farthest and the way it went (where
/// no column strayed, ten numbers). strayed: all outside their bands. changed: the ten columns and numbers that moved most, in
/// their bands or not. The farthest first, in bands.
enum class Shown { brief, strayed, changed };

inline constexpr std::size_t kFewSettings = 5, kAllSettings = 1000;  ///< the second for who asked for all

/// `since approval 2 (stiffer feet):`, a line.
std::string since_approval(const Golden& golden);

/// What of build and settings is not as it was when the golden was approved: a line each, indented by two. At most `most`
/// settings, and a line that counts the others.
std::string origin_changes(const GoldenProvenance& then, const GoldenProvenance& now, std::size_t most = kFewSettings);

/// `verdict: feasible -> infeasible: ...`, indented by two, in lines of at most `width` characters; "" where its word is the
/// same or not known of one of them.
std::string verdict_change(const Golden& golden, const GoldenRun& run, std::size_t width = 100);

/// Bands that are wider or narrower by more than a fifth than before: the ten that changed most, a line each, indented by two.
/// joints: names, by their numbers in the columns.
std::string band_changes(const Golden& before, const Golden& now, const std::vector<std::string>& joints);

/// How many columns are outside their bands.
std::size_t strayed_columns(const GoldenDifference& difference);

/// `3 of 29 columns and 1 of 70 numbers outside their bands`: the same on screen, in XML and on a page.
std::string outside(const GoldenDifference& difference);

/// Findings, then a table of columns, then one of numbers, each line indented by two; "" where nothing of it is to be shown.
std::string differences(const GoldenDifference& difference, Shown shown);

/// How many columns and numbers outside their bands differences(Shown::brief) does not name.
std::size_t left_out(const GoldenDifference& difference);

/// `0.0123 %`
std::string percent(double share);

/// In bands: `0.0123`, `1250`
std::string bands(double ratio);

/// `max(ensemble 0.2 %, halving 0.03 %, floor 0.001 %)`
std::string parts(const Band& band);

/// `1 column`, `3 columns`
std::string plural(std::size_t count, const std::string& what);

}  // namespace gaitlab::golden
