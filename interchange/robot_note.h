// Difference of a module from the robot file that it was made from.
#pragma once
#include <string>

#include "core/errors.h"

namespace gaitlab::interchange {

struct RobotNote {
  SourceLocation place;  ///< line 0 if it concerns the whole file
  std::string text;
  bool changed = false;  ///< true if the motion differs from that of the file as written; else a part was left out

  /// `Changed` or `Not carried over`.
  [[nodiscard]] const char* kind() const { return changed ? "Changed" : "Not carried over"; }
};

}  // namespace gaitlab::interchange
