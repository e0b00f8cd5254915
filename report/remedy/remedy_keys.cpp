#include "report/remedy/remedy_keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>

namespace gaitlab::report {

namespace {

const std::vector<RemedyKey> kKeys{
    {"frequency", {"cpg.frequency"}, "Hz", true},
    {"amplitude", {"cpg.amplitude"}, "rad"},
    {"u_max", {"actuator.u_max"}, "V"},
    {"i_max", {"actuator.i_max"}, "A"},
    {"u_max and i_max", {"actuator.u_max", "actuator.i_max"}, ""},
    {"stall_torque", {"actuator.stall_torque"}, "N m"},
    {"Kp", {"controller.Kp"}, ""},
    {"friction", {"ground.friction"}, ""},
};

std::optional<double> number(const Node& node) {
  if (node.kind != Node::Kind::scalar || node.quoted) return {};
  double value = 0;
  const char* const end = node.text.data() + node.text.size();
  const auto read = std::from_chars(node.text.data(), end, value);
  if (read.ec != std::errc() || read.ptr != end || !std::isfinite(value)) return {};
  return value;
}

void add_numbers(const Node& node, std::vector<double>& all) {
  if (const std::optional<double> value = number(node)) all.push_back(*value);
  for (const Node& item : node.items) add_numbers(item, all);
}

std::string quoted(const std::string& text) { return nlohmann::json(text).dump(); }

/// YAML text of a node on one line, with every number multiplied.
std::string scaled_text(const Node& node, double factor) {
  if (const std::optional<double> value = number(node)) return fmt::format("{:.10g}", *value * factor);
  if (node.kind == Node::Kind::scalar) return node.quoted ? quoted(node.text) : node.text;
  std::string text;
  for (std::size_t i = 0; i < node.items.size(); ++i) {
    if (i > 0) text += ", ";
    if (node.kind == Node::Kind::map) text += quoted(node.keys[i].first) + ": ";
    text += scaled_text(node.items[i], factor);
  }
  return node.kind == Node::Kind::map ? "{" + text + "}" : "[" + text + "]";
}

}  // namespace

std::span<const RemedyKey> remedy_keys() { return kKeys; }

RemedySettings::RemedySettings(const std::string& resolved) : root_(parse_yaml(resolved, "the resolved scenario")) {}

const Node* RemedySettings::find(const std::string& path) const {
  const Node* node = &root_;
  for (std::size_t from = 0; node != nullptr && from <= path.size();) {
    const std::size_t to = std::min(path.find('.', from), path.size());
    node = node->find(path.substr(from, to - from));
    from = to + 1;
  }
  return node;
}

bool RemedySettings::has(const RemedyKey& key) const {
  return std::ranges::all_of(key.paths, [&](const char* path) {
    std::vector<double> numbers;
    if (const Node* node = find(path)) add_numbers(*node, numbers);
    return std::ranges::any_of(numbers, [](double value) { return value != 0; });
  });
}

double RemedySettings::value(const RemedyKey& key) const {
  const Node* node = find(key.paths.front());
  const std::optional<double> only = node == nullptr || key.paths.size() > 1 ? std::nullopt : number(*node);
  return only.value_or(std::numeric_limits<double>::quiet_NaN());
}

std::vector<std::string> RemedySettings::scaled(const RemedyKey& key, double factor) const {
  std::vector<std::string> sets;
  for (const char* path : key.paths) sets.push_back(fmt::format("{}={}", path, scaled_text(*find(path), factor)));
  const Node* duration = find("duration");
  if (key.stretches && factor < 1 && duration != nullptr) {
    constexpr double kTick = 1000;  // 1/s
    sets.push_back(fmt::format("duration={}", std::ceil(number(*duration).value_or(0) / factor * kTick) / kTick));
  }
  return sets;
}

}  // namespace gaitlab::report
