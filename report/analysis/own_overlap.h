// Overlap of two bodies of one module. Their overlap with all hinges at angle 0 is by design, for example that of an axle in
// its bearing, and so is a larger one up to the square root of 2: a square part that turns by 45 degrees reaches so much
// farther. Only the depth beyond that counts.
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

inline constexpr double kTurned = std::numbers::sqrt2;  ///< overlap by design over that with all hinges at 0

/// The bodies of a module type with all hinges at 0.
class DesignOverlap {
 public:
  explicit DesignOverlap(const ModuleType& type);
  /// Depth of the deepest overlap of a shape of body a and one of body b, m; 0 if they are apart. Computed once for each pair.
  double depth(std::size_t a, std::size_t b);
  /// Pairs that overlap by design, except for those on one hinge, with the deepest first.
  std::vector<std::pair<std::size_t, std::size_t>> pairs();

 private:
  struct Placed {
    std::vector<Convex> shapes;  ///< in the frame of the root
    Vec3 centre = Vec3::Zero();  ///< m, of a ball around them
    double reach = 0;            ///< m, its radius
  };
  const ModuleType& type_;
  std::vector<Placed> bodies_;
  std::map<std::pair<std::size_t, std::size_t>, double> known_ = {};
};

/// The two bodies of a hinge, whose overlap follows from the angle. Angles found clear are kept, with all angles so near to
/// them that no point of the child can move into the parent: a gait needs a few hundred evaluations for all modules of a type.
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
  std::map<double, double> clear_ = {};  ///< ends of intervals of clear angles by their begins, rad
};

/// Deepest overlap of the bodies of a hinge within its range (of a free hinge: in a turn) beyond that by design, m, at angles
/// at most 0.05 rad apart.
double deepest_in_range(const ModuleType& type, std::size_t hinge);

/// Names of the bodies of a type, for ModuleType::may_overlap.
std::vector<std::string> body_names(const ModuleType& type);

}  // namespace gaitlab::report
