// Jobs and rows as bytes, for processes that work together.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "studies/run/executor.h"

namespace gaitlab::studies {

using Bytes = std::vector<std::uint8_t>;

/// CBOR: doubles keep their value to the bit, not a number stays so (of whichever kind), texts may hold any bytes.
Bytes packed(std::span<const Job> jobs);
Bytes packed(std::span<const Row> rows);
std::vector<Job> jobs_of(const Bytes& bytes);
std::vector<Row> rows_of(const Bytes& bytes);

}  // namespace gaitlab::studies
