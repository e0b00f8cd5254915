// Overlap of two bodies of one module. Their overlap with all hinges at angle 0 is by design, for example that of an axle in
// its bearing. An overlap up to the square root of 2 times as deep is also by design, because a square part that turns by 45
// degrees reaches that much farther. Only a larger depth counts.
#pragma once
#include <cstddef>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "core/model/module_type.h"
#include "report/analysis/convex.h"

namespace gaitlab::report {

inline constexpr double kTurned = std::numbers::sqrt2;  ///< overlap by design / overlap with all hinges at 0

/// The shapes of a body in the frame of the root.
struct Placed {
  explicit Placed(std::vector<Convex> of);
  [[nodiscard]] bool clear_of(const Placed& other) const;  ///< true if the balls are apart
  std::vector<Convex> shapes;
  Vec3 centre = Vec3::Zero();  ///< m, centre of a ball around the shapes
  double reach = 0;            ///< m, radius of the ball
};

/// Depth of the deepest overlap of two bodies, m; 0 if they are apart.
double depth_of(const Placed& one, const Placed& other);

/// The bodies of a module type with all hinges at 0.
class DesignOverlap {
 public:
  explicit DesignOverlap(const ModuleType& type);
  /// Depth of the deepest overlap of a shape of body a and one of body b, m; 0 if they are apart. Computed once for each pair.
  double depth(std::size_t a, std::size_t b);
  /// Pairs that overlap by design, except for those on one hinge, with the deepest first.
  std::vector<std::pair<std::size_t, std::size_t>> pairs();

 private:
  const ModuleType& type_;
  std::vector<Placed> bodies_;
  std::map<std::pair<std::size_t, std::size_t>, double> known_ = {};
};

/// The two bodies of a hinge, whose overlap follows from the angle. A clear angle is stored with the interval around it in
/// which no point of the child can reach the parent. A gait therefore needs only a few hundred evaluations for all modules of a
/// type.
class HingeOverlap {
 public:
  /// Overlaps of at most `ignored` more than `by_design` (m) do not count.
  HingeOverlap(const ModuleType& type, std::size_t hinge, double by_design, double ignored);
  /// Overlap at an angle of the hinge (rad) beyond that by design, m; 0 if it does not count.
  double beyond(double angle);

 private:
  const HingeType& hinge_;
  double by_design_, ignored_;           ///< m
  std::vector<Convex> parent_, child_;   ///< shapes in the frame of the hinge at angle 0
  double reach_ = 0;                     ///< m, largest distance of a point of the child from the axis
  std::map<double, double> clear_ = {};  ///< end of each interval of clear angles by its start, rad
};

/// Largest overlap of the bodies of a hinge beyond that by design, m, at angles at most 0.05 rad apart within the range of the
/// hinge, or within a turn of a free hinge.
double deepest_in_range(const ModuleType& type, std::size_t hinge);

/// Pairs of bodies that overlap by more than 0.5 mm at each of 64 drawn sets of angles within the ranges of the hinges: shapes
/// that the file does not draw as they are.
std::vector<std::pair<std::size_t, std::size_t>> always_overlapping(const ModuleType& type);

/// Names of the bodies of a type, for ModuleType::may_overlap.
std::vector<std::string> body_names(const ModuleType& type);

}  // namespace gaitlab::report
