// Limits of an identification: what the logs leave open, and where the fitted model differs from them.
#pragma once
#include <string>
#include <vector>

#include "identify/identify.h"

namespace gaitlab::identify {

/// Sentences for a person: keys that trade with others, keys with wide intervals, quantities that no log has, limits that no
/// log reaches, logs with other times at the limit or errors far above those of the others.
std::vector<std::string> findings(const Identified& made, const std::vector<BenchLog>& logs, const std::vector<Key>& keys);

}  // namespace gaitlab::identify
