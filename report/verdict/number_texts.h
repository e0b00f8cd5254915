// How the terminal and `swap` print summary numbers.
#pragma once
#include <string>
#include <vector>

#include "report/verdict/numbers.h"

namespace gaitlab::report::texts {

using Lines = std::vector<std::string>;

/// Three digits; `more than 1000 %`, `0.0001 % and less` of what more digits would say nothing about.
std::string percent(double share);
/// Of estimates: two digits, three from 10 % on, `1000 % and more`.
std::string rough_percent(double share);

/// `5.2 mm`; from 1 m on in m, from 1 km on in km, three digits.
std::string length(double metres);

/// Three decimals; of a thousand and more three digits.
std::string thousandths(double value);

/// The words nan and inf, with or without a sign, as `-`, as wide as they were: what is not known is told in a warning.
std::string without_nan(std::string text);

/// J: what the gears gave instead of losing it.
double created(const Recording& record);

/// The joint with the largest value of one of its statistics over the whole run; there is a joint.
std::size_t worst(const Recording& record, double JointStatistics::*member);

Lines simulated(const RunData& run);
Lines engine(const RunData& run);
Lines steps(const RunData& run);
Lines robot(const RunData& run);
Lines distance(const RunData& run);
Lines speed(const RunData& run);
Lines limit_cycle(const RunData& run);
Lines transport(const RunData& run);
Lines window(const RunData& run);
Lines limits(const RunData& run);
Lines most_loaded(const RunData& run);
Lines tracking(const RunData& run);
Lines drawn(const RunData& run);
Lines ledger(const RunData& run);
Lines created_energy(const RunData& run);
Lines range(const RunData& run);
Lines stability(const RunData& run);

std::string speed_cell(const RunData& run);
std::string travel_cell(const RunData& run);
std::string cost_cell(const RunData& run);
std::string torque_cell(const RunData& run);
std::string saturated_cell(const RunData& run);
std::string tracking_cell(const RunData& run);
std::string limit_cycle_cell(const RunData& run);

}  // namespace gaitlab::report::texts
