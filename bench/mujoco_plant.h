// Engine `mujoco`, which only the benchmarks use: MuJoCo simulates the robot, and control and trace are the same for every
// engine.
#pragma once
#include <string>

#include "core/plugin/catalog.h"

namespace gaitlab {

/// Adds engine `mujoco`. The model is the MJCF of the robot that the interchange room writes, without drawn shapes and with
/// docked bodies fused. Contact elements (a point becomes a sphere of 1e-6 m) touch the plane by MuJoCo's own contact law with
/// the ground's friction. One lane, floating base only. The integrators differ in their treatment of the motor's back-EMF, the
/// slope B of the torque over speed:
/// - euler, implicit, implicitfast (MuJoCo 3 only): settings that a user would choose. Joint damping is B, which the integrator
/// treats implicitly. The actuator's force is the motor's torque at rest under the command, limited by the largest current.
/// - dcmotor (MuJoCo 3.7 and later): as implicitfast, with MuJoCo's own DC motors, commanded in volts. They limit the
/// current themselves, as gaitlab's motor law does.
/// - armature: MuJoCo's best settings. There is no joint damping; dof_armature is h B, and the torque is that of the motor law
/// at the present speed. Therefore (M + h B) v' = tau + J^T f also applies in the contact solver, which cannot treat damping
/// implicitly. The solver makes at most three iterations and does not search for islands (MuJoCo 3.3.6 and later do so by
/// default). The errors keep the two digits that are printed, and MuJoCo 3.12 is up to a tenth faster.
/// The forces that `contacts` returns are those at the start of the last step. Works are not known and are 0. Throws RunError
/// for another base, a model that MuJoCo rejects, or a request for accelerations.
void register_mujoco(Catalog& catalog);

/// Compiler names in the bytes of a library, for example "GCC: (Debian 12.2.0) 12.2.0". clang's name precedes GCC's, which
/// every library contains because of the start-up files of the C library.
std::string compiler_of(const std::string& library);

/// Version of the loaded library, its file, and the compiler named in the file (Debian's file names none).
std::string mujoco_version();

}  // namespace gaitlab
