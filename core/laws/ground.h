// The ground and what a point or sphere finds there: values and pure functions. (docs/equations.md, 6)
#pragma once
#include <vector>

#include "core/laws/heightfield.h"
#include "core/model/frames.h"
#include "core/names.h"

namespace gaitlab {

/// A solid block that stands in the world.
struct Box {
  Vec3 center = Vec3::Zero();  ///< m
  Vec3 size = Vec3::Zero();    ///< edges along its own axes, m
  Vec3 rpy = Vec3::Zero();     ///< its axes in the world: roll pitch yaw, rad
  double friction = 0.8;       ///< Coulomb coefficient f
  double mass = 0;             ///< kg; 0: it never moves
  Mat3 R = Mat3::Identity();   ///< of rpy; a query asks this one
};

/// World z = 0, solid below; with boxes on it; or a heightfield instead of it.
///
/// A query finds one touch per element. In a box the nearest point of the surface counts: outside the foot of the
/// perpendicular, inside the face of least depth. Three rules make of many solids one ground:
/// - A point inside a box is pushed out through the nearest exposed face: not covered by another box, not facing the ground
/// plane.
///   So an element that slides over the seam of two boxes of one height feels nothing there. (At a step in height let the boxes
///   overlap a little.)
/// - An element that touches several solids (floor and wall) gets one touch of penetration |sum s n|, normal along the sum: the
///   spring force of a linear law is the sum of theirs. s: the penetrations, less what the others push along the same normal
///   already, so that two floors carry like one. It changes continuously as one solid after the other comes in reach.
/// - Its friction is the mean of theirs by s.
struct Ground {
  enum class Kind { none, plane, boxes, heightfield } kind = Kind::plane;
  double friction = 0.8;  ///< Coulomb coefficient f; of the plane and of the field
  std::vector<Box> boxes = {};
  Heightfield field = {};

  struct Touch {
    double penetration;  ///< m; negative: the gap
    Vec3 normal;
    Vec3 point;  ///< where the force acts: the deepest point of the element
    double friction;
  };

  /// A sphere of `radius` (0: a point) centred at `centre`, world. Allocates nothing. Of Kind::none: as on the plane.
  [[nodiscard]] Touch query(const Vec3& centre, double radius) const;

  /// Height of what carries a point: the highest surface on the vertical through it that is at most `give` above it, m. A wall
  /// that it touches and a roof above it carry nothing. Of Kind::none: as on the plane.
  [[nodiscard]] double surface_below(const Vec3& point, double give) const;

  /// No solid is higher, m.
  [[nodiscard]] double highest() const;

 private:
  [[nodiscard]] Touch on_boxes(const Vec3& centre, double radius) const;
  [[nodiscard]] Touch on_field(const Vec3& centre, double radius) const;
};

template <>
struct EnumNames<Ground::Kind> {
  using enum Ground::Kind;
  static constexpr EnumName<Ground::Kind> kTable[] = {
      {none, "none"}, {plane, "plane"}, {boxes, "boxes"}, {heightfield, "heightfield"}};
};

}  // namespace gaitlab
