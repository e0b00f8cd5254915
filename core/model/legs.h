// Legs of a robot, found from its links and its pose.
#pragma once
#include <array>
#include <span>
#include <vector>

#include "core/model/frames.h"
#include "core/plugin/robot_info.h"

namespace gaitlab {

struct Robot;

inline Vec3 vector_of(const std::array<double, 3>& a) { return {a[0], a[1], a[2]}; }

/// Horizontal direction forwards, unit vector in the base frame: +x, or +y if x is within 30 degrees of the vertical. `up` is
/// the upward direction (unit vector, base frame).
Vec3 forwards(const Vec3& up);

/// Legs of a robot whose joints have the angles `q` (rad) and whose base has the orientation `base` (base frame to world), from
/// front to rear, with left before right.
///
/// A chain begins at a link without children and goes towards the base, up to the first link with several children or to link
/// 0. It is a leg if it has a motor, if its last link has contact elements and is not a wheel, and if it stands: its lowest
/// element is within a tenth of the robot's height of the lowest of all. So is a chain with as many joints and, to 1 cm, the
/// same distances between them and to the foot. If fewer than two chains stand, the largest group of four or more equal chains
/// with two joints or more are the legs. A robot of only two chains, such as a snake whose base is in the middle, has legs only
/// if link 0 is above the ground by more than a tenth of the height. If the robot has stated legs, these are its legs, by their
/// names; only their order and places are found.
std::vector<Leg> legs_of(const Robot& robot, std::span<const double> q, const Mat3& base);

}  // namespace gaitlab
