#include "interchange/urdf_mass.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/model/possible_inertia.h"
#include "core/model/solid.h"
#include "core/settings/wording.h"

namespace gaitlab::interchange {

namespace {

constexpr double kWater = 1000;   // kg/m^3
constexpr double kRaised = 0.01;  // share of the largest moment by which the smallest may be raised
constexpr double kLeast = 1e-9;   // m; shapes of an absurd size are refused later

std::string moments_text(const Vec3& moments) {
  return fmt::format("{:.4g}, {:.4g}, {:.4g} kg m^2", moments[0], moments[1], moments[2]);
}

bool has_usable_size(const Shape& shape) {
  const std::size_t sizes = shape.kind == Shape::Kind::box ? 3 : shape.kind == Shape::Kind::sphere ? 1 : 2;
  return std::all_of(shape.size.data(), shape.size.data() + sizes, [](double x) { return x > kLeast && x < 1 / kLeast; });
}

/// Repairs the inertia of one link, with a note.
void repair_inertia(UrdfMass& part, const UrdfText& urdf, std::vector<UrdfNote>& notes) {
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
    how = part.shapes.empty() ? "those of a ball of water are taken" : "those of its shapes are taken";
  }
  notes.push_back({urdf.place("link", part.link),
                   fmt::format("no body has the principal moments {} of link {}; {}: {}", moments_text(is),
                               in_quotes(part.link), how, moments_text(principal(part.inertia).moments)),
                   true});
}

}  // namespace

bool has_mass(const urdf::Link& link) { return link.inertial != nullptr && link.inertial->mass != 0; }

UrdfMass united_mass(const std::vector<UrdfMass>& parts) {
  if (parts.size() == 1) return parts.front();
  UrdfMass whole;
  for (const UrdfMass& part : parts) {
    whole.mass += part.mass;
    whole.com += part.mass * part.com;
  }
  if (whole.mass > 0) whole.com /= whole.mass;
  for (const UrdfMass& part : parts) {
    const Vec3 d = part.com - whole.com;
    whole.inertia += part.inertia + part.mass * (d.squaredNorm() * Mat3::Identity() - d * d.transpose());
  }
  return whole;
}

Mat3 usual_inertia(double mass, const std::vector<Shape>& shapes) {
  const bool usable = !shapes.empty() && shapes.size() <= kMostShapes && std::ranges::all_of(shapes, has_usable_size);
  if (usable) return united(shapes).inertia(mass);
  const double radius = std::cbrt(3 * mass / (4 * std::numbers::pi * kWater));
  return 0.4 * mass * radius * radius * Mat3::Identity();
}

void repair_inertias(std::vector<UrdfMass>& parts, const UrdfText& urdf, std::vector<UrdfNote>& notes) {
  const UrdfMass whole = united_mass(parts);
  if (!(whole.mass > 0) || !whole.inertia.allFinite() || principal(whole.inertia).possible()) return;
  for (UrdfMass& part : parts) repair_inertia(part, urdf, notes);
}

}  // namespace gaitlab::interchange
