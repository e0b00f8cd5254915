#include "core/robot_files/build_file.h"

#include <fmt/format.h>

#include <array>
#include <optional>

#include "core/settings/reader.h"

namespace gaitlab {
namespace {

constexpr const char* kRow = "child_face child_module parent_face parent_module orientation";

/// The five columns of a row in order, as fields.
struct DockFields {
  std::array<std::int64_t, 5> columns = {};

  static constexpr std::array<const char*, 5> kKeys{"child_face", "child_module", "parent_face", "parent_module",
                                                    "orientation"};
  static constexpr std::array<const char*, 5> kAbout{"Face of the child.", "Module that is docked.", "Face of the parent.",
                                                     "Module to which the child is docked.",
                                                     "Quarter turns about the child's face normal."};

  static Spec spec(std::size_t column) {
    // Orientation (0 to 3), faces and modules are checked against the robot during the assembly.
    return {"", 0, static_cast<double>(kMaxModule), kAbout[column]};
  }
  void fields(Fields& f) {
    for (std::size_t i = 0; i < columns.size(); ++i) f.integer(kKeys[i], columns[i], spec(i));
  }
  [[nodiscard]] Dock dock(const SourceLocation& place) const {
    std::array<int, 5> c{};
    for (std::size_t i = 0; i < c.size(); ++i) c[i] = static_cast<int>(columns[i]);
    return {c[0], c[1], c[2], c[3], c[4], place};
  }
};

/// Dock from the five numbers of a row.
std::optional<Dock> read_row(const std::vector<Node>& items, const SourceLocation& place, Problems& problems) {
  if (items.size() != 5) {
    problems.add(place,
                 fmt::format("the row has {} number{}; expected 5: {}", items.size(), items.size() == 1 ? "" : "s", kRow));
    return {};
  }
  Node row{Node::Kind::map, place};
  row.items = items;
  for (std::size_t i = 0; i < 5; ++i) row.keys.emplace_back(DockFields::kKeys[i], items[i].place);
  const std::size_t before = problems.size();
  DockFields fields;
  Reader reader(row, "row", problems, nullptr);
  fields.fields(reader);
  if (problems.size() != before) return {};
  return fields.dock(place);
}

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

/// Words of a line, without its comment, each with its place.
std::vector<Node> words(const std::string& text, SourceLocation place) {
  std::vector<Node> out;
  bool inside = false;
  for (std::size_t i = 0; i < text.size() && text[i] != '#'; ++i) {
    const bool blank = is_blank(text[i]);
    if (!blank && !inside) {
      place.column = static_cast<int>(i) + 1;
      out.push_back({Node::Kind::scalar, place});
    }
    inside = !blank;
    if (inside) out.back().text += text[i];
  }
  return out;
}

std::optional<Dock> read_dock(const Node& node, std::size_t index, Problems& problems) {
  if (node.kind == Node::Kind::list) return read_row(node.items, node.place, problems);
  if (node.kind != Node::Kind::map) {
    problems.add(node.place, fmt::format("docks[{}] is {}; expected five numbers: [{}]", index, found(node), kRow));
    return {};
  }
  const std::size_t before = problems.size();
  DockFields fields;
  Reader reader(node, "docks", problems, nullptr);
  fields.fields(reader);
  reader.require({"child_face", "child_module", "parent_face", "parent_module", "orientation"});
  reader.finish();
  if (problems.size() != before) return {};
  return fields.dock(node.place);
}

}  // namespace

std::vector<Dock> read_build(const std::string& text, const std::string& file, Problems& problems) {
  std::vector<Dock> docks;
  SourceLocation place{file, 1, 1};
  for (std::size_t start = 0; start < text.size(); ++place.line) {
    const std::size_t end = std::min(text.find('\n', start), text.size());
    const std::vector<Node> row = words(text.substr(start, end - start), place);
    if (!row.empty()) {
      if (std::optional<Dock> dock = read_row(row, row[0].place, problems)) docks.push_back(std::move(*dock));
    }
    start = end + 1;
  }
  return docks;
}

std::vector<Dock> read_docks(const Node& node, Problems& problems) {
  std::vector<Dock> docks;
  if (node.kind != Node::Kind::list) {
    problems.add(node.place, fmt::format("docks is {}; expected a list of rows [{}]", found(node), kRow));
    return docks;
  }
  for (std::size_t i = 0; i < node.items.size(); ++i) {
    if (std::optional<Dock> dock = read_dock(node.items[i], i, problems)) docks.push_back(std::move(*dock));
  }
  return docks;
}

}  // namespace gaitlab
