#include "report/analysis/fall.h"

#include <fmt/format.h>

#include <Eigen/SVD>
#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>

#include "core/simulation/start.h"
#include "report/analysis/motion.h"
#include "report/analysis/states.h"

namespace gaitlab::report {

namespace {

/// Computes the height of one pose after another.
class Altimeter {
 public:
  Altimeter(const Scenario& scenario, Ground ground)
      : scenario_(scenario),
        ground_(std::move(ground)),
        elements_(contact_elements(*scenario.robot, scenario.contact.on)),
        k_(*scenario.robot) {}

  double operator()(const RobotState& state) {
    const Vec3 com = place(state);
    return com.z() - surface(com);
  }
  /// Mean height of the surfaces below the elements.
  double surface(const RobotState& state) { return surface(place(state)); }
  /// Height of the centre of mass above the lowest point of the contact elements.
  double stance(const RobotState& state) {
    const double z = place(state).z();
    return z - lowest_point(*scenario_.robot, k_, elements_);
  }

 private:
  Vec3 place(const RobotState& state) {
    k_.place(*scenario_.robot, state);
    return centre_of_mass(*scenario_.robot, k_);
  }
  double surface(const Vec3& com) const {
    if (ground_.is_plane()) return 0;
    const double give = scenario_.limits.sink;  // m: an element deeper than this is not supported there (check `in_ground`)
    if (elements_.empty()) return ground_.surface_below(com, give);
    double below = 0;
    for (const ContactElement& e : elements_) below += ground_.surface_below(k_.point(e.link, e.centre), give);
    return below / static_cast<double>(elements_.size());
  }

  const Scenario& scenario_;
  Ground ground_;
  std::vector<ContactElement> elements_;
  Kinematics k_;
};

/// Ground without the boxes that move. They are at the scenario's places only at the start, and their later places are not
/// recorded.
Ground fixed_ground(const Scenario& scenario) {
  return scenario.contact.model().moves_boxes ? scenario.ground.without_moving_boxes() : scenario.ground;
}

/// Heights of the poses of the set points, at the rows of States::at_ticks.
class ToldPoses {
 public:
  ToldPoses(const Scenario& scenario, const Recording& r)
      : robot_(*scenario.robot), altimeter_(scenario, scenario.ground), pose_(lowered_start(scenario)), k_(robot_), start_(k_) {
    start_.place(robot_, pose_);
    if (contact_elements(robot_, scenario.contact.on).empty()) return;
    for (std::size_t j = 0; j < robot_.joints.size(); ++j) {
      setpoints_.push_back(r.pose(fmt::format("joint.{}.setpoint", j)));
    }
    if (std::ranges::any_of(setpoints_, &Series::empty)) setpoints_.clear();
  }
  /// True if the recording has set points, and the robot contact elements to stand on.
  [[nodiscard]] bool known() const { return !setpoints_.empty(); }
  /// Angles beyond the range of a hinge count as its end, because no motor reaches them. The pose is upright: the mean
  /// orientation of all links, by mass, is as at the start. (The base alone does not show this: it may be the raised end of a
  /// snake.)
  double operator()(std::size_t row) {
    for (std::size_t j = 0; j < setpoints_.size(); ++j)
      pose_.q[j] = std::clamp(setpoints_[j][row], robot_.joints[j].lo, robot_.joints[j].hi);
    pose_.orientation = Quat::Identity();
    k_.place(robot_, pose_);
    pose_.orientation = Quat(upright());
    return altimeter_.stance(pose_);
  }

 private:
  /// Rotation of the base in k_ that brings the links nearest to their orientations at the start, by least squares.
  [[nodiscard]] Mat3 upright() const {
    Mat3 sum = Mat3::Zero();
    for (std::size_t i = 0; i < robot_.links.size(); ++i) sum += robot_.links[i].mass * start_.R[i] * k_.R[i].transpose();
    if (!sum.allFinite()) return Mat3::Identity();  // Eigen leaves the parts of such a matrix uninitialised
    const Eigen::JacobiSVD<Mat3> parts(sum, Eigen::ComputeFullU | Eigen::ComputeFullV);
    Mat3 u = parts.matrixU();
    const Mat3& v = parts.matrixV();
    if ((u * v.transpose()).determinant() < 0) u.col(2) *= -1;
    return u * v.transpose();
  }

  const Robot& robot_;
  Altimeter altimeter_;
  RobotState pose_;
  Kinematics k_, start_;
  std::vector<Series> setpoints_;
};

constexpr double kLeastStance =
    0.01;  // share of the standing height; used if a pose is lower or has its feet above its centre of mass
constexpr double kFallRounding = 1e-9;  // relative

}  // namespace

std::vector<double> heights(const Scenario& scenario, const Recording& r) {
  const States states = States::at_ticks(r, *scenario.robot);
  Altimeter height(scenario, fixed_ground(scenario));
  std::vector<double> all;
  for (std::size_t row = 0; row < states.size(); ++row) all.push_back(height(states(row)));
  return all;
}

double standing_height(const Scenario& scenario) { return Altimeter(scenario, scenario.ground)(lowered_start(scenario)); }

double surface_height(const Scenario& scenario, const RobotState& state) {
  return Altimeter(scenario, fixed_ground(scenario)).surface(state);
}

std::optional<Fall> fall(const Scenario& scenario, const Recording& r) {
  if (scenario.base != Base::floating || !scenario.ground.exists()) return {};
  const double standing = standing_height(scenario);
  const std::vector<double> height = heights(scenario, r);
  if (height.empty() || !(standing > 0)) return {};
  const States states = States::at_ticks(r, *scenario.robot);
  ToldPoses told(scenario, r);
  // The set points' pose is computed only at ticks that are the lowest, or a fall, compared with the start pose. It can only
  // increase the share.
  const auto share = [&](std::size_t row) {
    const double own = height[row] / standing;
    if (!told.known()) return own;
    return std::max(own, height[row] / std::max(told(row), kLeastStance * standing));
  };
  std::vector<std::size_t> rows(height.size());
  std::iota(rows.begin(), rows.end(), std::size_t{0});
  std::ranges::stable_sort(rows, {}, [&](std::size_t row) { return height[row]; });
  std::size_t lowest = rows[0];
  Fall found{.share = share(lowest)};
  for (std::size_t i = 1; i < rows.size() && height[rows[i]] / standing < found.share; ++i) {
    const double other = share(rows[i]);
    if (other < found.share) std::tie(found.share, lowest) = std::pair(other, rows[i]);
  }
  found.lowest = height[lowest];
  found.lowest_time = states.time(lowest);
  found.told = found.share > found.lowest / standing * (1 + kFallRounding);
  const double limit = scenario.limits.height;
  for (std::size_t row = 0; found.share < limit && row < height.size() && !found.time; ++row) {
    if (height[row] / standing < limit && share(row) < limit) found.time = states.time(row);
  }
  found.stays = found.time && share(height.size() - 1) < limit;
  return found;
}

}  // namespace gaitlab::report
