#include "core/laws/ground.h"

#include <string>
#include <vector>

namespace gaitlab {

Ground::Touch Ground::query(const Vec3& centre, double radius) const {
  return std::visit([&](const auto& ground) { return ground.touch(centre, radius, friction); }, shape);
}

double Ground::surface_below(const Vec3& point, double give) const {
  return std::visit([&](const auto& ground) { return ground.surface_below(point, give); }, shape);
}

double Ground::highest() const {
  return std::visit([](const auto& ground) { return ground.highest(); }, shape);
}

const GroundType& Ground::type() const { return kGroundTypes[shape.index()]; }

const Boxes& Ground::boxes() const {
  static const Boxes kNone;
  const Boxes* boxes = std::get_if<Boxes>(&shape);
  return boxes == nullptr ? kNone : *boxes;
}

Ground Ground::without_moving_boxes() const {
  Ground made = *this;
  if (Boxes* all = std::get_if<Boxes>(&made.shape); all != nullptr) {
    all->change([](std::vector<Box>& list) { std::erase_if(list, [](const Box& box) { return box.mass > 0; }); });
  }
  return made;
}

const Heightfield* Ground::relief() const { return std::get_if<Heightfield>(&shape); }

bool Ground::beyond_border(double x, double y) const {
  const Heightfield* field = std::get_if<Heightfield>(&shape);
  return field != nullptr && !field->covers(x, y);
}

std::string plane_and_box_types() {
  std::vector<std::string> names;
  for (const GroundType& type : kGroundTypes) {
    if (type.plane_and_boxes) names.emplace_back(type.name);
  }
  std::string text = names.front();
  for (std::size_t k = 1; k < names.size(); ++k) text += (k + 1 == names.size() ? " or " : ", ") + names[k];
  return text;
}

}  // namespace gaitlab
