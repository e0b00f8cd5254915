// A robot that moves, for viewers and Blender.
#pragma once
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/model/role.h"
#include "core/recording/recording.h"
#include "core/scenario/scenario.h"

namespace gaitlab::interchange {

inline constexpr double kGltfRate = 60;  ///< Hz, of keyframes at most

/// What a glTF file holds besides the run. Colours: `#RRGGBB`, sRGB.
struct GltfLook {
  std::string generator;                     ///< of the file: program and version
  std::string_view (*body)(Role) = nullptr;  ///< colour
  std::string_view ground, tile, box, moving_box;
};

struct Gltf {
  std::string bytes;       ///< of the .glb file
  std::size_t frames = 0;  ///< keyframes
};

/// A binary glTF 2.0 file of the robot and its ground, and with a `recording` one animation of its run: keyframes at trace rows
/// at least 1/60 s apart and at the last row. Without one, or with one row only, the robot stands as it starts.
///
/// Nodes: `world` turns z up into glTF's y up. In it stand the ground, its boxes, and the links in one another: `base`, `joint
/// m3/passive` ...; in each link the bodies that move with it, one mesh per body type. So a joint is a turn about its axis, at
/// every time between two keyframes, too: bodies that each had a pose of their own would leave their hinges there; and a joint
/// takes 16 bytes a keyframe where such bodies take 28. What does not move has no channel.
///
/// Numbers of the animation are float32. A quaternion, of length 1 in double, so turns by up to 2^-23 rad (1.2e-7) wrongly,
/// which moves what is a distance d away by 1.2e-7 d; these errors add up along a chain of joints. The base and moving boxes
/// are off by up to 2^-24 (6e-8) of each of their coordinates, and times of themselves. Signs of quaternions are continuous.
///
/// Assumes recording->has_states(robot). Boxes that move stand as they start where the recording does not hold them.
/// InputError: numbers that are not finite; more than 4 GiB.
Gltf to_gltf(const Scenario& scenario, const Recording* recording, const GltfLook& look);

/// Bodies that no shape draws, by name.
std::vector<std::string> bodies_without_shape(const Robot& robot);

/// Boxes that may move and whose way the recording does not hold, by number in `ground.boxes`.
std::vector<std::size_t> boxes_without_way(const Scenario& scenario, const Recording& recording);

}  // namespace gaitlab::interchange
