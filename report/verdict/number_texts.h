// Formatting of summary numbers for the terminal and `swap`.
#pragma once
#include <string>
#include <vector>

#include "report/verdict/numbers.h"

namespace gaitlab::report::texts {

using Lines = std::vector<std::string>;

/// Three digits; `more than 1000 %`, `0.0001 % and less` where more digits have no meaning.
std::string percent(double share);
/// For estimates: two digits, three from 10 % on, `1000 % and more`.
std::string rough_percent(double share);

/// `5.2 mm`; from 1 m on in m, from 1 km on in km, three digits.
std::string length(double metres);

/// Three decimals; from a thousand on three digits.
std::string thousandths(double value);

/// Replaces nan and inf, with or without a sign, by `-` of the same width: a warning reports unknown values.
std::string without_nan(std::string text);

/// Energy that the gears created, J.
double created(const Recording& record);

/// Joint with the largest value of one of its statistics over the whole run; requires a joint.
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
/// `the gears create 17 % of the energy drawn (eq. 2)`, beside a cost of transport; empty up to 5 %.
std::string much_created(const RunData& run);
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
