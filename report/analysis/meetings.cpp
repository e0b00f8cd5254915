#include "report/analysis/meetings.h"

#include "core/scenario/sections.h"

namespace gaitlab::report {

Meetings::Meetings(const Scenario& scenario)
    : robot_(*scenario.robot),
      ignored_(scenario.limits.meeting()),
      parents_(robot_.bodies.size(), robot_.bodies.size()),
      designs_(robot_.types.size()) {
  if (!scenario.may_overlap.empty()) of_scenario_ = {scenario.may_overlap, gaitlab::body_names(robot_)};
  for (const ModuleType& type : robot_.types) {
    of_type_.emplace_back(type.may_overlap, body_names(type));
    overlaps_.emplace_back(type.hinges.size());
  }
  for (const Module& module : robot_.modules) add_hinges(module);
}

void Meetings::add_hinges(const Module& module) {
  const ModuleType& type = robot_.types[module.type];
  for (std::size_t h = 0; h < type.hinges.size(); ++h) {
    const HingeType& hinge = type.hinges[h];
    OnHinge pair{module.first_body + hinge.parent, module.first_body + hinge.child};
    parents_[pair.child] = pair.parent;
    if (type.bodies[hinge.parent].shapes.empty() || type.bodies[hinge.child].shapes.empty()) continue;
    if (left_out(pair.parent, pair.child)) continue;
    const std::size_t of_child = robot_.bodies[pair.child].link;
    const std::size_t of_parent = robot_.bodies[pair.parent].link;
    const bool moves_child = robot_.links[of_child].parent == static_cast<int>(of_parent);
    pair.joint = static_cast<std::size_t>(robot_.links[moves_child ? of_child : of_parent].joint);
    pair.sign = moves_child ? 1 : -1;
    pair.type = module.type;
    pair.hinge = h;
    hinges_.push_back(pair);
  }
}

bool Meetings::left_out(std::size_t a, std::size_t b) const {
  const Body &one = robot_.bodies[a], &other = robot_.bodies[b];
  const bool together = one.module == other.module;
  return of_scenario_.has(a, b) || (together && of_type_[robot_.modules[one.module].type].has(one.type, other.type));
}

bool Meetings::operator()(std::size_t a, std::size_t b) const {
  return robot_.bodies[a].link != robot_.bodies[b].link && parents_[a] != b && parents_[b] != a && !left_out(a, b);
}

double Meetings::by_design(std::size_t a, std::size_t b) {
  const Body &one = robot_.bodies[a], &other = robot_.bodies[b];
  return one.module == other.module ? kTurned * design(robot_.modules[one.module].type).depth(one.type, other.type) : 0;
}

double Meetings::beyond(const OnHinge& pair, double angle) {
  std::optional<HingeOverlap>& overlap = overlaps_[pair.type][pair.hinge];
  if (!overlap) {
    const ModuleType& type = robot_.types[pair.type];
    const HingeType& hinge = type.hinges[pair.hinge];
    overlap.emplace(type, pair.hinge, kTurned * design(pair.type).depth(hinge.parent, hinge.child), ignored_);
  }
  return overlap->beyond(pair.sign * angle);
}

DesignOverlap& Meetings::design(std::size_t type) {
  if (!designs_[type]) designs_[type].emplace(robot_.types[type]);
  return *designs_[type];
}

}  // namespace gaitlab::report
