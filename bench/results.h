// The results of a race as a table, as JSON and as a plot.
#pragma once
#include <string>

#include "bench/race.h"

namespace gaitlab::versus {

inline constexpr double kGood = 0.01;  ///< worst joint's error at which engines are compared

/// A line per point that counts, the fastest of each kind at kGood in comparison with MuJoCo's best set-up and bullet, and the
/// reasons why other points do not count.
std::string table(const Results& results, bool markdown);

/// Only the fastest points of the table above, as Markdown for a page.
std::string digest(const Results& results);

/// `page` with `part` between its lines `<!-- versus: written by --renew -->` and `<!-- end of versus -->`. Throws RunError if
/// it does not have them.
std::string renewed(const std::string& page, const std::string& part);

/// All results as JSON: machine, versions, settings, references, every point with the times of every round.
std::string json(const Results& results, const RaceSettings& settings);

std::string processor();  ///< name of the machine's processor

/// SVG: error of the worst joint over simulated seconds per second, both logarithmic; one panel per scenario, one curve per
/// contender.
std::string plot(const Results& results);

}  // namespace gaitlab::versus
