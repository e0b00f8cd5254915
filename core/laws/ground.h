// The ground and its contact with a point or sphere: values and pure functions. (docs/equations.md, 6)
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

/// One of the types of ground, with the friction that they share. A type is a value with a `kType` and the first three queries;
/// `Shape` lists all of them.
struct Ground {
  using Shape = std::variant<NoGround, Plane, Boxes, Heightfield>;
  using Touch = GroundTouch;

  Shape shape = Plane{};
  double friction = 0.8;  ///< Coulomb coefficient f; boxes have their own beside it

  /// A sphere of `radius` (0: a point) centred at `centre`, world. Allocates nothing. Without a ground: as on the plane.
  [[nodiscard]] Touch query(const Vec3& centre, double radius) const;
  /// Height of what carries a point: the highest surface on the vertical through it that is at most `give` above it, m. A wall
  /// that it touches and a roof above it carry nothing. Without a ground: as on the plane.
  [[nodiscard]] double surface_below(const Vec3& point, double give) const;
  /// No solid is higher, m.
  [[nodiscard]] double highest() const;

  [[nodiscard]] const GroundType& type() const;
  [[nodiscard]] bool exists() const { return !std::holds_alternative<NoGround>(shape); }
  /// The plane z = 0 and nothing else.
  [[nodiscard]] bool is_plane() const { return std::holds_alternative<Plane>(shape); }
  /// The plane z = 0, with or without boxes.
  [[nodiscard]] bool has_plane() const { return exists() && type().plane_and_boxes; }
  /// The boxes that stand on the plane; empty: there are none.
  [[nodiscard]] const Boxes& boxes() const;
  /// The same without the boxes that have a mass.
  [[nodiscard]] Ground without_moving_boxes() const;
  /// Heights that show the surface in pictures; nullptr: plane and boxes show all of it.
  [[nodiscard]] const Heightfield* relief() const;
  /// Whether the surface is given up to a border, beyond which it only continues; and whether (x, y), m, is beyond it.
  [[nodiscard]] bool has_border() const { return std::holds_alternative<Heightfield>(shape); }
  [[nodiscard]] bool beyond_border(double x, double y) const;
};

namespace detail {

template <class... T>
constexpr std::array<GroundType, sizeof...(T)> types_of(std::type_identity<std::variant<T...>>) {
  return {T::kType...};
}

}  // namespace detail

/// All types, in the order of Ground::Shape.
inline constexpr auto kGroundTypes = detail::types_of(std::type_identity<Ground::Shape>{});

/// For messages: "none, plane or boxes", the types of which nothing is left out by plane and boxes.
std::string plane_and_box_types();

}  // namespace gaitlab
