#include "core/scenario/ground_section.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <limits>

#include "core/settings/grid.h"
#include "core/settings/text_file.h"
#include "core/settings/wording.h"

namespace gaitlab {
namespace {

constexpr Spec kHeights{"m", -1e6, 1e6, "Heights, a row for each y, upwards; instead of `file`."};
constexpr std::size_t kMostValues = 40000;  // a resolved scenario holds them in full, and is at most 1 MB

struct BoxFields {
  Box box;
  void fields(Fields& f) {
    f.vector("center", span_of(box.center), {"m", -1e6, 1e6, "Middle of the box, world."});
    f.vector("size", span_of(box.size),
             {"m", kPositive, 1e6, "Lengths of the edges of the box, along its own axes; required."});
    f.vector("rpy", span_of(box.rpy), {"rad", -100, 100, "Orientation of the box in the world: roll, pitch, yaw."});
    f.number("friction", box.friction, {"", 0, 100, "Coulomb coefficient f; default: the ground's."});
    f.number("mass", box.mass, {"kg", 0, 1e6, "Mass of the box; 0: it never moves; more than 0 needs contact.law: bullet."});
  }
};

struct HeightfieldFields {
  Heightfield& field;
  bool writing;
  void fields(Fields& f) {
    std::string file;  // read by finish_ground
    if (!writing) f.text("file", file, "Text file with the heights: a row per line, numbers separated by commas or blanks.");
    Rows rows;
    for (std::size_t i = 0; i < field.rows(); ++i) {
      const auto first = field.values.begin() + static_cast<std::ptrdiff_t>(i * field.columns);
      rows.emplace_back(first, first + static_cast<std::ptrdiff_t>(field.columns));
    }
    f.rows("values", rows, kHeights);
    f.vector("origin", span_of(field.origin), {"m", -1e6, 1e6, "Where the first height of the first row is, world."});
    f.number("spacing", field.spacing, {"m", 1e-6, 1e6, "Distance between neighbouring heights, in x and in y."});
    set(rows);
  }
  void set(const Rows& rows) const {
    field.values.clear();
    for (const std::vector<double>& row : rows) field.values.insert(field.values.end(), row.begin(), row.end());
    field.columns = rows.empty() ? 0 : rows[0].size();
  }
};

void finish_boxes(const Node& section, Scenario& scenario, Problems& problems) {
  const Node* list = section.find("boxes");
  std::vector<Box>& boxes = scenario.ground.boxes;
  if (list == nullptr || (list->kind == Node::Kind::list && list->items.empty())) {
    problems.add(list != nullptr ? list->place : section.place,
                 "a ground of type boxes needs some; expected boxes: [{center, size}]");
    return;
  }
  for (std::size_t i = 0; i < boxes.size() && i < list->items.size(); ++i) {
    const Node& node = list->items[i];
    if (node.kind != Node::Kind::map) continue;
    if (node.find("friction") == nullptr) boxes[i].friction = scenario.ground.friction;
    if (node.find("size") == nullptr)
      problems.add(node.place, fmt::format("boxes[{}] has no size; expected size: [x, y, z]", i));
    if (boxes[i].mass > 0 && !scenario.contact.moves_boxes()) {
      problems.add(
          node.find("mass")->place,
          fmt::format("boxes[{}] has a mass, and contact.law: penalty moves no box; expected mass: 0, or contact.law: bullet",
                      i));
    }
  }
}

void finish_field(const Node& section, const std::string& folder, Heightfield& field, Problems& problems) {
  const Node* map = section.find("heightfield");
  const Node* file = map == nullptr ? nullptr : map->find("file");
  const Node* values = map == nullptr ? nullptr : map->find("values");
  const SourceLocation place = map == nullptr ? section.place : map->place;
  if (map != nullptr && map->kind != Node::Kind::map) return;
  if (file == nullptr && values == nullptr) {
    problems.add(place, "a heightfield needs heights; expected heightfield: {values: [[...], [...]]} or {file: PATH}");
    return;
  }
  SourceLocation grid = values != nullptr ? values->place : file->place;
  if (file != nullptr && values != nullptr) {
    problems.add(file->place, "the heightfield has a file and values; expected one of them")
        .notes.emplace_back(values->place, "values is here");
    return;
  }
  const std::size_t before = problems.size();
  if (file != nullptr && file->kind == Node::Kind::scalar) {
    const std::string path = (std::filesystem::path(folder) / file->text).lexically_normal().string();
    Problems found;
    try {
      const Node node = grid_node(read_text(path, file->place), path);
      grid = node.place;
      HeightfieldFields{field, false}.set(read_rows(node, "row", kHeights, found));
    } catch (const InputError& error) {
      add_all(error, found);
    }
    add_found(found, {path, folder, "file of heights", ""}, problems);
  }
  if (problems.size() != before) return;
  const bool read = values != nullptr ? values->kind == Node::Kind::list : file->kind == Node::Kind::scalar;
  const bool wrong_rows = field.values.empty() && values != nullptr && read && !values->items.empty();  // reported already
  if (!read || wrong_rows) return;
  if (field.columns < 2 || field.rows() < 2) {
    problems.add(grid, fmt::format("the heightfield has {} rows of {}; expected at least 2 of 2", field.rows(), field.columns));
  } else if (field.values.size() > kMostValues) {
    problems.add(grid, fmt::format("the heightfield has {} heights; allowed are up to {}", field.values.size(), kMostValues));
  }
}

}  // namespace

void GroundFields::fields(Fields& f) {
  f.choice("type", ground.kind, enum_names<Ground::Kind>(),
           "plane: world z = 0, solid below; boxes: the same with boxes on it; heightfield: a surface through heights.");
  f.number("friction", ground.friction, {"", 0, 100, "Coulomb's coefficient of friction f between robot and ground."});
  if (!writing || ground.kind == Ground::Kind::boxes) {
    std::vector<BoxFields> boxes;
    for (const Box& box : ground.boxes) boxes.push_back({box});
    f.list("boxes", boxes, "Solid boxes, for type boxes. Let neighbouring boxes of different height overlap by about 1 mm.");
    ground.boxes.clear();
    for (BoxFields& one : boxes) {
      one.box.R = rpy(one.box.rpy);
      ground.boxes.push_back(one.box);
    }
  }
  if (!writing || ground.kind == Ground::Kind::heightfield) {
    HeightfieldFields field{ground.field, writing};
    f.group("heightfield", field, "A smooth surface through heights on a square grid, for type heightfield.");
  }
}

void finish_ground(const Node& section, const std::string& folder, Scenario& scenario, Problems& problems) {
  if (section.kind != Node::Kind::map) return;
  Ground& ground = scenario.ground;
  const std::string type = name_of(ground.kind);
  const Node* given = section.find("type");
  if (given != nullptr && given->text != type) return;  // unknown, and reported
  for (std::size_t i = 0; i < section.keys.size(); ++i) {
    const auto& [key, place] = section.keys[i];
    if ((key != "boxes" && key != "heightfield") || key == type) continue;
    problems.add(place, fmt::format("{} is given, but the ground is of type {}; expected type: {}", key, type, key));
  }
  if (ground.kind == Ground::Kind::boxes) finish_boxes(section, scenario, problems);
  if (ground.kind == Ground::Kind::heightfield) finish_field(section, folder, ground.field, problems);
}

}  // namespace gaitlab
