// Page of an identification.
#pragma once
#include <string>
#include <vector>

#include "identify/identify.h"

namespace gaitlab::identify {

/// HTML text in one file without scripts and network requests: tables of keys and errors, the sentences `limits`
/// (findings.h), correlations, `result` (the servo file or the settings), and a figure of every log, that with the largest
/// error first.
std::string identify_page(const Identified& made, const std::vector<BenchLog>& logs, const std::vector<Key>& keys,
                          const std::vector<std::string>& limits, const std::string& result);

}  // namespace gaitlab::identify
