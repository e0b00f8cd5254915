#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/model/principal_axes.h"
#include "core/model/solid.h"
#include "core/settings/wording.h"
#include "report/verdict/plausible/plausible_number.h"

namespace gaitlab::report {

namespace {

constexpr double kWater = 1000;  // kg/m^3

double kilo_cubed(double value) { return value * 1e9; }   // corrects a density for lengths in mm
double centi_cubed(double value) { return value * 1e6; }  // corrects a density for lengths in cm
double gram_square_mm(double value) { return value * 1e-9; }
double square_mm(double value) { return value * 1e-6; }

constexpr const char* kLengthsInMm = "are the lengths in mm";
constexpr const char* kLengthsInCm = "are the lengths in cm";
constexpr const char* kShapesInMm = "are the origins of its shapes in mm";
constexpr const char* kShapesInCm = "are the origins of its shapes in cm";

/// A body of a module type of the robot, with its map in the text of the type.
struct TypeBody {
  const ModuleType& type;
  const BodyType& body;
  const Subject::Size& size;
  const Node* map;

  [[nodiscard]] SourceLocation place(const char* key) const {
    const Node* const value = map == nullptr ? nullptr : map->find(key);
    return value != nullptr ? value->place : map != nullptr ? map->place : SourceLocation();
  }
  [[nodiscard]] std::string part() const { return type.name + "/" + body.name; }
  [[nodiscard]] std::string name() const { return fmt::format("body {} of {}", in_quotes(body.name), clipped(type.name)); }
  /// Words for the size: the shapes, or the points of a body without shapes.
  [[nodiscard]] const char* outline() const {
    return size.of_points ? "the box about its contact elements, faces and hinges" : "its shapes";
  }
  /// The ratio that is judged; 1 is usual. A box about points is a rough size, so that any ratio up to 5 becomes 1.
  [[nodiscard]] double judged(double ratio) const {
    constexpr double kRough = 5;
    return size.of_points ? std::max(1.0, ratio / kRough) : ratio;
  }
};

const Node* map_of_body(const Node& document, const std::string& name) {
  const Node* const all = document.find("bodies");
  return all == nullptr ? nullptr : all->find(name);
}

TypeBody type_body(const Subject& subject, std::size_t t, std::size_t b) {
  const Scenario& s = subject.scenario;
  const ModuleType& type = s.robot->types[t];
  return {type, type.bodies[b], subject.sizes[t][b],
          t < s.module_documents->size() ? map_of_body((*s.module_documents)[t], type.bodies[b].name) : nullptr};
}

/// Calls `use` for each body with mass and size.
template <class Use>
void each_solid_body(const Subject& subject, Use use) {
  for (std::size_t t = 0; t < subject.sizes.size(); ++t) {
    for (std::size_t b = 0; b < subject.sizes[t].size(); ++b) {
      if (subject.sizes[t][b].solid.volume > 0) use(type_body(subject, t, b));
    }
  }
}

std::vector<Finding> densities(const Subject& subject) {
  std::vector<Finding> found;
  each_solid_body(subject, [&](const TypeBody& one) {
    const double volume = one.size.solid.volume;
    const auto density = [one, mass = one.body.mass, volume](double factor) {
      return kWater * one.judged(factor * mass / volume / kWater);
    };
    const double factor = 1 / one.body.mass;
    found.push_back({one.place("mass"),
                     {one.part()},
                     fmt::format("{} has {} kg in {:.3g} cm^3{}, which is a density of {:.3g} kg/m^3", one.name(),
                                 number_text(one.body.mass), volume * 1e6,
                                 one.size.of_points ? fmt::format(" ({})", one.outline()) : "", one.body.mass / volume),
                     density(1),
                     [density, factor, mass = one.body.mass](const Slip& slip) {
                       return density(slip.input == 0 ? slip.corrected(mass) * factor : slip.corrected(1));
                     },
                     {},
                     {{one.body.mass, "kg"}, {}}});
  });
  return found;
}

/// A hinge at one of its two bodies.
struct HingeEnd {
  TypeBody one;
  const HingeType& hinge;
  bool parent;
  const Node* map;  ///< map of the hinge in the module type
  [[nodiscard]] Vec3 origin() const { return parent ? hinge.in_parent.p : Vec3::Zero(); }
  /// Largest edge of any single shape, regardless of its place.
  [[nodiscard]] double edge() const {
    double largest = 0;
    for (const Shape& shape : one.size.shapes) largest = std::max(largest, Subject::Size{{shape}}.largest_edge());
    return largest;
  }
};

/// Distance of the hinge's axis from the convex hull of the body's shapes, m, with the origins of the hinge and of the shapes
/// multiplied by factors.
double from_axis(const HingeEnd& end, double of_hinge, double of_shapes) {
  std::vector<Shape> shapes = end.one.size.shapes;
  for (Shape& shape : shapes) shape.in_body.p *= of_shapes;
  const Vec3 origin = of_hinge * end.origin();
  const Vec3 axis = end.parent ? Vec3(end.hinge.in_parent.R * end.hinge.axis) : end.hinge.axis;
  const auto [low, high] = bounds(shapes);
  const Vec3 nearest =
      origin + axis * axis.dot((low + high) / 2 - origin);  // point of the axis nearest to the middle of the shapes
  return std::min(outside_hull(shapes, nearest), outside_hull(shapes, origin));
}

Finding hinge_end(const HingeEnd& end) {
  const TypeBody& one = end.one;
  double farthest_shape = 0;  // distance from the origin of the body
  for (const Shape& shape : one.size.shapes) farthest_shape = std::max(farthest_shape, shape.in_body.p.norm());
  const double edge = end.edge();
  const double away = from_axis(end, 1, 1);
  const Node* const origin = end.map == nullptr ? nullptr : end.map->find("origin");
  const bool at_hinge = origin != nullptr && end.origin().norm() > farthest_shape;
  return {at_hinge ? origin->place : one.place("shape"),
          {one.part()},
          fmt::format("hinge {} of {} is {:.3g} m from the shapes of body {}, whose largest edge is {:.3g} m",
                      in_quotes(end.hinge.name), clipped(one.type.name), away, in_quotes(one.body.name), edge),
          away / edge,
          [end, edge](const Slip& slip) {
            const double factor = slip.corrected(1);
            return (slip.input == 0 ? from_axis(end, factor, 1) : from_axis(end, 1, factor)) / edge;
          },
          [farthest_shape, edge, from = end.origin().norm()](const Slip& slip) {
            return slip.corrected(slip.input == 0 ? from : farthest_shape) >= kLeastShare * edge;
          },
          {{}, {}}};
}

std::vector<Finding> hinges(const Subject& subject) {
  const Scenario& s = subject.scenario;
  std::vector<Finding> found;
  for (std::size_t t = 0; t < subject.sizes.size(); ++t) {
    for (const HingeType& hinge : s.robot->types[t].hinges) {
      const Node* const map =
          t < s.module_documents->size() ? entry_map((*s.module_documents)[t], "hinges", "name", hinge.name) : nullptr;
      for (const std::size_t body : {hinge.parent, hinge.child}) {
        if (subject.sizes[t][body].of_points || subject.sizes[t][body].shapes.empty()) continue;
        found.push_back(hinge_end({type_body(subject, t, body), hinge, body == hinge.parent, map}));
      }
    }
  }
  return found;
}

std::vector<Finding> centres(const Subject& subject) {
  constexpr double kRough = 100;  // a body may extend by an edge beyond the box about its points
  std::vector<Finding> found;
  each_solid_body(subject, [&](const TypeBody& one) {
    const double edge = one.size.largest_edge();
    const double scale = one.size.of_points ? kRough * edge : edge;
    const double outside = outside_hull(one.size.shapes, one.body.com);
    const auto again = [shapes = one.size.shapes, com = one.body.com, scale](const Slip& slip) {
      return outside_hull(shapes, slip.corrected(1) * com) / scale;
    };
    const auto sensible = [com = one.body.com.norm(), edge](const Slip& slip) {
      return std::abs(slip.corrected(com)) >= kLeastShare * edge;
    };
    found.push_back({one.place("com"),
                     {one.part()},
                     fmt::format("com [{}, {}, {}] of {} is {:.3g} m outside {}, whose largest edge is {:.3g} m",
                                 number_text(one.body.com.x()), number_text(one.body.com.y()), number_text(one.body.com.z()),
                                 one.name(), outside, one.outline(), edge),
                     outside / scale,
                     again,
                     sensible,
                     {{}}});
  });
  return found;
}

Vec3 sorted_moments(const Mat3& inertia) {
  Vec3 moments;
  principal_axes(inertia, moments);
  std::sort(moments.begin(), moments.end());
  return moments;
}

/// Ratio of a principal moment to that of the shapes. The largest two are compared, and the ratio is the one farther from 1.
double worst_ratio(const Vec3& moments, const Vec3& of_shapes, double factor) {
  const double a = factor * moments[1] / of_shapes[1];
  const double b = factor * moments[2] / of_shapes[2];
  return std::abs(std::log(a)) > std::abs(std::log(b)) ? a : b;
}

std::vector<Finding> moments(const Subject& subject) {
  std::vector<Finding> found;
  each_solid_body(subject, [&](const TypeBody& one) {
    if (one.body.volume > 0) return;  // the inertia is that of the shapes
    const Vec3 stated = sorted_moments(one.body.inertia);
    const Vec3 of_shapes = sorted_moments(one.size.solid.inertia(one.body.mass));
    const auto ratio = [one, stated, of_shapes](double factor) { return one.judged(worst_ratio(stated, of_shapes, factor)); };
    found.push_back({one.place("inertia"),
                     {one.part()},
                     fmt::format("{} has principal moments up to {:.3g} kg m^2, but at uniform density {} would have up to "
                                 "{:.3g} kg m^2",
                                 one.name(), stated[2], one.outline(), of_shapes[2]),
                     ratio(1),
                     [ratio](const Slip& slip) { return ratio(slip.corrected(1)); },
                     {},
                     {{}}});
  });
  return found;
}

std::vector<Finding> faces(const Subject& subject) {
  const Scenario& s = subject.scenario;
  std::vector<Finding> found;
  for (std::size_t t = 0; t < s.robot->types.size(); ++t) {
    const ModuleType& type = s.robot->types[t];
    for (const FaceType& face : type.faces) {
      const std::vector<Shape>& shapes = type.bodies[face.body].shapes;
      if (shapes.empty()) continue;
      const auto [low, high] = bounds(shapes);
      const double edge = (high - low).maxCoeff();
      const Node* const map = t < s.module_documents->size()
                                  ? entry_map((*s.module_documents)[t], "faces", "id", std::to_string(face.id))
                                  : nullptr;
      const Node* const origin = map == nullptr ? nullptr : map->find("origin");
      const auto away = [shapes, at = face.origin, edge](double factor) {
        return std::abs(distance(shapes, factor * at)) / edge;
      };
      found.push_back(
          {origin == nullptr ? SourceLocation() : origin->place,
           {type.name + "/" + type.bodies[face.body].name},
           fmt::format("face {} of {} is {:.3g} m from the surface of body {}, whose largest edge is {:.3g} m", face.id,
                       clipped(type.name), away(1) * edge, in_quotes(type.bodies[face.body].name), edge),
           away(1),
           [away](const Slip& slip) { return away(slip.corrected(1)); },
           [from = face.origin.norm(), edge](const Slip& slip) { return slip.corrected(from) >= kLeastShare * edge; },
           {{}}});
    }
  }
  return found;
}

/// Calls `use` with each type and body of the robot that has a mass.
template <class Use>
void each_heavy_body(const Scenario& s, Use use) {
  for (const ModuleType& type : s.robot->types) {
    for (std::size_t b = 0; b < type.bodies.size(); ++b) {
      if (type.bodies[b].mass > 0) use(type, b);
    }
  }
}

/// Diagonal of the box about the shapes, contact elements, faces, hinges and centre of mass of a body, m.
double body_extent(const ModuleType& type, std::size_t b) {
  const BodyType& body = type.bodies[b];
  auto [low, high] = box_of_points(type, b);
  if (!body.shapes.empty()) {
    const auto [least, most] = bounds(body.shapes);
    low = low.cwiseMin(least);
    high = high.cwiseMax(most);
  }
  return (high.cwiseMax(body.com) - low.cwiseMin(body.com)).norm();
}

/// Moments of inertia above that of the whole mass at twice the body's extent from its centre.
std::vector<Impossible> impossible_moments(const Scenario& s) {
  constexpr double kAway = 2;
  std::vector<Impossible> found;
  each_heavy_body(s, [&](const ModuleType& type, std::size_t b) {
    const BodyType& body = type.bodies[b];
    if (body.volume > 0) return;  // the inertia is that of the shapes
    const double size = body_extent(type, b);
    const double largest = sorted_moments(body.inertia)[2];
    const double times = largest / (body.mass * kAway * size * kAway * size);
    if (!(size > 0) || !(times > 1)) return;
    found.push_back({times, fmt::format("body {} of {} ({} kg) has a moment of inertia of {:.3g} kg m^2, as much as a ring of "
                                        "radius {:.2g} m, but the body's extent is {:.2g} m",
                                        in_quotes(body.name), clipped(type.name), number_text(body.mass), largest,
                                        std::sqrt(largest / body.mass), size)});
  });
  return found;
}

/// True if the shapes represent the whole body: its contact elements, faces, hinges and centre of mass are within the box about
/// the shapes.
bool shapes_are_all(const ModuleType& type, std::size_t b) {
  const BodyType& body = type.bodies[b];
  if (body.shapes.empty() || body.shapes.size() > kMostShapes) return false;
  const auto [least, most] = bounds(body.shapes);
  auto [low, high] = box_of_points(type, b);
  low = low.cwiseMin(body.com);
  high = high.cwiseMax(body.com);
  const double room = kLeastShare * (most - least).norm();
  return (low - least).minCoeff() >= -room && (most - high).minCoeff() >= -room;
}

/// Densities that no metal has.
std::vector<Impossible> impossible_densities(const Scenario& s) {
  constexpr double kMost = 23000;  // kg/m^3; osmium: 22590
  std::vector<Impossible> found;
  each_heavy_body(s, [&](const ModuleType& type, std::size_t b) {
    const BodyType& body = type.bodies[b];
    if (!shapes_are_all(type, b)) return;
    double least = body.volume;  // lower bound for the volume of the union, which takes time to compute
    for (const Shape& shape : body.shapes) least = std::max(least, solid(shape).volume);
    if (!(body.mass > kMost * least)) return;
    const double volume = body.volume > 0 ? body.volume : united(body.shapes).volume;
    const double density = body.mass / volume;
    if (!(density > kMost)) return;
    found.push_back({density / kMost, fmt::format("body {} of {} has {} kg in {:.3g} cm^3: {:.3g} kg/m^3, but no metal has "
                                                  "more than {:g} kg/m^3",
                                                  in_quotes(body.name), clipped(type.name), number_text(body.mass),
                                                  volume * 1e6, density, kMost)});
  });
  return found;
}

}  // namespace

std::vector<PlausibleNumber> plausible_bodies() {
  return {
      {"density",
       5,
       20000,
       "expected 5 to 20000 kg/m^3, from a hollow shell to tungsten",
       {{"is the mass in g", of_milli}, {kLengthsInMm, kilo_cubed, 1}, {kLengthsInCm, centi_cubed, 1}},
       {},
       densities,
       false,
       50,
       impossible_densities},
      {"hinge",
       0,
       4,
       "expected at most four times that edge",
       {{"is origin in mm", of_milli}, {"is origin in cm", of_centi}, {kShapesInMm, of_milli, 1}, {kShapesInCm, of_centi, 1}},
       {kLengthsInMm, kLengthsInCm},
       hinges},
      {"com",
       0,
       0.01,
       "expected a point in their convex hull",
       {{"has it the wrong sign", turned_round}, {"is it in mm", of_milli}, {"is it in cm", of_centi}},
       {kShapesInMm, kShapesInCm},
       centres},
      {"moments",
       0.05,
       5,
       "expected 0.05 to 5 times the moments at uniform density",
       {{"is it in kg cm^2", of_square_cm},
        {"is it in kg mm^2", square_mm},
        {"is it in g cm^2", of_gram_square_cm},
        {"is it in g mm^2", gram_square_mm},
        {"is it in g m^2", of_milli}},
       {"density"},
       moments,
       false,
       0,
       impossible_moments},
      {"face",
       0,
       0.25,
       "expected at most a quarter of that edge",
       {{"is origin in mm", of_milli}, {"is origin in cm", of_centi}},
       {kLengthsInMm, kLengthsInCm, kShapesInMm, kShapesInCm},
       faces},
  };
}

}  // namespace gaitlab::report
