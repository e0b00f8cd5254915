// Whether what a CPG gives is still numbers.
#pragma once
#include "core/model/robot.h"
#include "core/plugin/cpg.h"

namespace gaitlab {

/// Throws SimulationError, with the joint and, where it is the one, the state, if a set point or a state is not finite.
/// A state named NAME.NUMBER belongs to the joint of that number. Allocates nothing while all is well.
void check_cpg(const Cpg& cpg, const Robot& robot, In setpoint, In state, std::int64_t step, double time);

}  // namespace gaitlab
