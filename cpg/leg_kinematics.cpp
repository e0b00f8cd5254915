#include "cpg/leg_kinematics.h"

#include <Eigen/LU>
#include <algorithm>
#include <limits>

namespace gaitlab::cpg {

namespace {
constexpr double kWidest = 2.5;   // rad, largest angle of a joint in a stance or gait
constexpr double kLongest = 0.3;  // rad, largest step
}  // namespace

LegKinematics::LegKinematics(const RobotInfo& robot, const Leg& leg) : elements_(leg.elements), foot_(vector_of(leg.foot)) {
  for (std::int64_t j = leg.tip; j >= 0; j = robot.joints[static_cast<std::size_t>(j)].parent) {
    const JointInfo& joint = robot.joints[static_cast<std::size_t>(j)];
    const auto own = std::find(leg.joints.begin(), leg.joints.end(), j);
    hinges_.push_back({static_cast<std::size_t>(j), vector_of(joint.origin), vector_of(joint.axis),
                       own == leg.joints.end() ? -1 : static_cast<int>(own - leg.joints.begin())});
  }
  std::reverse(hinges_.begin(), hinges_.end());
  while (hinges_[first_].of_leg != 0) ++first_;
  measure();
  for (const std::int64_t j : leg.joints) {
    const JointInfo& joint = robot.joints[static_cast<std::size_t>(j)];
    joints_.push_back(static_cast<std::size_t>(j));
    const double lo = std::max(joint.lo, std::min(-kWidest, joint.start));
    const double hi = std::min(joint.hi, std::max(kWidest, joint.start));
    ranges_.push_back(lo < hi ? Range{lo, hi} : Range{joint.lo, joint.hi});
  }
  jacobian_.resize(3 * joints_.size());
  step_.resize(joints_.size());
}

Pose LegKinematics::turn_of(const Hinge& hinge, double angle) {
  const Mat3 R = turn(hinge.axis, angle).toRotationMatrix();
  return {R, hinge.origin - R * hinge.origin};
}

void LegKinematics::measure() {
  length_ = 0;
  for (std::size_t k = first_; k < hinges_.size(); ++k) {
    const Vec3& next = k + 1 < hinges_.size() ? hinges_[k + 1].origin : foot_;
    length_ += (next - hinges_[k].origin).norm();
  }
}

Vec3 LegKinematics::moved(Vec3 at, const std::vector<double>& q) const {
  for (std::size_t k = hinges_.size(); k-- > 0;) at = turn_of(hinges_[k], q[hinges_[k].joint]) * at;
  return at;
}

Vec3 LegKinematics::foot(const std::vector<double>& q) const { return moved(foot_, q); }

bool LegKinematics::stand(const std::vector<double>& q, const Vec3& up) {
  constexpr double kSole = 1e-3;  // m
  const auto point = [](const std::array<double, 4>& element) { return Vec3(element[0], element[1], element[2]); };
  const auto height = [&](const std::array<double, 4>& element) { return up.dot(moved(point(element), q)) - element[3]; };
  double low = std::numeric_limits<double>::infinity();
  for (const auto& element : elements_) low = std::min(low, height(element));
  Vec3 sum = Vec3::Zero();
  double count = 0;
  for (const auto& element : elements_) {
    if (height(element) > low + kSole) continue;
    sum += point(element);
    count += 1;
  }
  if (count == 0 || (sum / count - foot_).norm() < kSole) return false;
  foot_ = sum / count;
  measure();
  return true;
}

Vec3 LegKinematics::hip(const std::vector<double>& q) const {
  Vec3 at = hinges_[first_].origin;
  for (std::size_t k = first_; k-- > 0;) at = turn_of(hinges_[k], q[hinges_[k].joint]) * at;
  return at;
}

Vec3 LegKinematics::knee(const std::vector<double>& q) const {
  Vec3 at = hinges_.back().origin;
  for (std::size_t k = hinges_.size() - 1; k-- > 0;) at = turn_of(hinges_[k], q[hinges_[k].joint]) * at;
  return at;
}

Vec3 LegKinematics::hip_axis(const std::vector<double>& q) const {
  Vec3 along = hinges_[first_].axis;
  for (std::size_t k = first_; k-- > 0;) along = turn_of(hinges_[k], q[hinges_[k].joint]).R * along;
  return along;
}

void LegKinematics::reach(const Vec3& target, const Mat3& weights, double damping, int rounds, std::vector<double>& q) const {
  constexpr double kNear = 1e-9;  // rad, a step that changes nothing
  const auto count = static_cast<Eigen::Index>(joints_.size());
  Eigen::Map<Eigen::Matrix3Xd> J(jacobian_.data(), 3, count);
  Eigen::Map<Eigen::VectorXd> step(step_.data(), count);
  for (int round = 0; round < rounds; ++round) {
    const Vec3 at = foot(q);
    Pose before;  // of the hinges between the base and this one
    for (const Hinge& hinge : hinges_) {
      if (hinge.of_leg >= 0) J.col(hinge.of_leg) = weights * (before.R * hinge.axis).cross(at - before * hinge.origin);
      before = before * turn_of(hinge, q[hinge.joint]);
    }
    const double d = damping * std::max(J.norm(), kNear);
    const Mat3 square = J * J.transpose() + d * d * Mat3::Identity();
    const Vec3 pull = square.inverse() * (weights * (target - at));
    step.noalias() = J.transpose() * pull;
    double farthest = 0;
    for (std::size_t i = 0; i < joints_.size(); ++i) {
      double& angle = q[joints_[i]];
      const double old = angle;
      const double by = std::clamp(step[static_cast<Eigen::Index>(i)], -kLongest, kLongest);
      angle = std::clamp(angle + by, ranges_[i].lo, ranges_[i].hi);
      farthest = std::max(farthest, std::abs(angle - old));
    }
    if (farthest < kNear) return;
  }
}

}  // namespace gaitlab::cpg
