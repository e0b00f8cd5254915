#include "studies/plan/own_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>

#include "core/files/atomic_file.h"
#include "core/settings/value.h"
#include "core/settings/wording.h"

namespace gaitlab::studies {

namespace {

/// Entry of a list by its number or by the name of a joint; null if there is none.
const Node* entry_of(const Node& list, const std::string& name, const std::vector<std::string>& joints) {
  std::size_t at = 0;
  const char* const end = name.data() + name.size();
  if (const auto read = std::from_chars(name.data(), end, at); read.ec != std::errc() || read.ptr != end)
    at = static_cast<std::size_t>(std::ranges::find(joints, name) - joints.begin());
  return at < list.items.size() ? &list.items[at] : nullptr;
}

/// Node of a key in the scenario's file; null if a setting of the study replaces it.
const Node* find_in_file(const Node& file, const std::string& key, const Study& study) {
  const std::string section = key.substr(0, key.rfind('.'));
  const auto sets = [&](const std::string& set) {
    return set.starts_with(section) || section.starts_with(set.substr(0, set.find('=')));
  };
  return std::ranges::any_of(study.sets, sets) ? nullptr : find_key(file, key, {});
}

OwnValue own_value(const Node* node, const Parameter& p) {
  if (node == nullptr || node->kind != Node::Kind::scalar) return {"", "has no single value in the scenario"};
  const Reading<double> number = read_number(*node, "");
  std::string text = number.ok() ? number_text(number.value) : node->text;
  if (!p.values.empty()) {
    const bool listed = std::ranges::find(p.values, text) != p.values.end();
    return listed ? OwnValue{text, ""}
                  : OwnValue{"", "is " + clipped(text) + " in the scenario, not one of the parameter's values"};
  }
  if (!number.ok()) return {"", "is not a number in the scenario"};
  if (number.value >= p.low && number.value <= p.high) return {std::move(text), ""};
  return {"", fmt::format("is {} in the scenario, outside the parameter's range", text)};
}

}  // namespace

const Node* find_key(const Node& root, const std::string& key, const std::vector<std::string>& joints) {
  const Node* node = &root;
  for (std::size_t at = 0; node != nullptr && at <= key.size();) {
    const std::size_t end = std::min(key.find('.', at), key.size());
    const std::string part = key.substr(at, end - at);
    if (node->kind == Node::Kind::map) {
      node = node->find(part);
    } else if (node->kind == Node::Kind::list) {
      node = entry_of(*node, part, joints);
    } else if (std::ranges::find(joints, part) == joints.end()) {
      node = nullptr;
    }
    at = end + 1;
  }
  return node;
}

std::vector<OwnValue> own_values(const Study& study, const StudyScenario& scenario) {
  const Node resolved = parse_yaml(scenario.resolved, scenario.nominal.file);
  std::optional<Node> file;
  std::vector<OwnValue> all;
  for (const Parameter& p : study.parameters) {
    if (!p.sets.empty()) {
      all.push_back({"", "is a parameter of the study, without a value in the scenario"});
      continue;
    }
    const Node* node = find_key(resolved, p.key, scenario.joints);
    if (node == nullptr || node->kind != Node::Kind::scalar) {
      if (!file) file = parse_yaml(read_file(scenario.nominal.file, kMostScenario), scenario.nominal.file);
      node = find_in_file(*file, p.key, study);
    }
    all.push_back(own_value(node, p));
  }
  return all;
}

}  // namespace gaitlab::studies
