#include "core/settings/grid.h"

#include <fmt/format.h>

#include "core/settings/reader.h"
#include "core/settings/value.h"
#include "core/settings/wording.h"

namespace gaitlab {
namespace {

std::string numbers(std::size_t n) { return fmt::format("{} number{}", n, n == 1 ? "" : "s"); }

bool separates(char c) { return c == ' ' || c == '\t' || c == '\r' || c == ','; }

/// Words of a line, without its comment. Two adjacent commas enclose an empty word.
Node row_of(const std::string& line, SourceLocation place) {
  Node row{Node::Kind::list, place};
  bool comma = false;
  for (std::size_t i = 0; i < line.size() && line[i] != '#';) {
    if (separates(line[i])) {
      place.column = static_cast<int>(i) + 1;
      if (line[i] == ',' && (comma || row.items.empty())) row.items.push_back({Node::Kind::scalar, place});
      comma = comma || line[i] == ',';
      ++i;
      continue;
    }
    place.column = static_cast<int>(i) + 1;
    Node& word = row.items.emplace_back(Node{Node::Kind::scalar, place});
    while (i < line.size() && line[i] != '#' && !separates(line[i])) word.text += line[i++];
    comma = false;
  }
  if (!row.items.empty()) row.place = row.items[0].place;
  return row;
}

}  // namespace

Rows read_rows(const Node& list, const std::string& what, const Spec& spec, Problems& problems) {
  const std::size_t before = problems.size();
  Rows rows;
  for (std::size_t i = 0; i < list.items.size(); ++i) {
    const Node& row = list.items[i];
    const std::string name = fmt::format("{}[{}]", what, i);
    if (row.kind != Node::Kind::list) {
      problems.add(row.place, fmt::format("{} is {}; expected a list of numbers", name, found(row)));
      continue;
    }
    if (row.items.empty()) {
      problems.add(row.place, name + " is empty; expected a list of numbers");
    } else if (row.items.size() != list.items[0].items.size()) {
      problems.add(row.place, fmt::format("{} has {}; expected {} like {}[0]", name, numbers(row.items.size()),
                                          list.items[0].items.size(), what));
    }
    std::vector<double>& values = rows.emplace_back();
    for (std::size_t j = 0; j < row.items.size(); ++j) {
      const Node& item = row.items[j];
      const Reading<double> reading = read_number(item, spec.unit);
      if (!reading.ok()) {
        problems.add(item.place, fmt::format("{}[{}] {}", name, j, reading.wrong));
      } else if (reading.value < spec.min || reading.value > spec.max) {
        problems.add(item.place,
                     fmt::format("{}[{}] is {}; expected {}", name, j, with_unit(reading.value, spec.unit), range_text(spec)));
      }
      values.push_back(reading.value);
    }
  }
  return problems.size() == before ? rows : Rows{};
}

Node grid_node(const std::string& text, const std::string& file) {
  Node grid{Node::Kind::list, {file, 1, 1}};
  SourceLocation place{file, 1, 1};
  for (std::size_t start = 0; start < text.size(); ++place.line) {
    const std::size_t end = std::min(text.find('\n', start), text.size());
    Node row = row_of(text.substr(start, end - start), place);
    if (!row.items.empty()) grid.items.push_back(std::move(row));
    start = end + 1;
  }
  return grid;
}

void Reader::on(const char* key, const field::Rows& field) {
  if (const Node* node = take_list(key, "a list of rows of numbers"))
    field.value = read_rows(*node, key, field.spec, problems_);
}

}  // namespace gaitlab
