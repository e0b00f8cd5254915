// Jobs and rows as bytes, for exchange between cooperating processes.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "studies/run/executor.h"

namespace gaitlab::studies {

using Bytes = std::vector<std::uint8_t>;

/// Bytes of jobs in CBOR. Doubles are exact, every NaN remains a NaN, and texts may contain any bytes.
Bytes packed(std::span<const Job> jobs);
Bytes packed(std::span<const Row> rows);
std::vector<Job> jobs_of(const Bytes& bytes);
std::vector<Row> rows_of(const Bytes& bytes);

}  // namespace gaitlab::studies
