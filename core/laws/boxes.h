// Solid blocks of a ground, with grids of cells for finding near blocks.
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
  Vec3 size = Vec3::Zero();    ///< lengths of the edges along the axes of the box, m
  Vec3 rpy = Vec3::Zero();     ///< orientation of the box in the world: roll pitch yaw, rad
  double friction = 0.8;       ///< Coulomb coefficient f
  double mass = 0;             ///< kg; 0 if the box is fixed
  Mat3 R = Mat3::Identity();   ///< rotation of rpy, for queries
};

/// A list of boxes that reads like a vector, with an index for queries. Copies share their immutable content.
///
/// Grids of cells of several sizes cover the boxes, seen from above. Each size is twice the previous one. The first grids cover
/// the area of all boxes except large ones, and the last grids cover the area of all boxes. A cell lists, in rising order, the
/// boxes that come within `margin` (half of the edge) of the cell. A search within some distance therefore reads only one cell,
/// from the grid for that distance. Memory grows with the number of boxes, because cells are enlarged until their number and
/// their lists are small.
class Boxes {
 public:
  static constexpr GroundType kType{
      .name = "boxes", .about = "a plane with boxes on it", .has_settings = true, .plane_and_boxes = true};

  Boxes() = default;
  Boxes(std::vector<Box> boxes);            // NOLINT(google-explicit-constructor): a ground is made of lists
  Boxes(std::initializer_list<Box> boxes);  // NOLINT(google-explicit-constructor)

  [[nodiscard]] std::size_t size() const { return list().size(); }
  [[nodiscard]] bool empty() const { return list().empty(); }
  const Box& operator[](std::size_t index) const { return held_->list[index]; }
  [[nodiscard]] auto begin() const { return list().begin(); }
  [[nodiscard]] auto end() const { return list().end(); }
  [[nodiscard]] const std::vector<Box>& list() const;
  /// Changes the list. `change` receives the vector.
  template <class Change>
  void change(const Change& change) {
    std::vector<Box> boxes = list();
    change(boxes);
    *this = Boxes(std::move(boxes));
  }

  /// Touch as in Ground::query. `friction` is the coefficient of the plane below the boxes.
  [[nodiscard]] GroundTouch touch(const Vec3& centre, double radius, double friction) const;
  [[nodiscard]] double surface_below(const Vec3& point, double give) const;
  [[nodiscard]] double highest() const;

  /// Numbers of all boxes that come within `distance` (m, at least 0) of a position, and of some others, in rising order.
  [[nodiscard]] std::span<const std::uint32_t> near(const Vec3& place, double distance) const;
  /// Largest distance for the smallest cells of `near`, m.
  [[nodiscard]] double margin() const;
  struct Ball {
    Vec3 center;    ///< m
    double radius;  ///< m
  };
  /// Smallest sphere around all corners of a box.
  [[nodiscard]] const Ball& ball(std::size_t index) const { return held_->balls[index]; }

 private:
  struct Cells {
    double edge, margin;  ///< m
    double x, y;          ///< corner of the first cell, world
    std::size_t columns = 0, rows = 0;
    bool whole = false;                     ///< true if no box is beyond the cells
    std::vector<std::uint32_t> first = {};  ///< start of the list of each cell in `listed`, and the end
    std::vector<std::uint32_t> listed = {};
  };
  struct Held {
    std::vector<Box> list;
    std::vector<Ball> balls;
    std::vector<std::uint32_t> all;
    std::vector<Cells> cells;  ///< empty if there are few boxes
  };
  static std::vector<Cells> all_cells(const Held& held);
  /// Cells of one size for boxes whose balls have a radius of at most `largest`. Nothing if there would be too many cells or
  /// list entries.
  static std::optional<Cells> cells_of(const Held& held, double largest, double edge);

  std::shared_ptr<const Held> held_;  ///< nullptr without boxes
};

}  // namespace gaitlab
