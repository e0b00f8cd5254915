// Robot for tests of drawings. Its modules are similar to M-TRAN and defined in this file, so that the tests read no scenario.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "core/model/kinematics.h"
#include "report/figures/run/views.h"

namespace gaitlab::sample {

inline constexpr double kPi = 3.14159265358979323846;

inline ModuleType mtran() {
  ModuleType type;
  type.name = "mtran";
  type.lattice = true;
  const Mat3 inertia = 1e-4 * Mat3::Identity();
  const Shape active_round{Shape::Kind::half_cylinder, {Mat3::Identity(), {-0.0325, 0, 0}}, {0.0325, 0.065, 0}};
  const Shape active_box{Shape::Kind::box, {Mat3::Identity(), {-0.04875, 0, 0}}, {0.0325, 0.065, 0.065}};
  const Shape link_box{Shape::Kind::box, {Mat3::Identity(), {0.0325, 0, 0}}, {0.065, 0.02, 0.04}};
  const Shape passive_round{Shape::Kind::half_cylinder, {rpy({0, 0, kPi}), Vec3::Zero()}, {0.0325, 0.065, 0}};
  const Shape passive_box{Shape::Kind::box, {Mat3::Identity(), {0.01625, 0, 0}}, {0.0325, 0.065, 0.065}};
  type.bodies = {{"active", 0.16, {-0.0355, 0, 0}, inertia, {active_box, active_round}},
                 {"link", 0.08, {0.0325, 0, 0}, inertia, {link_box}},
                 {"passive", 0.16, {0.003, 0, 0}, inertia, {passive_box, passive_round}}};
  type.hinges = {{"active", 0, 1, {Mat3::Identity(), {-0.0325, 0, 0}}, Vec3::UnitY(), -kPi / 2, kPi / 2},
                 {"passive", 1, 2, {Mat3::Identity(), {0.065, 0, 0}}, Vec3::UnitY(), -kPi / 2, kPi / 2}};
  const Vec3 x = Vec3::UnitX();
  const Vec3 y = Vec3::UnitY();
  type.faces = {{0, 0, Gender::active, {-0.0325, 0.0325, 0}, y, x},   {1, 0, Gender::active, {-0.065, 0, 0}, -x, y},
                {2, 0, Gender::active, {-0.0325, -0.0325, 0}, -y, x}, {3, 2, Gender::passive, {0, 0.0325, 0}, y, x},
                {4, 2, Gender::passive, {0.0325, 0, 0}, x, y},        {5, 2, Gender::passive, {0, -0.0325, 0}, -y, x}};
  return type;
}

inline Robot robot(int modules, const std::vector<Dock>& docks) {
  return assemble({mtran()}, std::vector<std::size_t>(static_cast<std::size_t>(modules), 0), docks);
}

inline Robot caterpillar(int modules) {
  std::vector<Dock> docks;
  for (int k = 1; k < modules; ++k) docks.push_back({1, k, 4, k - 1, 0, {}});
  return robot(modules, docks);
}

inline Robot hexapod() {
  return robot(11, {{1, 1, 4, 0, 1, {}},
                    {1, 2, 4, 1, 3, {}},
                    {1, 3, 4, 2, 1, {}},
                    {1, 4, 4, 3, 3, {}},
                    {0, 5, 3, 0, 3, {}},
                    {2, 6, 5, 0, 1, {}},
                    {0, 7, 3, 2, 3, {}},
                    {2, 8, 5, 2, 1, {}},
                    {0, 9, 3, 4, 3, {}},
                    {2, 10, 5, 4, 1, {}}});
}

inline Kinematics kinematics(const Robot& robot, RobotState state) {
  state.qd.assign(robot.joints.size(), 0);
  Kinematics kinematics(robot);
  kinematics.update(robot, state);
  return kinematics;
}

inline double lowest(const report::View& view) {
  double lowest = 1e9;
  for (const report::Outline& outline : view.outlines) {
    for (const report::Polygon& polygon : outline.polygons) {
      for (const report::Point& point : polygon) lowest = std::min(lowest, point.y);
    }
  }
  return lowest;
}

// State that is rotated about y such that the first and the last link are at equal heights.
inline RobotState level(const Robot& robot, RobotState state) {
  const Kinematics k = kinematics(robot, state);
  const Vec3 along = k.p.back() - k.p.front();
  state.orientation = turn(Vec3::UnitY(), math::atan2(along.z(), along.x()));
  return state;
}

// Side view of the robot with its lowest vertex on the ground.
inline report::View view(const Robot& robot, RobotState state, double time) {
  state.position.z() -= lowest({time, report::side_view(robot, kinematics(robot, state))});
  const Kinematics k = kinematics(robot, state);
  report::View view{time, report::side_view(robot, k)};
  for (const report::Outline& outline : view.outlines) {
    for (const report::Polygon& polygon : outline.polygons) {
      for (const report::Point& point : polygon) {
        if (point.y < 1e-3) view.contacts.push_back(point);
      }
    }
  }
  if (robot.joints.size() > 7) {
    const Vec3 hinge = k.p[robot.joints[7].link];
    view.joint = report::Point{hinge.x(), hinge.z()};
  }
  return view;
}

/// Number of occurrences of a part in a text.
inline std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

}  // namespace gaitlab::sample
