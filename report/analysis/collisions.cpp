#include "report/analysis/collisions.h"

#include <algorithm>
#include <limits>
#include <numbers>
#include <set>
#include <tuple>
#include <utility>

#include "core/model/kinematics.h"
#include "report/analysis/convex.h"
#include "report/analysis/meetings.h"
#include "report/analysis/states.h"

namespace gaitlab::report {

namespace {

constexpr double kTouching = 1e-9;  // m; smaller overlaps of touching faces are rounding errors

/// One shape of a body in the frame of its link, with a bounding sphere.
struct Piece {
  std::size_t body = 0, link = 0;
  Convex local;
  Extent extent{local};
  Vec3 centre = Vec3::Zero();  ///< m, centre of the bounding sphere in the frame of the link
  double reach = 0;            ///< m, radius of the bounding sphere
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

using Pair = std::pair<std::size_t, std::size_t>;  // indices in Robot::bodies, the smaller one first

/// Two pieces that are near each other.
struct Near {
  std::size_t a = 0, b = 0;  ///< indices of the pieces, the smaller index first
  double by_design = 0;      ///< m, overlap of the two bodies that does not count
  /// Sum of the two pieces' paths, m, up to which they cannot touch.
  double apart_until = 0;
  Vec3 axis = Vec3::Zero();  ///< last separating axis; 0 if none was found yet
  Pose then = {};            ///< pose of piece b in the frame of piece a when the gap was measured
  double gap = 0;            ///< m, gap between the pieces at that time
};

/// Poses of all pieces in one row after another. A piece is moved only if it may have touched another one since the two were
/// last found apart. The path of a point of a piece is at most the path of its bounding sphere's centre plus the path due to
/// the rotation of the link.
class Row {
 public:
  explicit Row(const std::vector<Piece>& pieces)
      : pieces_(pieces), balls_(pieces.size()), moved_(pieces.size(), false), way_(pieces.size(), 0.0) {
    for (const Piece& piece : pieces) {
      there_.push_back(piece.local);
      margin_ += piece.reach / static_cast<double>(pieces.size());
    }
    for (std::size_t i = 0; i < pieces.size(); ++i) order_.push_back(i);
  }

  void set(const Kinematics& k) {
    const bool first = k_ == nullptr;
    if (first) before_ = k.R;
    k_ = &k;
    moved_.assign(pieces_.size(), false);
    // Bound of |R - R'|: path of a point at 1 m from the centre due to the rotation.
    const auto turned = [&](std::size_t link) { return (k.R[link] - before_[link]).norm() / std::numbers::sqrt2; };
    double turn = 0;
    double farthest = 0;
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      const Piece& piece = pieces_[i];
      const Vec3 ball = k.point(piece.link, piece.centre);
      if (i == 0 || piece.link != pieces_[i - 1].link) turn = turned(piece.link);
      const double way = first ? 0 : (ball - balls_[i]).norm() + turn * piece.reach;
      way_[i] += way;
      farthest = std::max(farthest, way);
      balls_[i] = ball;
    }
    before_ = k.R;
    since_found_ += farthest;
  }
  const Convex& piece(std::size_t i) {
    if (!moved_[i]) move(pieces_[i].local, place(i), there_[i]);
    moved_[i] = true;
    return there_[i];
  }
  /// Upper bound of the path of any point of the piece since the first row, m.
  [[nodiscard]] double way(std::size_t i) const { return way_[i]; }
  [[nodiscard]] double lowest(std::size_t i) const { return balls_[i].z() - pieces_[i].reach; }
  /// Height of the lowest point of the piece, m.
  [[nodiscard]] double bottom(std::size_t i) const {
    const Pose there = place(i);
    return there.p.z() + pieces_[i].extent.along(there.R.transpose() * Vec3::UnitZ()).first;
  }

  /// Calls meet(a, b, depth) for all pairs of pieces that collide, in the order of a sweep along x. depth is that of
  /// penetration() beyond the overlap by design, m, and greater than 0.
  template <class Meet>
  void pairs(Meetings& can, double ignored, Meet meet) {
    if (2 * since_found_ > margin_ - kRounding) find_near(can);
    met_.clear();
    for (Near& pair : near_) {
      if (together(pair) < pair.apart_until) continue;
      const double gap = (balls_[pair.a] - balls_[pair.b]).norm() - pieces_[pair.a].reach - pieces_[pair.b].reach;
      pair.apart_until = together(pair) + gap - kRounding;
      if (gap >= 0 || still_apart(pair)) continue;
      const Key a(left(pair.a), pair.a);
      const Key b(left(pair.b), pair.b);
      const double depth = this->depth(std::min(a, b).second, std::max(a, b).second, pair.by_design + ignored, pair);
      if (depth > 0) met_.push_back({std::min(a, b), std::max(a, b), depth - pair.by_design});
    }
    std::ranges::sort(met_);
    for (const auto& [a, b, depth] : met_) meet(a.second, b.second, depth);
  }

 private:
  using Key = std::pair<double, std::size_t>;

  [[nodiscard]] Pose place(std::size_t i) const { return {k_->R[pieces_[i].link], k_->p[pieces_[i].link]}; }
  [[nodiscard]] double left(std::size_t i) const { return balls_[i].x() - pieces_[i].reach; }
  [[nodiscard]] double together(const Near& pair) const { return way_[pair.a] + way_[pair.b]; }

  /// Finds the pairs of pieces whose bounding spheres are less than margin_ apart, by a sweep along x.
  void find_near(Meetings& can) {
    since_found_ = 0;
    std::ranges::sort(order_, {}, [&](std::size_t i) { return Key(left(i), i); });
    std::vector<Near> found;
    for (auto a = order_.begin(); a != order_.end(); ++a) {
      const double right = balls_[*a].x() + pieces_[*a].reach + margin_;
      for (auto b = std::next(a); b != order_.end() && left(*b) < right; ++b) {
        if (!can(pieces_[*a].body, pieces_[*b].body)) continue;
        const double reach = pieces_[*a].reach + pieces_[*b].reach + margin_;
        if ((balls_[*a] - balls_[*b]).squaredNorm() < reach * reach) found.push_back({std::min(*a, *b), std::max(*a, *b)});
      }
    }
    const auto place_of = [](const Near& pair) { return Pair(pair.a, pair.b); };
    std::ranges::sort(found, {}, place_of);
    for (Near& pair : found) {
      const auto known = std::ranges::lower_bound(near_, place_of(pair), {}, place_of);
      if (known != near_.end() && place_of(*known) == place_of(pair)) {
        pair = *known;
      } else {
        pair.by_design = can.by_design(pieces_[pair.a].body, pieces_[pair.b].body);
      }
    }
    near_ = std::move(found);
  }

  /// Pose of piece b in the frame of piece a.
  [[nodiscard]] Pose seen(const Near& pair) const {
    const std::size_t from = pieces_[pair.a].link;
    return {k_->R[from].transpose() * k_->R[pieces_[pair.b].link], k_->R[from].transpose() * (balls_[pair.b] - k_->p[from])};
  }

  /// True if the pieces have moved relative to each other by less than the gap between them. Two pieces of one leg may move far
  /// together.
  bool still_apart(Near& pair) const {
    if (!(pair.gap > 0)) return false;
    const Pose now = seen(pair);
    const double turn = (now.R - pair.then.R).norm() / std::numbers::sqrt2;
    const double left = pair.gap - (now.p - pair.then.p).norm() - turn * pieces_[pair.b].reach;
    if (!(left > 0)) return false;
    pair.apart_until = together(pair) + left - kRounding;
    return true;
  }

  /// Penetration of two pieces. The axis that separates them at one tick usually separates them at the next tick, so it is
  /// tested first.
  double depth(std::size_t a, std::size_t b, double ignored, Near& pair) {
    const auto overlap = [&] { return overlap_along(pieces_[a].extent, place(a), pieces_[b].extent, place(b), pair.axis); };
    double found = 0;
    double along = pair.axis.isZero() ? ignored : overlap();
    if (along > ignored - kRounding) {
      Vec3 apart;
      found = penetration(piece(a), piece(b), ignored, apart);
      pair.axis = found > 0 ? Vec3(Vec3::Zero()) : apart;
      along = found > 0 ? found : overlap();
    }
    pair.gap = ignored - along - kRounding;
    pair.then = seen(pair);
    pair.apart_until = together(pair) + pair.gap;
    return found;
  }

  static constexpr double kRounding = 1e-10;  ///< m, far above the rounding error

  const std::vector<Piece>& pieces_;
  const Kinematics* k_ = nullptr;
  std::vector<Mat3> before_ = {};  ///< axes of the links in the previous row
  std::vector<Vec3> balls_;
  std::vector<Convex> there_ = {};
  std::vector<bool> moved_;
  std::vector<double> way_;  ///< m, upper bound of the path of each piece
  std::vector<std::size_t> order_ = {};
  double margin_ = 0;                                             ///< m, largest gap between bounding spheres of near pieces
  double since_found_ = std::numeric_limits<double>::infinity();  ///< m: upper bound of any piece's path since find_near
  std::vector<Near> near_ = {};
  struct Met {
    Key a, b;
    double depth;                                  ///< m
    auto operator<=>(const Met&) const = default;  // NOLINT(modernize-use-nullptr): the compiler compares with 0
  };
  std::vector<Met> met_ = {};
};

/// Largest distance out of the ground of any vertex, m; 0 if no vertex is in the ground.
double depth_of(const Convex& piece, const Ground& ground) {
  double depth = 0;
  for (const Vec3& vertex : piece.vertices) depth = std::max(depth, ground.query(vertex, piece.radius).penetration);
  return depth;
}

/// Collisions and sunk bodies found in the rows so far.
class OverlapSearch {
 public:
  OverlapSearch(const Scenario& scenario, const std::vector<Piece>& pieces)
      : pieces_(pieces),
        can_(scenario),
        limits_(scenario.limits),
        ground_(scenario.ground),
        highest_(scenario.ground.highest()),
        above_until_(pieces.size(), 0.0) {}

  void collide(Row& row, const RobotState& state, double time) {
    double deepest = 0;
    const bool first = met_.empty();
    const auto meet = [&](const Pair& pair, double depth) {
      if (!(depth > kTouching)) return;
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
    };
    row.pairs(can_, limits_.meeting(),
              [&](std::size_t a, std::size_t b, double depth) { meet(std::minmax(pieces_[a].body, pieces_[b].body), depth); });
    for (const Meetings::OnHinge& pair : can_.hinges())
      meet(std::minmax(pair.parent, pair.child), can_.beyond(pair, state.q[pair.joint]));
  }
  void sink(Row& row, double time) {
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      if (row.way(i) < above_until_[i]) continue;
      double room = row.lowest(i) - (highest_ - limits_.sink);
      // On boxes and height fields the way out of the ground can change by more than the piece moves.
      if (room <= 0 && ground_.is_plane()) room = row.bottom(i) + limits_.sink;
      above_until_[i] = row.way(i) + room - kTouching;
      if (room > kTouching) continue;
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
  double highest_;                   ///< m
  std::vector<double> above_until_;  ///< m: until the path of a piece reaches this, the piece cannot be deeper than
                                     ///< Limits::sink
  std::set<Pair> met_ = {};
  std::set<std::size_t> buried_ = {};
  Collision collision_ = {};
  std::optional<Sunk> sunk_ = {};
};

}  // namespace

Overlaps overlaps(const Scenario& scenario, const Recording& r) {
  const Robot& robot = *scenario.robot;
  const States states = States::at_ticks(r, robot);
  if (scenario.contact.model().keeps_bodies_apart || states.size() == 0) return {};
  const std::vector<Piece> pieces = pieces_of(robot);
  std::set<std::size_t> shaped;
  for (const Piece& piece : pieces) shaped.insert(piece.body);
  for (std::size_t b = 0; b < robot.bodies.size() && !shaped.empty(); ++b) {
    const Body& body = robot.bodies[b];
    if (robot.types[robot.modules[body.module].type].bodies[body.type].bare) shaped.insert(b);
  }
  OverlapSearch search(scenario, pieces);
  Kinematics k(robot);
  Row there(pieces);
  for (std::size_t row = 0; row < states.size(); ++row) {
    const RobotState state = states(row);
    k.place(robot, state);
    there.set(k);
    search.collide(there, state, states.time(row));
    if (scenario.ground.exists()) search.sink(there, states.time(row));
  }
  return {shaped.size(), search.collision(), search.sunk()};
}

std::optional<Collision> collision_in(const Scenario& scenario, const RobotState& state) {
  const std::vector<Piece> pieces = pieces_of(*scenario.robot);
  OverlapSearch search(scenario, pieces);
  Kinematics k(*scenario.robot);
  k.place(*scenario.robot, state);
  Row there(pieces);
  there.set(k);
  search.collide(there, state, 0);
  return search.collision();
}

double depth_in_ground(const Scenario& scenario, const RobotState& state) {
  if (!scenario.ground.exists()) return 0;
  Kinematics k(*scenario.robot);
  k.place(*scenario.robot, state);
  double depth = 0;
  for (const Piece& piece : pieces_of(*scenario.robot))
    depth = std::max(depth, depth_of(moved(piece.local, {k.R[piece.link], k.p[piece.link]}), scenario.ground));
  return depth;
}

}  // namespace gaitlab::report
