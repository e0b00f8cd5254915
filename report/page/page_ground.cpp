#include "report/page/page_ground.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "report/page/robot_tree.h"

namespace gaitlab::report {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMostDrawn = 200;  // heights per side

/// The word in the page's data for the way in which the ground is drawn.
const char* drawn_as(const Ground& ground) { return ground.relief() != nullptr ? Heightfield::kType.name : ground.type().name; }

std::size_t height_stride(const Heightfield& field) {
  return (std::max(field.columns, field.rows()) + kMostDrawn - 1) / kMostDrawn;
}

Json heights(const Heightfield& field) {
  const std::size_t stride = height_stride(field);
  Json values = Json::array();
  std::size_t nx = 0;
  std::size_t ny = 0;
  for (std::size_t y = 0; y < field.rows(); y += stride, ++ny) {
    nx = 0;
    for (std::size_t x = 0; x < field.columns; x += stride, ++nx)
      values.push_back(std::round(1e5 * (field.origin.z() + field.values[y * field.columns + x])) / 1e5);  // rounded to 0.01 mm
  }
  const double spacing = field.spacing * static_cast<double>(stride);
  return {{"origin", {field.origin.x(), field.origin.y()}},
          {"spacing", {spacing, spacing}},
          {"nx", nx},
          {"ny", ny},
          {"heights", values}};
}

}  // namespace

std::size_t height_stride(const Ground& ground) { return ground.relief() == nullptr ? 1 : height_stride(*ground.relief()); }

Json page_ground(const Scenario& scenario, const Recording& r) {
  const Ground& ground = scenario.ground;
  Json boxes = Json::array();
  for (std::size_t b = 0; b < ground.boxes().size(); ++b) {
    const Box& box = ground.boxes()[b];
    const bool moves = !r.series(fmt::format("box.{}.x", b)).empty();
    boxes.push_back(
        {{"pose", json_of(Pose{box.R, box.center})}, {"size", json_of(box.size)}, {"moves", moves ? Json(b) : Json(-1)}});
  }
  const Heightfield* relief = ground.relief();
  return {{"kind", drawn_as(ground)},
          {"height", 0},
          {"friction", ground.exists() ? Json(ground.friction) : Json()},
          {"boxes", boxes},
          {"heightfield", relief == nullptr ? Json() : heights(*relief)}};
}

}  // namespace gaitlab::report
