// Tests of the check for joints that move nothing: it finds gimbal lock, also across other joints, and accepts chains of any
// length.
#include "core/simulation/start_check.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "core/errors.h"
#include "tests/messages.h"

namespace gaitlab::test {
namespace {

/// Chain of links 0.1 m apart along x, each with a joint about a given axis.
class Chain {
 public:
  Chain() { robot_.links.push_back(body(Vec3::UnitY(), 1)); }
  void add(const Vec3& axis, double mass) {
    Link link = body(axis, mass);
    link.parent = static_cast<int>(robot_.links.size()) - 1;
    link.joint = static_cast<int>(robot_.joints.size());
    link.in_parent.p = Vec3(0.1, 0, 0);
    robot_.joints.push_back({.name = "j" + std::to_string(robot_.joints.size()), .link = robot_.links.size()});
    robot_.links.push_back(link);
  }
  [[nodiscard]] std::string said() const {
    Scenario scenario;
    scenario.robot = std::make_shared<const Robot>(robot_);
    return message_of([&] { check_inertia(scenario, at_zero(robot_), {}, 1, 0, SourceLocation{"s.yaml"}); });
  }

 private:
  static Link body(const Vec3& axis, double mass) {
    Link link;
    link.axis = axis;
    link.mass = mass;
    link.com = Vec3(0.05, 0, 0);
    link.inertia = mass * 1e-3 * Mat3::Identity();
    return link;
  }

  Robot robot_;
};

TEST(StartCheck, AChainOfAnyLengthMovesItself) {
  Chain chain;
  for (int k = 0; k < 20000; ++k) chain.add(Vec3::UnitY(), 0.1);
  EXPECT_EQ(chain.said(), kNoError);
}

TEST(StartCheck, JointsInLineAreSeenAcrossOthers) {
  for (const int between : {0, 1, 3}) {
    Chain chain;
    chain.add(Vec3::UnitX(), 0);
    for (int k = 0; k < between; ++k) chain.add(k % 2 == 0 ? Vec3::UnitY() : Vec3::UnitZ(), 0);
    chain.add(Vec3::UnitX(), 0.1);
    chain.add(Vec3::UnitY(), 0.1);
    EXPECT_TRUE(chain.said().starts_with("s.yaml: error: joint 'j0' moves no inertia")) << between << chain.said();
  }
}

}  // namespace
}  // namespace gaitlab::test
