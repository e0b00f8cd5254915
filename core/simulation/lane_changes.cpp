#include "core/simulation/lane_changes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/laws/hinge_stop.h"
#include "core/plugin/plugin_instance.h"
#include "core/scenario/change_section.h"

namespace gaitlab {

namespace {

constexpr std::uint32_t kDraw = 16;  // draw for lost set points; sensors use lower numbers

}  // namespace

LaneChanges::LaneChanges(const Scenario& scenario, const RobotInfo& robot)
    : joints_(robot.joints.size()), period_(scenario.control_period) {
  segments_.reserve(1 + scenario.changes.size());
  segments_.push_back({0, make_cpg(scenario.cpg, robot), make_controller(scenario.controller, robot), {}});
  segments_[0].faults.resize(joints_);
  for (const Change& change : scenario.changes) add(change, scenario, robot);
  bool lost = false;
  for (const Segment& segment : segments_) {
    for (const FaultInForce& fault : segment.faults) {
      const bool weak = fault.kind == FaultKind::open || fault.kind == FaultKind::weak;
      stuck_ = stuck_ || fault.kind == FaultKind::stuck;
      change_joints_ = change_joints_ || stuck_ || weak;
      lost = lost || fault.kind == FaultKind::lost;
      longest_ = std::max(longest_, fault.delay);
    }
  }
  if (!lost) return;
  for (const JointInfo& joint : robot.joints) streams_.emplace_back(static_cast<std::uint64_t>(scenario.seed), joint.name);
}

void LaneChanges::add(const Change& change, const Scenario& scenario, const RobotInfo& robot) {
  Segment segment{first_tick(change.t, scenario.control_period), make_cpg(change.cpg, robot),
                  make_controller(change.controller, robot), segments_.back().faults};
  for (const JointFault& fault : change.faults) {
    const FaultInForce own{fault.kind, fault.share, std::llround(fault.delay / scenario.control_period)};
    for (const std::size_t j : joints_of(fault, *scenario.robot)) segment.faults[j] = own;
  }
  segments_.push_back(std::move(segment));
}

std::size_t LaneChanges::states() const {
  if (segments_.size() == 1) return 0;
  return 1 + (stuck_ ? 2 * joints_ : 0) + (longest_ > 0 ? joints_ * static_cast<std::size_t>(longest_ + 1) : 0);
}

void LaneChanges::begin(std::int64_t tick, In angle) {
  for (std::size_t next = segment() + 1; next < segments_.size() && segments_[next].tick <= tick; ++next) {
    const std::vector<FaultInForce>& before = segments_[next - 1].faults;
    const std::vector<FaultInForce>& now = segments_[next].faults;
    for (std::size_t j = 0; stuck_ && j < joints_; ++j) {
      if (now[j].kind != FaultKind::stuck || before[j].kind == FaultKind::stuck) continue;
      held()[j] = angle[j];
      jammed()[j] = static_cast<double>(tick);
    }
    numbers_[0] = static_cast<double>(next);
  }
}

double LaneChanges::hold(std::size_t joint) const {
  return fault(joint).kind == FaultKind::stuck ? held()[joint] : std::numeric_limits<double>::quiet_NaN();
}

double LaneChanges::stuck_for(std::size_t joint, double t) const {
  if (fault(joint).kind != FaultKind::stuck) return 0;
  return std::clamp(t - jammed()[joint] * period_, 0.0, HingeHold::kRamp);
}

void LaneChanges::lose(std::int64_t tick, In before, std::size_t lane, Out setpoint) {
  if (segments_.size() == 1) return;
  const std::size_t lanes = before.size() / std::max<std::size_t>(1, joints_);
  const auto row = [&](std::int64_t of) { return static_cast<std::size_t>(of % (longest_ + 1)) * joints_; };
  for (std::size_t j = 0; j < joints_; ++j) {
    const FaultInForce& own = fault(j);
    if (longest_ > 0) ring()[row(tick) + j] = setpoint[j];
    if (own.kind == FaultKind::late && own.delay > 0)
      setpoint[j] = ring()[row(std::max<std::int64_t>(0, tick - own.delay)) + j];
    const bool lost = own.kind == FaultKind::lost && streams_[j].uniform(static_cast<std::uint64_t>(tick), kDraw) <= own.share;
    if (lost && tick > 0) setpoint[j] = before[j * lanes + lane];
  }
}

void LaneChanges::cut(Out command) const {
  for (std::size_t j = 0; segments_.size() > 1 && j < joints_; ++j) {
    if (fault(j).kind == FaultKind::dead || fault(j).kind == FaultKind::open) command[j] = 0;
  }
}

std::vector<std::size_t> stuck_joints(const Scenario& scenario) {
  std::vector<std::size_t> all;
  for (const Change& change : scenario.changes) {
    for (const JointFault& fault : change.faults) {
      if (fault.kind != FaultKind::stuck) continue;
      const std::vector<std::size_t> own = joints_of(fault, *scenario.robot);
      all.insert(all.end(), own.begin(), own.end());
    }
  }
  std::ranges::sort(all);
  all.erase(std::unique(all.begin(), all.end()), all.end());  // clang 14 does not support std::ranges::unique
  return all;
}

}  // namespace gaitlab
