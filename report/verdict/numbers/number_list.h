// Three sections of the list of summary numbers, declared in the order of the list.
#pragma once
#include <vector>

#include "report/verdict/numbers/numbers.h"

namespace gaitlab::report {

std::vector<SummaryNumber> run_numbers();
std::vector<SummaryNumber> joint_numbers();
std::vector<SummaryNumber> motion_numbers();

/// JSON number, or null for NaN and infinity.
nlohmann::ordered_json or_null(double value);

}  // namespace gaitlab::report
