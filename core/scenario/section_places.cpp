#include "core/scenario/section_places.h"

#include <algorithm>

#include "core/settings/overlay.h"

namespace gaitlab {

std::optional<SourceLocation> given(const Node& root, const std::string& section, const std::string& key) {
  for (std::size_t i = 0; i < root.keys.size(); ++i) {
    if (root.keys[i].first != section) continue;
    if (key.empty()) return root.keys[i].second;
    const Node* value = root.items[i].find(key);
    return value == nullptr ? std::nullopt : std::optional<SourceLocation>(value->place);
  }
  return {};
}

SourceLocation place_of(const Node& root, const std::string& section, const std::string& key) {
  if (const std::optional<SourceLocation> exact = given(root, section, key)) return *exact;
  return given(root, section).value_or(root.place);
}

namespace {

/// First place within a node that --set gave, or nothing.
std::optional<SourceLocation> set_place(const Node& node) {
  if (is_set(node)) return node.place;
  for (const Node& item : node.items) {
    if (std::optional<SourceLocation> place = set_place(item)) return place;
  }
  return {};
}

}  // namespace

SourceLocation place_of_fault(const Node& root, const std::string& section, const std::string& key) {
  const Node* map = root.find(section);
  const Node* value = map;
  for (std::size_t from = 0; value != nullptr && from <= key.size();) {  // a key such as model.speed
    const std::size_t dot = std::min(key.find('.', from), key.size());
    value = value->find(key.substr(from, dot - from));
    from = dot + 1;
  }
  const std::optional<SourceLocation> place = value == nullptr ? std::nullopt : set_place(*value);
  return place ? *place : place_of(root, section, "type");
}

ContactLaw wanted_law(const Node& root) {
  const Node* contact = root.find("contact");
  const Node* law = contact == nullptr ? nullptr : contact->find("law");
  return law == nullptr ? ContactLaw::penalty : named<ContactLaw>(law->text).value_or(ContactLaw::penalty);
}

void note_places(const Node& map, const std::string& prefix, std::map<std::string, SourceLocation>& places) {
  for (std::size_t i = 0; i < map.keys.size(); ++i) {
    const std::string key = prefix + map.keys[i].first;
    places[key] = map.items[i].kind == Node::Kind::map ? map.keys[i].second : map.items[i].place;
    if (key != "robot.types" && key != "robot.modules") note_places(map.items[i], key + ".", places);
  }
}

void note_own_places(const Node& root, const std::function<bool(const std::string& section)>& reads,
                     const std::map<std::string, SourceLocation>& common, std::map<std::string, SourceLocation>& own) {
  Node touched{Node::Kind::map};
  for (std::size_t i = 0; i < root.keys.size(); ++i) {
    if (!reads(root.keys[i].first)) continue;
    touched.keys.push_back(root.keys[i]);
    touched.items.push_back(root.items[i]);
  }
  note_places(touched, "", own);
  std::erase_if(own, [&](const auto& one) {
    const auto known = common.find(one.first);
    return known != common.end() && to_string(known->second) == to_string(one.second);
  });
}

std::vector<Problem> in_order(std::vector<Problem> problems, const std::string& file) {
  const auto before = [&](const Problem& a, const Problem& b) {
    if (a.place.file != file || b.place.file != file) return a.place.file == file && b.place.file != file;
    return std::pair(a.place.line, a.place.column) < std::pair(b.place.line, b.place.column);
  };
  std::stable_sort(problems.begin(), problems.end(), before);
  return problems;
}

}  // namespace gaitlab
