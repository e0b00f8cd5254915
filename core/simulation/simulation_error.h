// Error that ends a run.
#pragma once
#include <cstdint>
#include <string>

#include "core/errors.h"
#include "core/recording/outcome.h"

namespace gaitlab {

/// Thrown if the state diverges (a number is not finite, or above 1e5) or a plugin throws. what() contains the step, the time,
/// and the joint or plugin.
class SimulationError : public RunError {
 public:
  SimulationError(Ended ended, std::int64_t step, double time, std::string where, const std::string& what);
  [[nodiscard]] Outcome outcome() const { return {ended, what()}; }
  Ended ended;
  std::int64_t step;
  double time;
  std::string where;  ///< a joint's name, "base", or the kind of the plugin
};

}  // namespace gaitlab
