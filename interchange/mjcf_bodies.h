// Bodies and hinges of a robot in MJCF.
#pragma once
#include "interchange/mjcf_text.h"
#include "interchange/robot_bodies.h"

namespace gaitlab::interchange {

/// The robot is the tree of the world with the most hinges; other trees are left out, with a note. A body without joints is one
/// with its parent. Several hinges in one body have bodies without mass between them.
///
/// | MJCF | module |
/// |---|---|
/// | free joint at the root; slides along x and z and a hinge about y; none; hinges | base floating; planar; fixed; a fixed
/// body | | angle | angle minus that of the pose as written (`ref`) | | geom that collides | shape; a capsule is a cylinder
/// with a sphere at each end, a mesh or ellipsoid the hull of at most 32 of its points | | actuator of a joint | servo: torque
/// at rest = gear x largest force (`ctrlrange` of a motor, `forcerange`, `actuatorfrcrange`), or chosen (holding_torques) | |
/// armature, frictionloss, damping | rotor_inertia, dry_friction, viscous_friction; spring, damping and friction of a hinge
/// without a motor | | exclude, contype and conaffinity | may_overlap |
///
/// Adds a problem for other joints, unless they are locked; the bodies and hinges are then not valid. Throws InputError with
/// the message of libmujoco.
RobotBodies mjcf_bodies(MjcfText& text, const ImportOptions& options, Problems& problems);

}  // namespace gaitlab::interchange
