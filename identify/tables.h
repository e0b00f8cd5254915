// Tables of an identification, for terminal and page.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "identify/identify.h"

namespace gaitlab::identify {

/// A table as text: the row of its heads, then its rows.
using Rows = std::vector<std::vector<std::string>>;

/// Mean errors by bench and fit: of the fitted logs, and of those held out.
Rows error_rows(const Identified& made, const std::vector<BenchLog>& logs);

/// The keys with values, intervals and worth.
Rows key_rows(const Identified& made, const std::vector<Key>& keys);

/// Correlations of the fitted keys, below the diagonal; empty if fewer than two keys have one.
Rows correlation_rows(const Identified& made, const std::vector<Key>& keys);

/// Indices of the logs, that with the largest error by the fit first.
std::vector<std::size_t> worst_first(const Identified& made);

/// The logs in this order, with errors and shares of the time at the limit.
Rows log_rows(const Identified& made, const std::vector<BenchLog>& logs);

}  // namespace gaitlab::identify
