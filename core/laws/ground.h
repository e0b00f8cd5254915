// Ground and its contact with a point or sphere: values and pure functions. (docs/equations.md, 6)
#pragma once
#include <array>
#include <string>
#include <type_traits>
#include <variant>

#include "core/laws/boxes.h"
#include "core/laws/ground_touch.h"
#include "core/laws/heightfield.h"
#include "core/laws/plane_ground.h"

namespace gaitlab {

/// Ground of one of the types in `Shape`, with its friction. Each type is a class with a constant `kType` and the queries
/// touch, surface_below and highest.
struct Ground {
  using Shape = std::variant<NoGround, Plane, Boxes, Heightfield>;
  using Touch = GroundTouch;

  Shape shape = Plane{};
  double friction = 0.8;  ///< Coulomb coefficient f; boxes have separate coefficients

  /// Touch of a sphere of `radius` (0 for a point) centred at `centre`, world. Allocates nothing. NoGround returns the touch of
  /// the plane.
  [[nodiscard]] Touch query(const Vec3& centre, double radius) const;
  /// Height of the surface that carries a point, m: the highest surface on the vertical through the point that is at most
  /// `give` above it. A wall beside the point and a roof above it do not count. NoGround returns the height of the plane.
  [[nodiscard]] double surface_below(const Vec3& point, double give) const;
  /// Upper bound of the height of all solids, m.
  [[nodiscard]] double highest() const;

  [[nodiscard]] const GroundType& type() const;
  [[nodiscard]] bool exists() const { return !std::holds_alternative<NoGround>(shape); }
  /// True if the ground is the plane z = 0 without boxes.
  [[nodiscard]] bool is_plane() const { return std::holds_alternative<Plane>(shape); }
  /// True if the ground is the plane z = 0, with or without boxes.
  [[nodiscard]] bool has_plane() const { return exists() && type().plane_and_boxes; }
  /// Boxes on the plane; empty if there are none.
  [[nodiscard]] const Boxes& boxes() const;
  /// This ground without the boxes that have a mass.
  [[nodiscard]] Ground without_moving_boxes() const;
  /// Heights of the surface in pictures; nullptr if plane and boxes are enough.
  [[nodiscard]] const Heightfield* relief() const;
  /// has_border: true if the given heights end at a border, beyond which the surface is only extrapolated. beyond_border: true
  /// if (x, y), m, is beyond this border.
  [[nodiscard]] bool has_border() const { return std::holds_alternative<Heightfield>(shape); }
  [[nodiscard]] bool beyond_border(double x, double y) const;
};

namespace detail {

template <class... T>
constexpr std::array<GroundType, sizeof...(T)> types_of(std::type_identity<std::variant<T...>>) {
  return {T::kType...};
}

}  // namespace detail

/// All types of ground, in the order of Ground::Shape.
inline constexpr auto kGroundTypes = detail::types_of(std::type_identity<Ground::Shape>{});

/// Text for messages, "none, plane or boxes": the types of ground that consist of the plane and boxes only.
std::string plane_and_box_types();

}  // namespace gaitlab
