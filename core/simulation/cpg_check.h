// Check that the output of a CPG is finite.
#pragma once
#include "core/model/robot.h"
#include "core/plugin/cpg.h"

namespace gaitlab {

/// Throws SimulationError if a set point or a state is not finite. The error names the joint and, if a state caused it, the
/// state. A state named NAME.NUMBER belongs to the joint NUMBER. Allocates only to throw.
void check_cpg(const Cpg& cpg, const Robot& robot, In setpoint, In state, std::int64_t step, double time);

}  // namespace gaitlab
