// Coupling graph of a network of oscillators, from an explicit list or from a rule. Standard library only.
#pragma once
#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "core/plugin/fields.h"
#include "core/plugin/robot_info.h"

namespace gaitlab {

/// A coupling between two oscillators. On the limit cycle phi_to = phi_from + phase_lag.
struct Coupling {
  std::int64_t from = 0, to = 0;
  double weight = 1, phase_lag = 0;

  void fields(Fields& f) {
    f.joint("from", from, "The joint that is followed.");
    f.joint("to", to, "The joint that follows.");
    f.number("weight", weight, {"1/s", -1000, 1000, "Weight w of the coupling."});
    f.number("phase_lag", phase_lag, {"rad", -100, 100, "Lead of `to` over `from` on the limit cycle."});
  }
};

/// Rule that selects which joint each joint follows. Joints without a motor neither follow nor are followed.
/// - chain: every joint follows the joint with the preceding number.
/// - parent: every joint follows the next joint towards the base.
/// - siblings: as parent, and joints with the same parent also follow one another.
/// - mirror: joints on the right follow their mirror image on the left; all other joints as parent.
/// - all: every joint follows every other joint, with the lags of chain.
enum class CouplingRule { chain, parent, siblings, mirror, all };

inline constexpr const char* kCouplingRules[] = {"chain", "parent", "siblings", "mirror", "all"};
inline constexpr const char* kCouplingRulesAbout =
    "Rule for the joint that each joint follows. chain: the previous one; parent: the next towards the base; siblings: as "
    "parent, and also joints with the same parent; mirror: a right joint follows its left counterpart; all: every other joint; "
    "or a list.";

/// Number of the joint that is the mirror image of `joint` (which has y < 0) in the plane y = 0 at zero angles, or -1. The axes
/// of the joint and its image are parallel after reflection, but their positive directions of rotation may be opposite.
inline std::int64_t mirror_image(const RobotInfo& robot, std::size_t joint) {
  constexpr double kSamePlace = 1e-3;     // m; far above rounding errors, far below the size of a module
  constexpr double kSameDirection = 0.9;  // cosine of the largest angle between parallel axes
  const JointInfo& own = robot.joints[joint];
  if (own.origin[1] > -kSamePlace || !own.driven) return -1;
  for (std::size_t j = 0; j < robot.joints.size(); ++j) {
    const JointInfo& other = robot.joints[j];
    const double off = std::max({std::abs(other.origin[0] - own.origin[0]), std::abs(other.origin[1] + own.origin[1]),
                                 std::abs(other.origin[2] - own.origin[2])});
    const double along = other.axis[0] * own.axis[0] - other.axis[1] * own.axis[1] + other.axis[2] * own.axis[2];
    if (other.driven && off < kSamePlace && std::abs(along) > kSameDirection) return static_cast<std::int64_t>(j);
  }
  return -1;
}

/// Phases on the limit cycle, as sums of lags along the couplings. The joint with the lowest number in each connected part has
/// phase 0. Empty if couplings contradict one another around a cycle, so that no phases satisfy all lags.
inline std::vector<double> phases_of(const std::vector<Coupling>& graph, std::size_t joints) {
  std::vector<double> phase(joints, 0.0);
  std::vector<bool> known(joints, false);
  for (std::size_t root = 0; root < joints; ++root) {
    if (known[root]) continue;
    known[root] = true;
    for (bool grown = true; grown;) {
      grown = false;
      for (const Coupling& c : graph) {
        const auto from = static_cast<std::size_t>(c.from);
        const auto to = static_cast<std::size_t>(c.to);
        if (known[from] == known[to]) continue;
        if (known[from]) {
          phase[to] = phase[from] + c.phase_lag;
        } else {
          phase[from] = phase[to] - c.phase_lag;
        }
        known[from] = known[to] = grown = true;
      }
    }
  }
  for (const Coupling& c : graph) {
    const double miss = phase[static_cast<std::size_t>(c.to)] - phase[static_cast<std::size_t>(c.from)] - c.phase_lag;
    if (std::abs(std::remainder(miss, 2 * std::numbers::pi)) > 1e-9) return {};
  }
  return phase;
}

namespace detail {

/// Number of the next joint towards the base that has a motor, or -1 if there is none.
inline std::int64_t driven_parent(const RobotInfo& robot, std::size_t joint) {
  std::int64_t at = robot.joints[joint].parent;
  while (at >= 0 && !robot.joints[static_cast<std::size_t>(at)].driven) at = robot.joints[static_cast<std::size_t>(at)].parent;
  return at;
}

/// Couples the joints with the same parent. Each joint leads another by the difference of their lags, which is consistent with
/// the rule `parent`.
inline void couple_siblings(const RobotInfo& robot, double weight, const PerJoint& lag, std::vector<Coupling>& graph) {
  for (std::size_t i = 0; i < robot.joints.size(); ++i) {
    for (std::size_t j = 0; j < robot.joints.size(); ++j) {
      if (i == j || !robot.joints[i].driven || !robot.joints[j].driven) continue;
      if (driven_parent(robot, i) != driven_parent(robot, j)) continue;
      graph.push_back({static_cast<std::int64_t>(j), static_cast<std::int64_t>(i), weight, lag[i] - lag[j]});
    }
  }
}

/// Couples every joint to every other. Each of n joints has couplings of weight w / (n - 1), so that the total weight on a
/// joint does not depend on n.
inline std::vector<Coupling> couple_all(const std::vector<std::int64_t>& joints, double weight, const PerJoint& lag) {
  std::vector<double> phase(joints.size(), 0.0);
  for (std::size_t i = 1; i < joints.size(); ++i) phase[i] = phase[i - 1] + lag[static_cast<std::size_t>(joints[i])];
  std::vector<Coupling> graph;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    for (std::size_t j = 0; j < joints.size(); ++j) {
      if (i == j) continue;
      graph.push_back({joints[j], joints[i], weight / static_cast<double>(joints.size() - 1), phase[i] - phase[j]});
    }
  }
  return graph;
}

}  // namespace detail

/// Couplings of a rule. `lag[i]` is the phase by which joint i leads the joint that it follows.
inline std::vector<Coupling> couple(const RobotInfo& robot, CouplingRule rule, double weight, const PerJoint& lag) {
  std::vector<std::int64_t> driven;
  for (std::size_t i = 0; i < robot.joints.size(); ++i) {
    if (robot.joints[i].driven) driven.push_back(static_cast<std::int64_t>(i));
  }
  if (rule == CouplingRule::all) return detail::couple_all(driven, weight, lag);
  std::vector<Coupling> graph;
  std::int64_t before = -1;
  for (const std::int64_t to : driven) {
    const auto i = static_cast<std::size_t>(to);
    std::int64_t from = rule == CouplingRule::chain ? before : detail::driven_parent(robot, i);
    before = to;
    if (const std::int64_t image = rule == CouplingRule::mirror ? mirror_image(robot, i) : -1; image >= 0) {
      graph.push_back({to, image, weight, -lag[i]});  // joint and image follow one another
      from = image;
    }
    if (from >= 0) graph.push_back({from, to, weight, lag[i]});
  }
  if (rule == CouplingRule::siblings) detail::couple_siblings(robot, weight, lag, graph);
  return graph;
}

}  // namespace gaitlab
