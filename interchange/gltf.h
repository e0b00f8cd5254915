// A moving robot as glTF, for viewers and Blender.
#pragma once
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/model/role.h"
#include "core/recording/recording.h"
#include "core/scenario/scenario.h"

namespace gaitlab::interchange {

inline constexpr double kGltfRate = 60;  ///< Hz, largest rate of keyframes

/// Appearance in a glTF file. Colours: `#RRGGBB`, sRGB.
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
/// at least 1/60 s apart and at the last row. Without a recording, or with only one row, the robot has its initial pose.
///
/// Nodes: `world` turns z up into glTF's y up. Its children are the ground, the ground's boxes, and the links, nested: `base`,
/// `joint m3/passive` ...; each link contains the bodies that move with it, one mesh per body type. A joint therefore rotates
/// about its axis also between two keyframes, when separately animated bodies would leave their hinges, and takes 16 bytes per
/// keyframe instead of 28. Nodes that do not move have no channel.
///
/// Numbers of the animation are float32. A quaternion of length 1 in double then has an error of up to 2^-23 rad (1.2e-7),
/// which moves a point at distance d by 1.2e-7 d; these errors add up along a chain of joints. Coordinates of the base and of
/// moving boxes have a relative error of up to 2^-24 (6e-8), as have times. Signs of quaternions are continuous.
///
/// Requires recording->has_states(robot). Movable boxes have their initial pose if the recording does not contain their motion.
/// Throws InputError for numbers that are not finite, and for more than 4 GiB.
Gltf to_gltf(const Scenario& scenario, const Recording* recording, const GltfLook& look);

/// Names of bodies without a shape.
std::vector<std::string> bodies_without_shape(const Robot& robot);

/// Movable boxes whose motion the recording does not contain, by number in `ground.boxes`.
std::vector<std::size_t> boxes_without_way(const Scenario& scenario, const Recording& recording);

}  // namespace gaitlab::interchange
