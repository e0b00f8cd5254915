#include "cpg/stance.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/math/philox.h"

namespace gaitlab::cpg {

namespace {

constexpr int kStarts = 41;
constexpr double kRoom = 0.15;  // rad, least distance from a stop

/// Sign of the largest part of an axis: legs with mirrored axes have angles of other signs.
double sign_of(const JointInfo& joint) {
  const Vec3 axis = vector_of(joint.axis);
  Eigen::Index largest = 0;
  axis.cwiseAbs().maxCoeff(&largest);
  return axis[largest] < 0 ? -1 : 1;
}

/// A number from -1 to 1 that depends on the start and the joint's place in its leg alone.
double drawn(int start, std::size_t joint) {
  const auto words = math::philox({static_cast<std::uint32_t>(start), static_cast<std::uint32_t>(joint), 0, 0}, {1, 0});
  return static_cast<double>(words[0]) / 2147483648.0 - 1;
}

/// Points on which the feet shall stand, m, base frame.
std::vector<Vec3> footing(const RobotInfo& robot, const std::vector<LegKinematics>& legs, double height,
                          const std::vector<double>& q) {
  constexpr double kBeside = 0.6;       // distance of a foot from a vertical hinge, as a share of the length
  constexpr double kFlatter = 2.0 / 3;  // share of the height of other legs
  constexpr double kSteep = 0.7;        // cosine of 45 degrees
  constexpr double kWidest = 0.5;       // share of the length
  const Vec3 up = vector_of(robot.up);
  Vec3 middle = Vec3::Zero();
  for (const LegKinematics& leg : legs) middle += leg.hip(q) / static_cast<double>(legs.size());
  std::vector<Vec3> points;
  double plane = -std::numeric_limits<double>::infinity();  // the highest that a leg needs
  for (const LegKinematics& leg : legs) {
    const Vec3 hip = leg.hip(q);
    const bool vertical = std::abs(leg.hip_axis(q).dot(up)) > kSteep;
    Vec3 beside = leg.foot(q) - hip;
    Vec3 from_middle = hip - middle;
    from_middle -= up * up.dot(from_middle);
    if (vertical && from_middle.norm() > 0) beside = from_middle.normalized() * kBeside * leg.length();
    beside -= up * up.dot(beside);
    if (!vertical) {  // only its lateral part
      const Vec3 lateral = up.cross(forwards(up));
      beside = lateral * std::clamp(beside.dot(lateral), -kWidest * leg.length(), kWidest * leg.length());
    }
    points.push_back(hip + beside);
    plane = std::max(plane, up.dot(hip) - height * (vertical ? kFlatter : 1) * leg.length());
  }
  for (Vec3& point : points) point += up * (plane - up.dot(point));
  return points;
}

double spread(const std::vector<double>& values) {
  const double count = static_cast<double>(values.size());
  double mean = 0, square = 0;
  for (const double value : values) mean += value / count;
  for (const double value : values) square += (value - mean) * (value - mean) / count;
  return std::sqrt(square);
}

/// Difference of the legs, m: standard deviation of the knees' distances from the hips, forwards or away from the middle of the
/// robot, whichever differs less. Dogs bend all legs to one side, spiders outwards.
double unlike(const RobotInfo& robot, const std::vector<LegKinematics>& legs, const std::vector<double>& q) {
  const Vec3 up = vector_of(robot.up);
  Vec3 middle = Vec3::Zero();
  for (const LegKinematics& leg : legs) middle += leg.hip(q) / static_cast<double>(legs.size());
  const Vec3 forward = forwards(up);
  std::vector<double> ahead, outwards;
  for (const LegKinematics& leg : legs) {
    const Vec3 knee = leg.knee(q) - leg.hip(q);
    Vec3 outward = leg.hip(q) - middle;
    outward -= up * up.dot(outward);
    ahead.push_back(knee.dot(forward));
    outwards.push_back(outward.norm() > 0 ? knee.dot(outward.normalized()) : 0);
  }
  return std::min(spread(ahead), spread(outwards));
}

/// Angles with their cost, and the least distance of a joint of a leg from a stop, rad.
struct Stance {
  std::vector<double> q;
  double cost = std::numeric_limits<double>::infinity(), room = 0;
};

Stance stance_at(const RobotInfo& robot, const std::vector<LegKinematics>& legs, double height,
                 const std::vector<double>& zero) {
  constexpr double kError = 10, kStop = 0.3, kUnlike = 1;  // weights
  constexpr double kDamping = 1e-2;
  constexpr int kRounds = 60;
  const std::vector<Vec3> points = footing(robot, legs, height, zero);
  Stance best;
  for (int n = 0; n < 2 * kStarts - 1; ++n) {  // each start with equal and with mirrored angles
    const int start = (n + 1) / 2;
    const bool mirrored = n % 2 == 0;
    std::vector<double> tried = zero;
    double cost = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t l = 0; l < legs.size(); ++l) {
      const std::vector<std::int64_t>& joints = robot.legs[l].joints;
      const std::vector<LegKinematics::Range>& ranges = legs[l].ranges();
      for (std::size_t i = 0; i < joints.size(); ++i) {
        const auto [lo, hi] = ranges[i];
        const double middle = std::clamp(0.0, lo, hi);
        const double sign = !mirrored ? 1 : sign_of(robot.joints[static_cast<std::size_t>(joints[i])]);
        const double by = start == 0 ? 0 : 0.35 * sign * drawn(start, i) * (hi - lo);  // 0.7 of half the range
        tried[static_cast<std::size_t>(joints[i])] = std::clamp(middle + by, lo, hi);
      }
      legs[l].reach(points[l], Mat3::Identity(), kDamping, kRounds, tried);
      double room = std::numeric_limits<double>::infinity();
      double turned = 0;
      for (std::size_t i = 0; i < joints.size(); ++i) {
        const double angle = tried[static_cast<std::size_t>(joints[i])];
        room = std::min({room, angle - ranges[i].lo, ranges[i].hi - angle});
        turned += std::abs(angle) / static_cast<double>(joints.size());
      }
      cost += kError * (points[l] - legs[l].foot(tried)).norm() / legs[l].length() + turned + (room < kRoom ? kStop : 0);
      least = std::min(least, room);
    }
    cost += kUnlike * static_cast<double>(legs.size()) * unlike(robot, legs, tried) / legs.front().length();
    if (cost < best.cost) best = {tried, cost, least};
  }
  return best;
}

std::vector<double> chosen(const RobotInfo& robot, const std::vector<LegKinematics>& legs, double height,
                           const std::vector<double>& start) {
  if (robot.start_stated) return start;
  if (height > 0) return stance_at(robot, legs, height, start).q;
  constexpr double kHeights[] = {0.75, 0.7, 0.65, 0.6, 0.55, 0.5};
  for (const double one : kHeights) {
    const Stance found = stance_at(robot, legs, one, start);
    if (found.room >= kRoom) return found.q;
  }
  return stance_at(robot, legs, kHeights[0], start).q;
}

}  // namespace

std::vector<double> stance_of(const RobotInfo& robot, std::vector<LegKinematics>& legs, double height) {
  constexpr int kRounds = 3;
  std::vector<double> q(robot.joints.size());
  for (std::size_t j = 0; j < q.size(); ++j) q[j] = std::clamp(robot.joints[j].start, robot.joints[j].lo, robot.joints[j].hi);
  const std::vector<double> start = q;
  for (int round = 0; round < kRounds; ++round) {
    q = chosen(robot, legs, height, start);
    bool changed = false;
    for (LegKinematics& leg : legs) changed = leg.stand(q, vector_of(robot.up)) || changed;
    if (!changed) break;
  }
  return q;
}

}  // namespace gaitlab::cpg
