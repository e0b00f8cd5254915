// Limits of an identification: numbers that do not follow from the logs, and logs from which the fit differs.
#pragma once
#include <string>
#include <vector>

#include "identify/identify.h"

namespace gaitlab::identify {

/// Sentences for the terminal: keys that trade with others, keys with wide intervals or at a bound, quantities missing in the
/// logs, limits that no log reaches, logs with other times at the limit or far larger errors than the others.
std::vector<std::string> findings(const Identified& made, const std::vector<BenchLog>& logs, const std::vector<Key>& keys);

}  // namespace gaitlab::identify
