#include "report/page/page_ground.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "report/page/robot_tree.h"

namespace gaitlab::report {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMostHeights = 200;  // a side

const char* ground_name(Ground::Kind kind) {
  switch (kind) {
    case Ground::Kind::none:
      return "none";
    case Ground::Kind::plane:
      return "plane";
    case Ground::Kind::boxes:
      return "boxes";
    default:
      return "heightfield";
  }
}

Json heights(const Heightfield& field) {
  const std::size_t stride = (std::max(field.columns, field.rows()) + kMostHeights - 1) / kMostHeights;
  Json values = Json::array();
  std::size_t nx = 0;
  std::size_t ny = 0;
  for (std::size_t y = 0; y < field.rows(); y += stride, ++ny) {
    nx = 0;
    for (std::size_t x = 0; x < field.columns; x += stride, ++nx)
      values.push_back(std::round(1e5 * (field.origin.z() + field.values[y * field.columns + x])) / 1e5);  // to 0.01 mm
  }
  const double spacing = field.spacing * static_cast<double>(stride);
  return {{"origin", {field.origin.x(), field.origin.y()}},
          {"spacing", {spacing, spacing}},
          {"nx", nx},
          {"ny", ny},
          {"heights", values}};
}

}  // namespace

Json page_ground(const Scenario& scenario, const Recording& r) {
  const Ground& ground = scenario.ground;
  Json boxes = Json::array();
  for (std::size_t b = 0; b < ground.boxes.size(); ++b) {
    const Box& box = ground.boxes[b];
    const bool moves = !r.series(fmt::format("box.{}.x", b)).empty();
    boxes.push_back(
        {{"pose", json_of(Pose{box.R, box.center})}, {"size", json_of(box.size)}, {"moves", moves ? Json(b) : Json(-1)}});
  }
  const bool any = ground.kind != Ground::Kind::none;
  return {{"kind", ground_name(ground.kind)},
          {"height", 0},
          {"friction", any ? Json(ground.friction) : Json()},
          {"boxes", boxes},
          {"heightfield", ground.kind == Ground::Kind::heightfield ? heights(ground.field) : Json()}};
}

}  // namespace gaitlab::report
