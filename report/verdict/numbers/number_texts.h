// Formatting of summary numbers for the terminal and `swap`.
#pragma once
#include <string>
#include <vector>

#include "report/verdict/numbers/numbers.h"

namespace gaitlab::report::texts {

using Lines = std::vector<std::string>;

/// Percentage with three digits. Values for which more digits have no meaning become `more than 1000 %` or `less than 0.0001
/// %`.
std::string percent(double share);
/// Percentage of an estimate, with two digits, or three from 10 % on. Above 1000 % it is `more than 1000 %`.
std::string rough_percent(double share);

/// Percentage of a time, which consists of steps: with three digits, or `less than 0.01 %`.
std::string share_of_time(double share);

/// Id of a check in a sentence: `gear_peak` becomes `gear peak`.
std::string spaced(std::string id);

/// Length with three digits, in mm below 1 m (`5.2 mm`), in m below 1 km, then in km.
std::string length(double metres);

/// Number with three decimals, or with three digits from 1000 on.
std::string thousandths(double value);

/// Replaces nan and inf, with or without a sign, by `-` of the same width. A separate warning reports the numbers that are not
/// finite.
std::string without_nan(std::string text);

/// Energy that the gears create in the whole run, J.
double created(const Recording& record);

/// Index of the joint with the largest value of this statistic over the whole run. The robot must have a joint.
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
/// True if no real motors can have this cost of transport: they lose less than 1 % of the energy drawn, in windings, gears and
/// friction, or the cost is below the rolling resistance of steel wheels on rails, 0.001 of the weight.
bool lossless(const RunData& run);
/// Text `the gears create 17 % of the energy drawn (eq. 2)`, printed beside a cost of transport. Empty up to 5 %.
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
