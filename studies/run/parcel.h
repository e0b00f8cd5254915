// Jobs and rows as bytes, for processes that cooperate.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "studies/run/executor.h"

namespace gaitlab::studies {

using Bytes = std::vector<std::uint8_t>;

/// Bytes of jobs in CBOR: doubles are exact, NaN remains NaN (of any kind), texts may contain any bytes.
Bytes packed(std::span<const Job> jobs);
Bytes packed(std::span<const Row> rows);
std::vector<Job> jobs_of(const Bytes& bytes);
std::vector<Row> rows_of(const Bytes& bytes);

}  // namespace gaitlab::studies
