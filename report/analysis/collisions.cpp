#include "report/analysis/collisions.h"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "core/model/kinematics.h"
#include "report/analysis/convex.h"
#include "report/analysis/states.h"

namespace gaitlab::report {

namespace {

constexpr double kTouching = 1e-9;  // m: faces that touch overlap by rounding

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

/// Whether two bodies can meet: no hinge joins them, and they are of two links.
class Meetings {
 public:
  explicit Meetings(const Robot& robot) : bodies_(robot.bodies.size()), can_(bodies_ * bodies_, 1) {
    for (std::size_t a = 0; a < bodies_; ++a) {
      for (std::size_t b = 0; b < bodies_; ++b) {
        if (robot.bodies[a].link == robot.bodies[b].link) can_[a * bodies_ + b] = 0;
      }
    }
    for (const Module& module : robot.modules) {
      for (const HingeType& hinge : robot.types[module.type].hinges) {
        const std::size_t a = module.first_body + hinge.parent;
        const std::size_t b = module.first_body + hinge.child;
        can_[a * bodies_ + b] = can_[b * bodies_ + a] = 0;
      }
    }
  }
  bool operator()(std::size_t a, std::size_t b) const { return can_[a * bodies_ + b] != 0; }

 private:
  std::size_t bodies_;
  std::vector<char> can_;
};

/// All pieces in one row, moved where they are asked for.
class Row {
 public:
  explicit Row(const std::vector<Piece>& pieces) : pieces_(pieces), balls_(pieces.size()), moved_(pieces.size(), false) {
    for (const Piece& piece : pieces) there_.push_back(piece.local);
    for (std::size_t i = 0; i < pieces.size(); ++i) order_.push_back(i);
  }

  void set(const Kinematics& k) {
    k_ = &k;
    moved_.assign(pieces_.size(), false);
    for (std::size_t i = 0; i < pieces_.size(); ++i) balls_[i] = k.point(pieces_[i].link, pieces_[i].centre);
  }
  const Convex& piece(std::size_t i) {
    const std::size_t link = pieces_[i].link;
    if (!moved_[i]) move(pieces_[i].local, {k_->R[link], k_->p[link]}, there_[i]);
    moved_[i] = true;
    return there_[i];
  }
  /// m, as penetration(). The axis that showed two apart shows it at the next tick, too, nearly always.
  double depth(std::size_t a, std::size_t b, double ignored) {
    const auto last = apart_.find({a, b});
    const auto place = [&](std::size_t i) { return Pose{k_->R[pieces_[i].link], k_->p[pieces_[i].link]}; };
    if (last != apart_.end() && are_apart(pieces_[a].local, place(a), pieces_[b].local, place(b), last->second, ignored)) {
      return 0;
    }
    Vec3 apart;
    const double depth = penetration(piece(a), piece(b), ignored, apart);
    if (!(depth > 0)) apart_[{a, b}] = apart;
    return depth;
  }
  [[nodiscard]] double lowest(std::size_t i) const { return balls_[i].z() - pieces_[i].reach; }

  /// Pairs of pieces that can meet and whose balls do, by a sweep along x.
  template <class Meet>
  void pairs(const Meetings& can, Meet meet) {
    const auto left = [&](std::size_t i) { return balls_[i].x() - pieces_[i].reach; };
    std::ranges::sort(order_, {}, [&](std::size_t i) { return std::pair(left(i), i); });
    for (auto a = order_.begin(); a != order_.end(); ++a) {
      const double right = balls_[*a].x() + pieces_[*a].reach;
      for (auto b = std::next(a); b != order_.end() && left(*b) < right; ++b) {
        if (!can(pieces_[*a].body, pieces_[*b].body)) continue;
        const double reach = pieces_[*a].reach + pieces_[*b].reach;
        if ((balls_[*a] - balls_[*b]).squaredNorm() < reach * reach) meet(*a, *b);
      }
    }
  }

 private:
  const std::vector<Piece>& pieces_;
  const Kinematics* k_ = nullptr;
  std::vector<Vec3> balls_;
  std::vector<Convex> there_ = {};
  std::vector<bool> moved_;
  std::vector<std::size_t> order_ = {};
  std::map<std::pair<std::size_t, std::size_t>, Vec3> apart_ = {};  ///< of two pieces, the last axis that showed it
};

/// m: way out of the ground from the deepest vertex; 0: none is in it.
double depth_of(const Convex& piece, const Ground& ground) {
  double depth = 0;
  for (const Vec3& vertex : piece.vertices) depth = std::max(depth, ground.query(vertex, piece.radius).penetration);
  return depth;
}

/// What was found so far.
class Search {
 public:
  Search(const Scenario& scenario, const std::vector<Piece>& pieces)
      : pieces_(pieces),
        can_(*scenario.robot),
        limits_(scenario.limits),
        ground_(scenario.ground),
        highest_(scenario.ground.highest()) {}

  void collide(Row& row, double time) {
    double deepest = 0;
    const bool first = met_.empty();
    row.pairs(can_, [&](std::size_t a, std::size_t b) {
      const double depth = row.depth(a, b, limits_.meeting());
      if (!(depth > kTouching)) return;
      const Pair pair = std::minmax(pieces_[a].body, pieces_[b].body);
      met_.insert(pair);
      if (first && depth > deepest) {
        std::tie(collision_.first, collision_.second) = pair;
        collision_.time = time;
        deepest = depth;
      }
      if (depth <= collision_.depth) return;
      collision_.depth = depth;
      collision_.deepest_time = time;
      std::tie(collision_.deepest_first, collision_.deepest_second) = pair;
    });
  }
  void sink(Row& row, double time) {
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      if (row.lowest(i) > highest_ - limits_.sink) continue;
      const double depth = depth_of(row.piece(i), ground_);
      if (depth <= limits_.sink) continue;
      buried_.insert(pieces_[i].body);
      if (!sunk_) sunk_ = Sunk{.time = time};
      sunk_->bodies = buried_.size();
      if (depth <= sunk_->depth) continue;
      sunk_->body = pieces_[i].body;
      sunk_->depth = depth;
      sunk_->deepest_time = time;
      if (time == sunk_->time) sunk_->first = sunk_->body;
    }
  }
  [[nodiscard]] std::optional<Collision> collision() const {
    if (met_.empty()) return {};
    Collision found = collision_;
    found.pairs = met_.size();
    return found;
  }
  [[nodiscard]] const std::optional<Sunk>& sunk() const { return sunk_; }

 private:
  const std::vector<Piece>& pieces_;
  Meetings can_;
  const Limits& limits_;
  const Ground& ground_;
  double highest_;  ///< m
  std::set<Pair> met_ = {};
  std::set<std::size_t> buried_ = {};
  Collision collision_ = {};
  std::optional<Sunk> sunk_ = {};
};

}  // namespace

Overlaps overlaps(const Scenario& scenario, const Recording& r) {
  const Robot& robot = *scenario.robot;
  const States states = States::at_ticks(r, robot);
  if (scenario.contact.solver() || states.size() == 0) return {};
  const std::vector<Piece> pieces = pieces_of(robot);
  std::set<std::size_t> shaped;
  for (const Piece& piece : pieces) shaped.insert(piece.body);
  Search search(scenario, pieces);
  Kinematics k(robot);
  Row there(pieces);
  for (std::size_t row = 0; row < states.size(); ++row) {
    k.update(robot, states(row));
    there.set(k);
    search.collide(there, states.time(row));
    if (scenario.ground.kind != Ground::Kind::none) search.sink(there, states.time(row));
  }
  return {shaped.size(), search.collision(), search.sunk()};
}

double depth_in_ground(const Scenario& scenario, const RobotState& state) {
  if (scenario.ground.kind == Ground::Kind::none) return 0;
  Kinematics k(*scenario.robot);
  k.update(*scenario.robot, state);
  double depth = 0;
  for (const Piece& piece : pieces_of(*scenario.robot))
    depth = std::max(depth, depth_of(moved(piece.local, {k.R[piece.link], k.p[piece.link]}), scenario.ground));
  return depth;
}

}  // namespace gaitlab::report
