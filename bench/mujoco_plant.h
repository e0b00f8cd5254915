// Engine `mujoco`, of the benchmarks only: MuJoCo as a plant, so that loop, control and trace are the same for every engine.
#pragma once
#include <string>

#include "core/plugin/catalog.h"

namespace gaitlab {

/// Adds engine `mujoco`. The model is the interchange room's MJCF of the robot, without what is drawn and with docked bodies
/// fused; contact elements (points: spheres of 1e-6 m) touch the plane by MuJoCo's own law, f the ground's. One lane, floating
/// base. Its integrators are set-ups: how the motor's back-EMF (slope B of the torque at rest) is taken.
///     euler, implicit, implicitfast (MuJoCo 3 only): as a user would: joint damping B, which the integrator takes implicitly;
///         the motor's torque at rest under the command, limited by the largest current, as the actuator's force.
///     dcmotor (MuJoCo 3.7 and later): the same by MuJoCo's own DC motors, commanded in volts, under implicitfast;
///         they limit the current themselves, as the law does.
///     armature: at its best. No joint damping; dof_armature is h B, and the torque is the law's at the present speed, so that
///         (M + h B) v' = tau + J^T f holds in the solver of the contacts, too: that one knows no damping that is implicit.
///         Three iterations of the solver at most, and no search for islands (MuJoCo 3.3.6 and later search by default): both
///         errors keep the two digits that are printed, and MuJoCo 3.12 is up to a tenth faster.
/// The forces that `contacts` gives are those of the last step's start; works are not known and 0. Throws RunError: another
/// base, a model that MuJoCo does not take, accelerations asked for.
void register_mujoco(Catalog& catalog);

/// Compiler names within a library's bytes, "GCC: (Debian 12.2.0) 12.2.0" and the like. clang's name precedes GCC's, which
/// every library has from the C library's start-up files.
std::string compiler_of(const std::string& library);

/// Version of the loaded library, its file, and the compiler named in the file (Debian's names none).
std::string mujoco_version();

}  // namespace gaitlab
