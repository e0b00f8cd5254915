// Surface z(x, y) through heights on a square grid.
#pragma once
#include <cstddef>
#include <initializer_list>
#include <memory>
#include <string>
#include <vector>

#include "core/laws/ground_touch.h"
#include "core/model/frames.h"

namespace gaitlab {

/// A list of heights that reads like a vector. Copies share their immutable content, because a large field has 134 MB.
class Heights {
 public:
  Heights() = default;
  Heights(std::vector<double> heights);            // NOLINT(google-explicit-constructor): a field is made of a list
  Heights(std::initializer_list<double> heights);  // NOLINT(google-explicit-constructor)

  [[nodiscard]] const std::vector<double>& list() const;
  [[nodiscard]] std::size_t size() const { return list().size(); }
  [[nodiscard]] bool empty() const { return list().empty(); }
  double operator[](std::size_t index) const { return held_->list[index]; }
  [[nodiscard]] auto begin() const { return list().begin(); }
  [[nodiscard]] auto end() const { return list().end(); }
  /// Lowest height; the list must not be empty.
  [[nodiscard]] double lowest() const { return held_->lowest; }
  [[nodiscard]] double highest() const { return held_->highest; }

 private:
  struct Held {
    std::vector<double> list;
    double lowest, highest;
  };
  std::shared_ptr<const Held> held_;  ///< nullptr if the list is empty
};

/// Surface through the given heights, with a continuous normal. It is cubic in each cell (Catmull and Rom 1974, in x and in y).
/// Triangles or bilinear cells would make the normal jump at every edge, and a foot that slides over an edge would get an
/// impact. A plane is reproduced exactly up to the border. The surface beside a step overshoots by up to 7 % of the step.
/// Beyond the border, the heights at the border continue outwards.
struct Heightfield {
  static constexpr GroundType kType{.name = "heightfield", .about = "a surface through heights", .has_settings = true};

  Vec3 origin = Vec3::Zero();  ///< position of values[0], m, world
  double spacing = 0.1;        ///< distance of heights in x and in y, m
  std::size_t columns = 0;     ///< number of columns, along x; columns and rows (along y) are at least 2
  Heights values = {};         ///< heights above the origin, m, row by row
  /// File with the heights, if they are too many to be written out in a scenario. `file` is empty if they are written out.
  struct Source {
    std::string file, hash;  ///< canonical path; hash of the bytes of the file
    double scale = 1;        ///< m per unit of the numbers in the file
  } source = {};

  struct SurfacePoint {
    double z;     ///< m, world
    Vec3 normal;  ///< upwards
  };
  [[nodiscard]] SurfacePoint at(double x, double y) const;
  [[nodiscard]] std::size_t rows() const { return columns == 0 ? 0 : values.size() / columns; }
  /// True if (x, y), m, world, is within the border.
  [[nodiscard]] bool covers(double x, double y) const;

  [[nodiscard]] GroundTouch touch(const Vec3& centre, double radius, double friction) const;  ///< see Ground::query
  [[nodiscard]] double surface_below(const Vec3& point, double) const { return at(point.x(), point.y()).z; }
  [[nodiscard]] double highest() const;
};

}  // namespace gaitlab
