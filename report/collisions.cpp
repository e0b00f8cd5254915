#include "report/collisions.h"

#include <algorithm>
#include <set>
#include <tuple>
#include <utility>

#include "core/model/kinematics.h"
#include "report/convex.h"

namespace gaitlab::report {

namespace {

/// One shape of a body, in its link's frame, and a ball around it.
struct Piece {
  std::size_t body = 0, link = 0;
  Convex local;
  Vec3 centre = Vec3::Zero();  ///< m, link frame
  double reach = 0;            ///< m
};

std::vector<Piece> pieces_of(const Robot& robot) {
  std::vector<Piece> pieces;
  for (std::size_t b = 0; b < robot.bodies.size(); ++b) {
    const Body& body = robot.bodies[b];
    for (const Shape& shape : robot.types[robot.modules[body.module].type].bodies[body.type].shapes) {
      Piece piece{b, body.link, moved(convex(shape), body.in_link)};
      for (const Vec3& v : piece.local.vertices) piece.centre += v / static_cast<double>(piece.local.vertices.size());
      for (const Vec3& v : piece.local.vertices)
        piece.reach = std::max(piece.reach, (v - piece.centre).norm() + piece.local.radius);
      pieces.push_back(std::move(piece));
    }
  }
  return pieces;
}

using Pair = std::pair<std::size_t, std::size_t>;  // Robot::bodies, the lower one first

std::set<Pair> hinged(const Robot& robot) {
  std::set<Pair> pairs;
  for (const Module& module : robot.modules) {
    for (const HingeType& hinge : robot.types[module.type].hinges)
      pairs.insert(std::minmax(module.first_body + hinge.parent, module.first_body + hinge.child));
  }
  return pairs;
}

/// Pieces whose balls meet, by a sweep along x.
class Sweep {
 public:
  explicit Sweep(const std::vector<Piece>& pieces) : pieces_(pieces), balls_(pieces.size()) {
    for (std::size_t i = 0; i < pieces.size(); ++i) order_.push_back(i);
  }

  template <class Meet>
  void operator()(const Kinematics& k, Meet meet) {
    for (std::size_t i = 0; i < pieces_.size(); ++i) balls_[i] = k.point(pieces_[i].link, pieces_[i].centre);
    const auto left = [&](std::size_t i) { return balls_[i].x() - pieces_[i].reach; };
    std::ranges::sort(order_, {}, [&](std::size_t i) { return std::pair(left(i), i); });
    for (auto a = order_.begin(); a != order_.end(); ++a) {
      const double right = balls_[*a].x() + pieces_[*a].reach;
      for (auto b = std::next(a); b != order_.end() && left(*b) < right; ++b) {
        const double reach = pieces_[*a].reach + pieces_[*b].reach;
        if ((balls_[*a] - balls_[*b]).squaredNorm() < reach * reach) meet(pieces_[*a], pieces_[*b]);
      }
    }
  }

 private:
  const std::vector<Piece>& pieces_;
  std::vector<Vec3> balls_;
  std::vector<std::size_t> order_ = {};
};

}  // namespace

std::optional<Collision> collisions(const Scenario& scenario, const Recording& r) {
  const Robot& robot = *scenario.robot;
  if (!r.has_states(robot)) return {};
  const std::vector<Piece> pieces = pieces_of(robot);
  const std::set<Pair> neighbours = hinged(robot);
  std::set<Pair> met;
  Collision found;
  std::size_t first_row = 0;
  double first_depth = 0;
  Kinematics k(robot);
  Sweep sweep(pieces);
  for (std::size_t row = 0; row < r.rows(); ++row) {
    k.update(robot, r.state(robot, row));
    const auto pose = [&](const Piece& piece) { return Pose{k.R[piece.link], k.p[piece.link]}; };
    sweep(k, [&](const Piece& a, const Piece& b) {
      const Pair pair = std::minmax(a.body, b.body);
      if (a.link == b.link || neighbours.contains(pair)) return;
      const double depth = penetration(moved(a.local, pose(a)), moved(b.local, pose(b)), kCollides);
      if (!(depth > 0)) return;
      if (met.empty()) first_row = row;
      met.insert(pair);
      if (row == first_row && depth > first_depth) {
        std::tie(found.first, found.second) = pair;
        first_depth = depth;
      }
      if (depth <= found.depth) return;
      found.depth = depth;
      std::tie(found.deepest_first, found.deepest_second) = pair;
    });
  }
  found.time = static_cast<double>(first_row) * scenario.trace.period;
  found.pairs = met.size();
  return met.empty() ? std::nullopt : std::optional(found);
}

std::optional<Sunk> sunk(const Scenario& scenario, const Recording& r) {
  const Robot& robot = *scenario.robot;
  if (scenario.ground.kind != Ground::Kind::plane || !r.has_states(robot)) return {};
  const std::vector<Piece> pieces = pieces_of(robot);
  std::optional<Sunk> found;
  Kinematics k(robot);
  for (std::size_t row = 0; row < r.rows(); ++row) {
    k.update(robot, r.state(robot, row));
    for (const Piece& piece : pieces) {
      if (k.point(piece.link, piece.centre).z() - piece.reach > -kSinks) continue;
      double lowest = 0;
      for (const Vec3& vertex : piece.local.vertices)
        lowest = std::min(lowest, k.point(piece.link, vertex).z() - piece.local.radius);
      if (-lowest <= (found ? found->depth : kSinks)) continue;
      if (!found) found = Sunk{.time = static_cast<double>(row) * scenario.trace.period};
      found->body = piece.body;
      found->depth = -lowest;
    }
  }
  return found;
}

}  // namespace gaitlab::report
