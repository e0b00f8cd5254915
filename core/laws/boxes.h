// The solid blocks of a ground, and a grid of cells for finding the near ones.
#pragma once
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/laws/ground_touch.h"
#include "core/model/frames.h"

namespace gaitlab {

/// A solid block fixed in the world, or movable if it has a mass.
struct Box {
  Vec3 center = Vec3::Zero();  ///< m
  Vec3 size = Vec3::Zero();    ///< edges along its own axes, m
  Vec3 rpy = Vec3::Zero();     ///< its axes in the world: roll pitch yaw, rad
  double friction = 0.8;       ///< Coulomb coefficient f
  double mass = 0;             ///< kg; 0: fixed
  Mat3 R = Mat3::Identity();   ///< rotation of rpy, for queries
};

/// A list of boxes with an index for queries. Reads like a vector. Copies share their immutable content.
///
/// Seen from above, grids of cells of several sizes cover the boxes, each size twice the one before; the first grids cover the
/// area of all except the large boxes, the last ones that of all. A cell lists the boxes that come within `margin` of it, half
/// its edge, in their order, so that a search within some distance reads one cell of the size for that distance. Memory grows
/// with the number of boxes: cells are enlarged until their number and their lists are small.
class Boxes {
 public:
  static constexpr GroundType kType{
      .name = "boxes", .about = "the same with boxes on it", .has_settings = true, .plane_and_boxes = true};

  Boxes() = default;
  Boxes(std::vector<Box> boxes);            // NOLINT(google-explicit-constructor): a ground is made of lists
  Boxes(std::initializer_list<Box> boxes);  // NOLINT(google-explicit-constructor)

  [[nodiscard]] std::size_t size() const { return list().size(); }
  [[nodiscard]] bool empty() const { return list().empty(); }
  const Box& operator[](std::size_t index) const { return held_->list[index]; }
  [[nodiscard]] auto begin() const { return list().begin(); }
  [[nodiscard]] auto end() const { return list().end(); }
  [[nodiscard]] const std::vector<Box>& list() const;
  /// Changes the list: `change` receives the vector.
  template <class Change>
  void change(const Change& change) {
    std::vector<Box> boxes = list();
    change(boxes);
    *this = Boxes(std::move(boxes));
  }

  /// friction: of the plane below the boxes. (Ground::query)
  [[nodiscard]] GroundTouch touch(const Vec3& centre, double radius, double friction) const;
  [[nodiscard]] double surface_below(const Vec3& point, double give) const;
  [[nodiscard]] double highest() const;

  /// Rising numbers of boxes: all that come within `distance` (m, at least 0) of a place, and some others.
  [[nodiscard]] std::span<const std::uint32_t> near(const Vec3& place, double distance) const;
  /// Largest distance for which `near` uses the smallest cells, m.
  [[nodiscard]] double margin() const;
  struct Ball {
    Vec3 center;    ///< m
    double radius;  ///< m
  };
  /// Ball around the corners of a box.
  [[nodiscard]] const Ball& ball(std::size_t index) const { return held_->balls[index]; }

 private:
  struct Cells {
    double edge, margin;  ///< m
    double x, y;          ///< corner of the first cell, world
    std::size_t columns = 0, rows = 0;
    bool whole = false;                     ///< all boxes are near the cells: none beyond them
    std::vector<std::uint32_t> first = {};  ///< start of each cell's list in `listed`, and the end
    std::vector<std::uint32_t> listed = {};
  };
  struct Held {
    std::vector<Box> list;
    std::vector<Ball> balls;
    std::vector<std::uint32_t> all;
    std::vector<Cells> cells;  ///< none if there are few boxes
  };
  static std::vector<Cells> all_cells(const Held& held);
  /// Cells of one size, over boxes whose balls have a radius of at most `largest`; nothing if the cells or their lists would be
  /// too many.
  static std::optional<Cells> cells_of(const Held& held, double largest, double edge);

  std::shared_ptr<const Held> held_;  ///< nullptr: no boxes
};

}  // namespace gaitlab
