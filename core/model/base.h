// How the base frame may move.
#pragma once

namespace gaitlab {

enum class Base { floating, fixed, planar };  ///< planar: world x, world z and rotation about world y

}  // namespace gaitlab
