// Order of the numbers of a state, lane by lane.
#include "core/simulation/state_layout.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "core/model/kinematics.h"

namespace gaitlab {
namespace {

/// A state whose numbers are first, first + 1, ... in the order that the header states.
RobotState numbered(double first, std::size_t joints) {
  RobotState s;
  const auto next = [&first] { return first++; };
  for (Eigen::Index i = 0; i < 3; ++i) s.position[i] = next();
  s.orientation.w() = next();
  s.orientation.x() = next();
  s.orientation.y() = next();
  s.orientation.z() = next();
  for (Eigen::Index i = 0; i < 3; ++i) s.velocity[i] = next();
  for (Eigen::Index i = 0; i < 3; ++i) s.angular_velocity[i] = next();
  for (std::size_t j = 0; j < joints; ++j) s.q.push_back(next());
  for (std::size_t j = 0; j < joints; ++j) s.qd.push_back(next());
  return s;
}

TEST(StateLayout, WritesEveryNumberOfALaneAndNoneOfAnother) {
  for (const std::size_t lanes : {1U, 3U}) {
    for (const std::size_t joints : {0U, 2U}) {
      const StateLayout layout{joints, lanes};
      ASSERT_EQ(layout.size(), (13 + 2 * joints) * lanes);
      EXPECT_EQ(layout.angles(), 13 * lanes);
      EXPECT_EQ(layout.speeds(), layout.angles() + joints * lanes);
      for (std::size_t lane = 0; lane < lanes; ++lane) {
        std::vector<double> state(layout.size(), std::nan(""));
        layout.write(numbered(100, joints), lane, state);
        for (std::size_t at = 0; at < state.size(); ++at) {
          if (at % lanes == lane) {
            const std::size_t entry = at / lanes;
            EXPECT_EQ(state[at], 100 + static_cast<double>(entry)) << at;
          } else {
            EXPECT_TRUE(std::isnan(state[at])) << at << " is of another lane";
          }
        }
      }
    }
  }
}

TEST(StateLayout, ReadsWhatItWrote) {
  const StateLayout layout{2, 4};
  std::vector<double> state(layout.size());
  for (std::size_t lane = 0; lane < 4; ++lane) layout.write(numbered(100.0 * static_cast<double>(lane), 2), lane, state);
  for (std::size_t lane = 0; lane < 4; ++lane) {
    const RobotState expected = numbered(100.0 * static_cast<double>(lane), 2);
    RobotState s;
    s.q = s.qd = {-1, -1};
    layout.read(state, lane, s);
    EXPECT_EQ(s.position, expected.position);
    EXPECT_EQ(s.orientation.coeffs(), expected.orientation.coeffs());
    EXPECT_EQ(s.velocity, expected.velocity);
    EXPECT_EQ(s.angular_velocity, expected.angular_velocity);
    EXPECT_EQ(s.q, expected.q);
    EXPECT_EQ(s.qd, expected.qd);
  }
}

TEST(OnePart, HasTheStepAsItsWeightsAndTheWorksInTheirOrder) {
  const std::vector<double> torque{1, 2};
  const std::vector<double> speed{3, 4};
  const std::vector<double> angle{5, 6};
  const std::vector<double> works{7, 8, 9, 10};
  OnePart part;
  part.set(torque, speed, angle, 0.125);
  const StepEffort effort = part.applied(works);
  ASSERT_EQ(effort.parts.size(), 1U);
  const StepEffort::Part& only = effort.parts[0];
  EXPECT_EQ(only.torque.data(), torque.data());
  EXPECT_EQ(only.speed.data(), speed.data());
  EXPECT_EQ(only.angle.data(), angle.data());
  for (const In weight : {only.sum, only.share}) {
    ASSERT_EQ(weight.size(), 1U);
    EXPECT_EQ(weight[0], 0.125);
  }
  EXPECT_FALSE(only.instant);
  EXPECT_EQ(effort.contact[0], 7);
  EXPECT_EQ(effort.friction[0], 8);
  EXPECT_EQ(effort.stops[0], 9);
  EXPECT_EQ(effort.hinges[0], 10);
}

}  // namespace
}  // namespace gaitlab
