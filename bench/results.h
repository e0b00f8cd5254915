// The results of a race as a table, as JSON and as a plot.
#pragma once
#include <string>

#include "bench/race.h"

namespace gaitlab::versus {

inline constexpr double kGood = 0.01;  ///< worst joint's error at which engines are compared

/// A line per point that counts, the fastest of each kind at kGood with what it is to MuJoCo at its best and to bullet, and why
/// the other points do not count.
std::string table(const Results& results, bool markdown);

/// For a page: of the table above only the fastest points, as Markdown.
std::string digest(const Results& results);

/// `page` with `part` between its lines `<!-- versus: written by --renew -->` and `<!-- end of versus -->`. Throws RunError: it
/// does not have them.
std::string renewed(const std::string& page, const std::string& part);

/// Everything: machine, versions, settings, references, every point with the times of every round.
std::string json(const Results& results, const RaceSettings& settings);

std::string processor();  ///< the machine's, by name

/// SVG: error of the worst joint over simulated seconds per second, both logarithmic; a panel a scenario, a curve a contender.
std::string plot(const Results& results);

}  // namespace gaitlab::versus
