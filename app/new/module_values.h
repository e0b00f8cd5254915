// Values of a new module file from a robot file.
#pragma once
#include <string>

#include "interchange/robot_module.h"

namespace gaitlab::app {

/// The key `may_overlap`.
struct OverlapKey {
  std::string text;  ///< for the module file; empty if no bodies may overlap
  std::string note;  ///< on bodies that overlap at all angles; empty without such bodies
};

/// The pairs that the robot file excludes, and those that overlap at all angles (report/analysis/own_overlap.h).
OverlapKey overlap_key(const interchange::RobotModule& made);

/// A scenario on one line, for a module file without motors: it has the base and the contact elements of the module, and hinges
/// within their ranges. Throws InputError for a file that cannot be read.
std::string fall_text(const std::string& file);

}  // namespace gaitlab::app
