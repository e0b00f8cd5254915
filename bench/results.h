// Results of a race as a table, as JSON and as a plot.
#pragma once
#include <string>

#include "bench/race.h"

namespace gaitlab::versus {

inline constexpr double kGood = 0.01;  ///< error of the worst joint at which the speeds of engines are compared

/// Table with a line for each result that counts. Below it are the fastest result of each group at error kGood, compared with
/// MuJoCo's best set-up and with bullet, and the reasons why other results do not count.
std::string table(const RaceResults& results, bool markdown);

/// The fastest results of that comparison alone, as Markdown for a documentation page.
std::string digest(const RaceResults& results);

/// The text `page` in which `part` replaces the lines between `<!-- versus: written by --renew -->` and `<!-- end of versus
/// -->`. Throws RunError if these lines are missing.
std::string renewed(const std::string& page, const std::string& part);

/// All results as JSON: machine, versions, settings, references, and every point with its times in every round.
std::string json(const RaceResults& results, const RaceSettings& settings);

std::string processor();  ///< name of the machine's processor

/// SVG plot of the error of the worst joint over the simulated seconds per second, both logarithmic, with one panel per
/// scenario and one curve per contender.
std::string plot(const RaceResults& results);

}  // namespace gaitlab::versus
