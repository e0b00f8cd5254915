// Degrees of freedom of the base frame.
#pragma once
#include "core/names.h"

namespace gaitlab {

enum class Base { floating, fixed, planar };  ///< planar: world x, world z and rotation about world y

template <>
struct EnumNames<Base> {
  using enum Base;
  static constexpr EnumName<Base> kTable[] = {{floating, "floating"}, {fixed, "fixed"}, {planar, "planar"}};
};

}  // namespace gaitlab
