// Pairs of bodies of a robot that may collide, and the overlap that each has by design.
#pragma once
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "core/scenario/scenario.h"
#include "report/analysis/own_overlap.h"

namespace gaitlab::report {

class Meetings {
 public:
  /// Two bodies on one hinge; the pair is compared by the angle of its joint.
  struct OnHinge {
    std::size_t parent = 0, child = 0;  ///< indices in Robot::bodies
    std::size_t joint = 0;
    double sign = 1;  ///< -1 if the joint moves the parent
    std::size_t type = 0, hinge = 0;
  };

  /// The robot must outlive this object.
  explicit Meetings(const Scenario& scenario);

  /// True if two bodies (indices in Robot::bodies) are compared by their poses: they belong to different links, no hinge joins
  /// them, and no `may_overlap` names them.
  [[nodiscard]] bool operator()(std::size_t a, std::size_t b) const;
  /// Overlap by design of two such bodies, m; 0 for bodies of different modules.
  double by_design(std::size_t a, std::size_t b);

  /// Pairs on one hinge that have shapes and that no `may_overlap` names.
  [[nodiscard]] const std::vector<OnHinge>& hinges() const { return hinges_; }
  /// Overlap of such a pair beyond that by design, m, at the angle of its joint (rad); 0 up to Limits::meeting().
  double beyond(const OnHinge& pair, double angle);

 private:
  [[nodiscard]] bool left_out(std::size_t a, std::size_t b) const;
  void add_hinges(const Module& module);
  DesignOverlap& design(std::size_t type);

  const Robot& robot_;
  double ignored_;                       ///< m
  BodyPairs of_scenario_;                ///< by index in Robot::bodies
  std::vector<BodyPairs> of_type_ = {};  ///< by type and body
  std::vector<std::size_t> parents_;     ///< parent of each body by its hinge; the number of bodies if none
  std::vector<OnHinge> hinges_ = {};
  std::vector<std::optional<DesignOverlap>> designs_;                    ///< by type
  std::vector<std::vector<std::optional<HingeOverlap>>> overlaps_ = {};  ///< by type and hinge
};

}  // namespace gaitlab::report
