// Faults of the logs of a bench: numbers that no servo can have recorded, and rows that jump.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "identify/bench.h"

namespace gaitlab::identify {

/// Rows of a log whose angle is further from the last good row than the motor turns in 4 times that time, by number from 0.
struct Jumps {
  std::vector<std::size_t> spikes;  ///< up to five rows, after which the angle returns
  std::vector<std::size_t> steps;   ///< first rows of angles that do not return
  double fastest = 0;               ///< rad/s; 0 without a motor
};

/// Jumps of the angles of all joints. The first good row is the first one from which the next does not jump.
Jumps jumps_of(const Scenario& scenario);

/// `rows 57, 58`, counted from 1.
std::string row_list(const std::vector<std::size_t>& rows);

/// Text of a log without some rows, whose lines are left empty; of JSON, without some entries.
std::string without_rows(const std::string& text, const std::vector<std::size_t>& rows);

/// Throws InputError for a log that no servo can have recorded: an angle that does not move, that looks like degrees or ticks,
/// or that jumps (Jumps); a duty above 1; currents in mA; times in ms; rows of another log.
void check_logs(const std::vector<BenchLog>& logs);

}  // namespace gaitlab::identify
