#include "interchange/urdf_mass.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "core/model/possible_inertia.h"
#include "core/model/solid.h"
#include "core/settings/wording.h"

namespace gaitlab::interchange {

namespace {

constexpr double kWater = 1000;    // kg/m^3
constexpr double kRaised = 0.01;   // share of the largest moment by which the smallest may be raised
constexpr double kLeast = 1e-9;    // m, of a shape
constexpr double kFarthest = 1e6;  // m, of an origin or a shape
constexpr double kMostMass = 1e9;  // kg

std::string moments_text(const Vec3& moments) {
  return fmt::format("{:.4g}, {:.4g}, {:.4g} kg m^2", moments[0], moments[1], moments[2]);
}

std::span<const double> sizes_of(const Shape& shape) {
  const std::size_t number = shape.kind == Shape::Kind::box || shape.kind == Shape::Kind::hull ? 3
                             : shape.kind == Shape::Kind::sphere                               ? 1
                                                                                               : 2;
  return {shape.size.data(), number};
}

bool usable_size(double x) { return x >= kLeast && x <= kFarthest; }

/// True if the inertia of the shapes can be computed.
bool usable(const std::vector<Shape>& shapes) {
  return !shapes.empty() && shapes.size() <= kMostShapes &&
         std::ranges::all_of(shapes, [](const Shape& shape) { return std::ranges::all_of(sizes_of(shape), usable_size); });
}

bool far(const urdf::Vector3& p) { return !(std::hypot(p.x, p.y, p.z) <= kFarthest); }

/// Repairs the inertia of one link, with a note.
void repair_inertia(RobotMass& part, const UrdfText& urdf, std::vector<RobotNote>& notes) {
  if (!(part.mass > 0) || !part.inertia.allFinite()) return;
  const Principal before = principal(part.inertia);
  if (before.possible()) return;
  const Vec3& is = before.moments;
  const double missing = is[2] - is[0] - is[1];
  std::string how;
  if (before.positive() && missing <= kRaised * is[2]) {
    Vec3 raised = is;
    raised[0] += missing;
    part.inertia = before.axes * raised.asDiagonal() * before.axes.transpose();
    how = "the smallest is raised";
  } else {
    part.inertia = usual_inertia(part.mass, part.shapes);
    how = usable(part.shapes) ? "those of its shapes are taken" : "those of a ball of water are taken";
  }
  notes.push_back({urdf.place("link", part.link),
                   fmt::format("no body has the principal moments {} of link {}; {}: {}", moments_text(is),
                               in_quotes(part.link), how, moments_text(principal(part.inertia).moments)),
                   true});
}

}  // namespace

bool has_mass(const urdf::Link& link) { return link.inertial != nullptr && link.inertial->mass != 0; }

void check_numbers(const urdf::Link& link, const std::vector<Shape>& shapes, const UrdfText& urdf, Problems& problems) {
  const auto refuse = [&](const char* tag, const std::string& name, const std::string& text) {
    problems.add(urdf.place(tag, name), fmt::format("{} {} has {}", tag, in_quotes(name), text));
  };
  const double mass = link.inertial == nullptr ? 0 : link.inertial->mass;
  if (mass < 0) {
    refuse("link", link.name,
           fmt::format("mass {} kg; expected more than 0 (only a link between two hinges may have none)", number_text(mass)));
  }
  if (mass > kMostMass) refuse("link", link.name, fmt::format("mass {} kg; expected at most 1e9 kg", number_text(mass)));
  const std::string within = fmt::format("expected at most {} m", number_text(kFarthest));
  if (mass != 0 && far(link.inertial->origin.position))
    refuse("link", link.name, "its centre of mass too far from its origin; " + within);
  for (const urdf::JointSharedPtr& joint : link.child_joints) {
    if (far(joint->parent_to_joint_origin_transform.position))
      refuse("joint", joint->name, "its origin too far from that of its parent; " + within);
  }
  for (const Shape& shape : shapes) {
    if (!(shape.in_body.p.norm() <= 2 * kFarthest)) refuse("link", link.name, "a shape too far from its origin; " + within);
    for (const double size : sizes_of(shape)) {
      if (size > 0 && !usable_size(size))
        refuse("link", link.name, fmt::format("a shape of {} m; expected 1e-9 m to 1e6 m", number_text(size)));
    }
  }
}

Mat3 usual_inertia(double mass, const std::vector<Shape>& shapes) {
  if (usable(shapes)) return united(shapes).inertia(mass);
  const double radius = std::cbrt(3 * mass / (4 * std::numbers::pi * kWater));
  return 0.4 * mass * radius * radius * Mat3::Identity();
}

void repair_inertias(std::vector<RobotMass>& parts, const UrdfText& urdf, std::vector<RobotNote>& notes) {
  const RobotMass whole = united_mass(parts);
  if (!(whole.mass > 0) || !whole.inertia.allFinite() || principal(whole.inertia).possible()) return;
  for (RobotMass& part : parts) repair_inertia(part, urdf, notes);
}

}  // namespace gaitlab::interchange
