// Export of a moving robot as glTF, for viewers and Blender.
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

/// Appearance of a glTF file. Colours are `#RRGGBB` in sRGB.
struct GltfLook {
  std::string generator;                     ///< program and version, stored in the file
  std::string_view (*body)(Role) = nullptr;  ///< colour of the bodies of a role
  std::string_view ground, tile, box, moving_box;
};

struct Gltf {
  std::string bytes;       ///< content of the .glb file
  std::size_t frames = 0;  ///< number of keyframes
};

/// Binary glTF 2.0 file of the robot and its ground. If `recording` is given, it contains one animation of the run, whose
/// keyframes are trace rows at least 1/60 s apart, and the last row. Without a recording, or if the recording has only one row,
/// the robot is in its initial pose.
///
/// The node `world` turns z up into glTF's y up. Its children are the ground, the ground's boxes, and the nested links: `base`,
/// `joint m3/passive`, etc. Each link contains the bodies that move with it, one mesh per body type. A joint therefore rotates
/// about its axis between two keyframes too, whereas separately animated bodies would leave their hinges. A joint also needs
/// only 16 instead of 28 bytes per keyframe. Nodes that do not move have no animation channel.
///
/// Numbers of the animation are float32. A unit quaternion rounded from double has an error of up to 2^-23 rad (1.2e-7), which
/// moves a point at distance d by 1.2e-7 d. These errors add up along a chain of joints. Times and coordinates of the base and
/// of moving boxes have a relative error of up to 2^-24 (6e-8). Consecutive quaternions have continuous signs.
///
/// Requires recording->has_states(robot). Movable boxes are in their initial pose if the recording does not contain their
/// motion. Throws InputError for numbers that are not finite, and for a file above 4 GiB.
Gltf to_gltf(const Scenario& scenario, const Recording* recording, const GltfLook& look);

/// Names of bodies without a shape.
std::vector<std::string> bodies_without_shape(const Robot& robot);

/// Indices in `ground.boxes` of movable boxes whose motion the recording does not contain.
std::vector<std::size_t> boxes_without_way(const Scenario& scenario, const Recording& recording);

}  // namespace gaitlab::interchange
