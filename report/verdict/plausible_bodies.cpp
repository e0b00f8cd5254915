#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/model/principal_axes.h"
#include "core/model/solid.h"
#include "core/settings/wording.h"
#include "report/verdict/plausible_number.h"

namespace gaitlab::report {

namespace {

double kilo_cubed(double value) { return value * 1e9; }   // of a density, for lengths in mm
double centi_cubed(double value) { return value * 1e6; }  // of a density, for lengths in cm
double gram_square_mm(double value) { return value * 1e-9; }
double gram_square_cm(double value) { return value * 1e-7; }
double square_mm(double value) { return value * 1e-6; }
double square_cm(double value) { return value * 1e-4; }
double turned_round(double value) { return -value; }

/// A body of a module type of the robot, with its map in the text of the type.
struct TypeBody {
  const ModuleType& type;
  const BodyType& body;
  const Solid& solid;
  const Node* map;

  [[nodiscard]] SourceLocation place(const char* key) const {
    const Node* const value = map == nullptr ? nullptr : map->find(key);
    return value != nullptr ? value->place : map != nullptr ? map->place : SourceLocation();
  }
  [[nodiscard]] std::string part() const { return type.name + "/" + body.name; }
  [[nodiscard]] std::string name() const { return fmt::format("body {} of {}", in_quotes(body.name), clipped(type.name)); }
  [[nodiscard]] double largest_edge() const {
    const auto [low, high] = bounds(body.shapes);
    return (high - low).maxCoeff();
  }
};

const Node* map_of_body(const Node& document, const std::string& name) {
  const Node* const all = document.find("bodies");
  return all == nullptr ? nullptr : all->find(name);
}

/// Calls `use` for each body with mass and shape.
template <class Use>
void each_solid_body(const Subject& subject, Use use) {
  const Scenario& s = subject.scenario;
  for (std::size_t t = 0; t < s.robot->types.size(); ++t) {
    const ModuleType& type = s.robot->types[t];
    for (std::size_t b = 0; b < type.bodies.size(); ++b) {
      if (!(subject.solids[t][b].volume > 0)) continue;
      use(TypeBody{type, type.bodies[b], subject.solids[t][b],
                   t < s.module_documents->size() ? map_of_body((*s.module_documents)[t], type.bodies[b].name) : nullptr});
    }
  }
}

std::vector<Finding> densities(const Subject& subject) {
  std::vector<Finding> found;
  each_solid_body(subject, [&](const TypeBody& one) {
    const double volume = one.solid.volume;
    found.push_back({one.place("mass"),
                     {one.part()},
                     fmt::format("{} has {} kg in {:.3g} cm^3, which is a density of {:.3g} kg/m^3", one.name(),
                                 number_text(one.body.mass), volume * 1e6, one.body.mass / volume),
                     one.body.mass / volume,
                     {},
                     {{one.body.mass, "kg"}, {}}});
  });
  return found;
}

std::vector<Finding> centres(const Subject& subject) {
  std::vector<Finding> found;
  each_solid_body(subject, [&](const TypeBody& one) {
    const double edge = one.largest_edge();
    const double outside = outside_hull(one.body.shapes, one.body.com);
    const auto again = [shapes = one.body.shapes, com = one.body.com, edge](const Slip& slip) {
      return outside_hull(shapes, slip.corrected(1) * com) / edge;
    };
    found.push_back({one.place("com"),
                     {one.part()},
                     fmt::format("com [{}, {}, {}] of {} is {:.3g} m outside its shapes, whose largest edge is {:.3g} m",
                                 number_text(one.body.com.x()), number_text(one.body.com.y()), number_text(one.body.com.z()),
                                 one.name(), outside, edge),
                     outside / edge,
                     again,
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
    const Vec3 stated = sorted_moments(one.body.inertia);
    const Vec3 of_shapes = sorted_moments(one.solid.inertia(one.body.mass));
    found.push_back(
        {one.place("inertia"),
         {one.part()},
         fmt::format("{} has principal moments up to {:.3g} kg m^2, and its shapes at uniform density {:.3g} kg m^2",
                     one.name(), stated[2], of_shapes[2]),
         worst_ratio(stated, of_shapes, 1),
         [stated, of_shapes](const Slip& slip) { return worst_ratio(stated, of_shapes, slip.corrected(1)); },
         {{}}});
  });
  return found;
}

/// The map of a face in the text of its type.
const Node* face_map(const Node& document, int id) {
  const Node* const faces = document.find("faces");
  for (std::size_t i = 0; faces != nullptr && i < faces->items.size(); ++i) {
    const Node* const number = faces->items[i].find("id");
    if (number != nullptr && number->text == std::to_string(id)) return &faces->items[i];
  }
  return nullptr;
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
      const Node* const map = t < s.module_documents->size() ? face_map((*s.module_documents)[t], face.id) : nullptr;
      const Node* const origin = map == nullptr ? nullptr : map->find("origin");
      const auto away = [shapes, at = face.origin, edge](double factor) {
        return std::abs(distance(shapes, factor * at)) / edge;
      };
      found.push_back({origin == nullptr ? SourceLocation() : origin->place,
                       {type.name + "/" + type.bodies[face.body].name},
                       fmt::format("face {} of {} is {:.3g} m from the surface of body {}, whose largest edge is {:.3g} m",
                                   face.id, clipped(type.name), away(1) * edge, in_quotes(type.bodies[face.body].name), edge),
                       away(1),
                       [away](const Slip& slip) { return away(slip.corrected(1)); },
                       {{}}});
    }
  }
  return found;
}

}  // namespace

std::vector<PlausibleNumber> plausible_bodies() {
  return {
      {"density",
       50,
       20000,
       "expected 50 to 20000 kg/m^3, from foam to tungsten",
       {{"is the mass in g", of_milli}, {"are the lengths in mm", kilo_cubed, 1}, {"are the lengths in cm", centi_cubed, 1}},
       {},
       densities},
      {"com",
       0,
       0.01,
       "expected a point in their convex hull",
       {{"has it the wrong sign", turned_round}, {"is it in mm", of_milli}, {"is it in cm", of_centi}},
       {},
       centres},
      {"moments",
       0.05,
       5,
       "expected 0.05 to 5 times that",
       {{"is it in kg cm^2", square_cm},
        {"is it in kg mm^2", square_mm},
        {"is it in g cm^2", gram_square_cm},
        {"is it in g mm^2", gram_square_mm},
        {"is it in g m^2", of_milli}},
       {"density"},
       moments},
      {"face",
       0,
       0.25,
       "expected at most a quarter of that",
       {{"is origin in mm", of_milli}, {"is origin in cm", of_centi}},
       {"are the lengths in mm", "are the lengths in cm"},
       faces},
  };
}

}  // namespace gaitlab::report
