#include "core/scenario/ground_section.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>
#include <variant>

#include "core/laws/heap.h"
#include "core/scenario/height_file.h"
#include "core/settings/grid.h"
#include "core/settings/wording.h"

namespace gaitlab {
namespace {

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
    const bool from_file = !field.source.file.empty();
    if (!writing || from_file) {  // finish_ground() reads the values
      f.text("file", field.source.file,
             "File with the heights: text, a row per line, numbers separated by commas or blanks; a matrix of numpy.save "
             "(.npy: float32, float64 or integers, in C order), also compressed (.npy.gz); a PNG of 16 bit grey values. Up to "
             "4096 x "
             "4096; text, 4 MB. "
             "The first row has the least y.");
      f.number("scale", field.source.scale,
               {"m", 1e-12, 1e6, "Metres per unit of the numbers in `file`; a PNG needs it. Default: 1."});
      f.text("hash", field.source.hash,
             "Hash of the heights; a file with other heights is refused. Runs with more than 40000 heights record it and store "
             "the heights in a file of the run folder.");
    }
    if (!writing || !from_file) {
      Rows rows;
      for (std::size_t i = 0; i < field.rows(); ++i) {
        const auto first = field.values.begin() + static_cast<std::ptrdiff_t>(i * field.columns);
        rows.emplace_back(first, first + static_cast<std::ptrdiff_t>(field.columns));
      }
      f.rows("values", rows, kHeights);
      if (!writing) set(rows);
    }
    f.vector("origin", span_of(field.origin), {"m", -1e6, 1e6, "Position of the first height of the first row, world."});
    f.number("spacing", field.spacing, {"m", 1e-6, 1e6, "Distance between neighbouring heights, in x and in y."});
  }
  void set(const Rows& rows) const {
    std::vector<double> heights;
    for (const std::vector<double>& row : rows) heights.insert(heights.end(), row.begin(), row.end());
    field.values = std::move(heights);
    field.columns = rows.empty() ? 0 : rows[0].size();
  }
};

/// Visits the settings of a type of ground, under the name of the type as key. A type without settings has no overload.
/// `writing` is true if the whole ground is of this type and is being written.
template <class Shape>
void shape_fields(Fields&, Shape&, bool /*writing*/) {}

void shape_fields(Fields& f, Boxes& boxes, bool writing) {
  std::vector<BoxFields> each;
  for (const Box& box : boxes) each.push_back({box});
  f.list("boxes", each, "Solid boxes, for type boxes. Let neighbouring boxes of different height overlap by about 1 mm.");
  std::vector<Box> read;
  for (BoxFields& one : each) {
    one.box.R = rpy(one.box.rpy);
    read.push_back(one.box);
  }
  if (!writing) boxes = std::move(read);
}

void shape_fields(Fields& f, Heightfield& field, bool writing) {
  HeightfieldFields fields{field, writing};
  f.group("heightfield", fields, "A smooth surface through heights on a square grid, for type heightfield.");
}

/// Inputs of the checks that require the whole section.
struct GroundNodes {
  const Node& node;
  const std::string& folder;
  const Scenario& scenario;
  Problems& problems;
};

template <class Shape>
void finish_shape(Shape&, const GroundNodes&) {}

/// Adds a problem if a box is part of a heap. Every query of an element there would look at all boxes of the heap, and a solver
/// of moving boxes would look at all pairs of boxes.
void check_heap(const Boxes& boxes, const std::vector<Node>& nodes, Problems& problems) {
  const std::optional<std::size_t> i = first_in_heap(boxes);
  if (!i || *i >= nodes.size()) return;
  const Vec3& at = boxes[*i].center;
  problems.add(
      nodes[*i].place,
      fmt::format("more than {} boxes contain the centre of boxes[{}], [{:g}, {:g}, {:g}]; leave out boxes within others",
                  kMostInOnePlace, *i, at.x(), at.y(), at.z()));
}

void finish_shape(Boxes& ground, const GroundNodes& section) {
  const Scenario& scenario = section.scenario;
  Problems& problems = section.problems;
  const Node* list = section.node.find("boxes");
  std::vector<Box> boxes = ground.list();
  if (list == nullptr || (list->kind == Node::Kind::list && list->items.empty())) {
    problems.add(list != nullptr ? list->place : section.node.place,
                 "a ground of type boxes needs at least one box; expected boxes: [{center, size}]");
    return;
  }
  for (std::size_t i = 0; i < boxes.size() && i < list->items.size(); ++i) {
    const Node& node = list->items[i];
    if (node.kind != Node::Kind::map) continue;
    if (node.find("friction") == nullptr) boxes[i].friction = scenario.ground.friction;
    if (node.find("size") == nullptr)
      problems.add(node.place, fmt::format("boxes[{}] has no size; expected size: [x, y, z]", i));
    if (boxes[i].mass > 0 && !scenario.contact.model().moves_boxes) {
      problems.add(
          node.find("mass")->place,
          fmt::format("boxes[{}] has a mass, but contact.law: penalty moves no box; expected mass: 0, or contact.law: bullet",
                      i));
    }
  }
  ground = std::move(boxes);
  check_heap(ground, list->items, problems);
}

void finish_shape(Heightfield& field, const GroundNodes& section) {
  Problems& problems = section.problems;
  const Node* map = section.node.find("heightfield");
  const Node* file = map == nullptr ? nullptr : map->find("file");
  const Node* values = map == nullptr ? nullptr : map->find("values");
  const SourceLocation place = map == nullptr ? section.node.place : map->place;
  if (map != nullptr && map->kind != Node::Kind::map) return;
  if (file == nullptr && values == nullptr) {
    problems.add(place, "a heightfield needs heights; expected heightfield: {values: [[...], [...]]} or {file: PATH}");
    return;
  }
  if (file != nullptr && values != nullptr) {
    problems.add(file->place, "the heightfield has a file and values; expected one of them")
        .notes.emplace_back(values->place, "values is here");
    return;
  }
  for (const char* key : {"scale", "hash"}) {
    if (const Node* given = map->find(key); given != nullptr && file == nullptr) {
      problems.add(given->place, fmt::format("{} belongs to a file, but the heights are given as values; remove {}", key, key));
    }
  }
  const std::size_t before = problems.size();
  SourceLocation grid = values != nullptr ? values->place : file->place;
  if (file != nullptr && file->kind == Node::Kind::scalar) grid = read_height_file(*map, section.folder, field, problems);
  if (problems.size() != before) return;
  const bool read = values != nullptr ? values->kind == Node::Kind::list : file->kind == Node::Kind::scalar;
  const bool wrong_rows = field.values.empty() && values != nullptr && read && !values->items.empty();  // already reported
  if (!read || wrong_rows) return;
  if (field.columns < 2 || field.rows() < 2) {
    problems.add(grid, fmt::format("the heightfield has {} rows of {} heights; expected at least 2 rows of 2", field.rows(),
                                   field.columns));
  } else if (values != nullptr && field.values.size() > kMostWritten) {
    problems.add(grid, fmt::format("the heightfield has {} heights; expected at most {}, or a file, which can hold more",
                                   field.values.size(), kMostWritten));
  }
}

/// Calls `visit` once for each type of ground, in the order of Ground::Shape, with the value of the ground's own type and
/// default values of all other types.
template <class Visit, std::size_t... kIndex>
void visit_ground_types(const Ground& ground, const Visit& visit, std::index_sequence<kIndex...>) {
  const auto one = [&]<std::size_t k>(std::integral_constant<std::size_t, k>) {
    const auto* own = std::get_if<k>(&ground.shape);
    visit(k, own == nullptr ? std::variant_alternative_t<k, Ground::Shape>() : *own);
  };
  (one(std::integral_constant<std::size_t, kIndex>()), ...);
}

constexpr auto kGroundNames = [] {
  std::array<const char*, kGroundTypes.size()> names{};
  for (std::size_t k = 0; k < names.size(); ++k) names[k] = kGroundTypes[k].name;
  return names;
}();

const char* about_ground_types() {
  static const std::string kText = [] {
    std::vector<std::string> all;
    for (const GroundType& type : kGroundTypes) {
      if (*type.about != 0) all.push_back(fmt::format("{}: {}", type.name, type.about));
    }
    return fmt::format("{}.", fmt::join(all, "; "));
  }();
  return kText.c_str();
}

}  // namespace

void GroundFields::fields(Fields& f) {
  std::size_t type = ground.shape.index();
  f.choice("type", type, kGroundNames, about_ground_types());
  f.number("friction", ground.friction, {"", 0, 100, "Coulomb's coefficient of friction f between robot and ground."});
  const Ground before = ground;
  const auto one = [&](std::size_t k, auto shape) {
    if (writing && k != type) return;
    shape_fields(f, shape, writing);
    if (!writing && k == type) ground.shape = std::move(shape);
  };
  visit_ground_types(before, one, std::make_index_sequence<kGroundTypes.size()>());
}

void finish_ground(const Node& section, const std::string& folder, Scenario& scenario, Problems& problems) {
  if (section.kind != Node::Kind::map) return;
  const std::string type = scenario.ground.type().name;
  const Node* given = section.find("type");
  if (given != nullptr && given->text != type) return;  // the type is unknown, which has been reported
  for (const auto& entry : section.keys) {
    const std::string& key = entry.first;
    const auto has_key = [&](const GroundType& other) { return other.has_settings && key == other.name; };
    if (key == type || std::ranges::none_of(kGroundTypes, has_key)) continue;
    problems.add(entry.second, fmt::format("{} is given, but the ground is of type {}; expected type: {}", key, type, key));
  }
  const GroundNodes read{section, folder, scenario, problems};
  std::visit([&](auto& shape) { finish_shape(shape, read); }, scenario.ground.shape);
}

}  // namespace gaitlab
