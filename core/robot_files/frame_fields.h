// Fields of lengths, directions and frames in module files.
#pragma once
#include <limits>

#include "core/model/frames.h"
#include "core/plugin/fields.h"

namespace gaitlab {

inline constexpr double kAnyNumber = std::numeric_limits<double>::infinity();

inline void length(Fields& f, const char* key, Vec3& value, const char* about) {
  f.vector(key, span_of(value), {"m", -kAnyNumber, kAnyNumber, about});
}

inline void direction(Fields& f, const char* key, Vec3& value, const char* about) {
  f.vector(key, span_of(value), {"", -kAnyNumber, kAnyNumber, about});
}

/// Keys `origin` and `rpy` of a frame.
struct FrameFields {
  Vec3 origin = Vec3::Zero(), turn = Vec3::Zero();

  void fields(Fields& f) {
    length(f, "origin", origin, "Origin in the body's frame.");
    f.vector("rpy", span_of(turn), {"rad", -kAnyNumber, kAnyNumber, "Roll, pitch, yaw."});
  }
  [[nodiscard]] Pose pose() const { return {rpy(turn), origin}; }
};

}  // namespace gaitlab
