#include "report/verdict/leg_sag.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/model/kinematics.h"
#include "core/model/legs.h"
#include "core/scenario/sensor_section.h"
#include "core/simulation/start.h"

namespace gaitlab::report {

namespace {

constexpr double kMost = 0.03;  // rad; chosen: above all shipped robots; one with 0.073 lost half of its speed
constexpr double kHeld = 0.01;  // rad; that of a new scenario

/// Gain and control period that hold the legs, with the same share of an error removed per period.
std::string stiffer(const Scenario& s, const LegSag& sag) {
  constexpr std::array kPeriods{0.01, 0.005, 0.002, 0.001};  // s
  const auto held = [&](double period) { return sag.angle * period / s.control_period; };
  const auto longest = std::ranges::find_if(kPeriods, [&](double period) { return held(period) <= kHeld; });
  const double period = longest == kPeriods.end() ? kPeriods.back() : *longest;
  if (!(period < s.control_period)) return fmt::format("a larger {} holds them", sag.loop.key);
  return fmt::format("{} with controller.period {:.3g} s holds them to {:.2g} rad",
                     sag.loop.key_text(sag.loop.Kp * s.control_period / period), period, held(period));
}

/// Middle of the contact elements of a leg that are lowest in the pose, m.
Vec3 sole(const Leg& leg, std::size_t link, const Kinematics& zero, const Kinematics& posed, const Vec3& up) {
  constexpr double kLevel = 1e-3;  // m
  std::vector<Vec3> points;
  double low = std::numeric_limits<double>::infinity();
  for (const auto& [x, y, z, radius] : leg.elements) {
    points.push_back(posed.point(link, zero.R[link].transpose() * (Vec3(x, y, z) - zero.p[link])) - radius * up);
    low = std::min(low, up.dot(points.back()));
  }
  std::erase_if(points, [&](const Vec3& point) { return up.dot(point) > low + kLevel; });
  Vec3 middle = Vec3::Zero();
  for (const Vec3& point : points) middle += point / static_cast<double>(points.size());
  return middle;
}

}  // namespace

std::optional<Warning> sag_warning(const Scenario& s) {
  if (!stands(s)) return {};
  const std::optional<LegSag> sag = leg_sag(s, plugin_info(s), lowered_start(s).q);
  if (!sag || !(sag->angle > kMost)) return {};
  return Warning{
      s.nearest_place(fmt::format("controller.{}", sag->loop.key)),
      fmt::format("the legs yield by up to {:.2g} rad under the weight of the robot, first {}, and by more while feet are "
                  "lifted; expected at most {} rad, so that feet clear the ground: {}",
                  sag->angle, s.robot->joints[sag->loop.joint].name, kMost, stiffer(s, *sag))};
}

std::optional<LegSag> leg_sag(const Scenario& scenario, const RobotInfo& info, std::span<const double> q) {
  const Robot& robot = *scenario.robot;
  const std::vector<PositionLoop> loops = position_loops(scenario);
  if (info.legs.empty() || loops.empty()) return {};
  RobotState pose;
  pose.q.assign(q.begin(), q.end());
  pose.qd.assign(q.size(), 0);
  Kinematics k(robot);
  k.place(robot, pose);
  const Kinematics zero = at_zero(robot);
  const Vec3 up = vector_of(info.up);
  const double load = robot.mass * scenario.physics.gravity.norm() / static_cast<double>(info.legs.size());
  std::optional<LegSag> most;
  for (const Leg& leg : info.legs) {
    const Vec3 foot = sole(leg, robot.joints[static_cast<std::size_t>(leg.tip)].link, zero, k, up);
    for (const PositionLoop& loop : loops) {
      if (std::ranges::find(leg.joints, static_cast<std::int64_t>(loop.joint)) == leg.joints.end()) continue;
      const std::size_t link = robot.joints[loop.joint].link;
      const Vec3 axis = k.R[link] * robot.links[link].axis;
      const double lever = up.dot(axis.cross(foot - k.p[link]));  // m, of the load about the joint
      const double angle = std::abs(lever) * load / loop.stiffness;
      if (!most || angle > most->angle) most = {loop, angle};
    }
  }
  return most;
}

}  // namespace gaitlab::report
