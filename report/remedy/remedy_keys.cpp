#include "report/remedy/remedy_keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/plugin/plugin_instance.h"
#include "core/scenario/resolved.h"
#include "core/scenario/sensor_section.h"

namespace gaitlab::report {

namespace {

const std::vector<RemedyKey> kKeys{
    {"frequency", {"cpg.frequency"}, "Hz", {}, true},
    {"amplitude", {"cpg.amplitude"}, "rad"},
    {"u_max", {"actuator.u_max"}, "V"},
    {"i_max", {"actuator.i_max"}, "A"},
    {"u_max with i_max", {"actuator.u_max", "actuator.i_max"}, ""},
    {"stall_torque", {"actuator.stall_torque"}, "N m"},
    {"no_load_speed", {"actuator.no_load_speed"}, "rad/s", {"actuator.stall_current"}},
    {"supply.voltage", {"supply.voltage"}, "V", {}, false, true},
    {"supply.resistance", {"supply.resistance"}, "ohm", {}, false, true},
    {.name = "Kp", .paths = {"controller.Kp"}, .unit = "", .is_gain = true},
    {"friction", {"ground.friction"}, "", {"ground.boxes.friction"}},
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

bool is_zero(const Node& node) { return number(node) == 0.0; }

/// The value of a key in a map, or nullptr.
Node* child(Node& map, const std::string& key) {
  const auto at = std::ranges::find(map.keys, key, [](const auto& one) { return one.first; });
  return at == map.keys.end() ? nullptr : &map.items[static_cast<std::size_t>(at - map.keys.begin())];
}

std::string quoted(const std::string& text) { return nlohmann::json(text).dump(); }

/// YAML text of a node on one line. Every number is multiplied; if `only` is not empty, those under this key of a map.
std::string scaled_text(const Node& node, double factor, const std::string& only) {
  const std::optional<double> value = only.empty() ? number(node) : std::nullopt;
  if (value) return fmt::format("{:.10g}", *value * factor);
  if (node.kind == Node::Kind::null) return "";
  if (node.kind == Node::Kind::scalar) return node.quoted ? quoted(node.text) : node.text;
  const bool map = node.kind == Node::Kind::map;
  std::string text;
  for (std::size_t i = 0; i < node.items.size(); ++i) {
    if (i > 0) text += ", ";
    if (map) text += quoted(node.keys[i].first) + ": ";
    text += scaled_text(node.items[i], factor, map && node.keys[i].first == only ? "" : only);
  }
  return map ? "{" + text + "}" : "[" + text + "]";
}

/// The path without its last part, and that part.
std::pair<std::string, std::string> split(const std::string& path) {
  const std::size_t dot = path.rfind('.');
  return {path.substr(0, dot), path.substr(dot + 1)};
}

}  // namespace

std::span<const RemedyKey> remedy_keys() { return kKeys; }

RemedySettings::RemedySettings(const std::string& resolved, const std::vector<PositionGains>& gains)
    : root_(parse_yaml(resolved, "the resolved scenario")), gain_(gains.empty() ? "Kp" : gains.front().key) {
  take_voltage();
  take_gain(gains);
}

/// Adds the position gain that the scenario does not state.
void RemedySettings::take_gain(const std::vector<PositionGains>& gains) {
  Node* const controller = child(root_, "controller");
  if (gains.empty() || controller == nullptr || controller->find(gain_) != nullptr) return;
  controller->keys.emplace_back(gain_, SourceLocation{});
  Node& list = controller->items.emplace_back(Node{Node::Kind::list});
  for (const PositionGains& law : gains)
    list.items.push_back(Node{Node::Kind::scalar, {}, fmt::format("{}", law.P / law.per_key)});
  const auto differ = [](const Node& a, const Node& b) { return a.text != b.text; };
  if (std::ranges::adjacent_find(list.items, differ) == list.items.end()) list = Node(list.items.front());
}

std::vector<std::string> RemedySettings::paths(const RemedyKey& key) const {
  if (key.is_gain) return {"controller." + gain_};
  return {key.paths.begin(), key.paths.end()};
}

std::string RemedySettings::name(const RemedyKey& key) const { return key.is_gain ? gain_ : key.name; }

/// Replaces the numbers 0 of `u_max` by the numbers of `voltage`.
void RemedySettings::take_voltage() {
  if (find("supply") != nullptr) return;
  Node* const actuator = child(root_, "actuator");
  const Node* const voltage = actuator == nullptr ? nullptr : actuator->find("voltage");
  if (voltage == nullptr) return;
  const Node supply = *voltage;
  Node* const limit = child(*actuator, "u_max");
  if (limit == nullptr) {
    actuator->keys.emplace_back("u_max", SourceLocation{});
    actuator->items.push_back(supply);
  } else if (is_zero(*limit)) {
    *limit = supply;
  }
  const bool each = supply.kind == Node::Kind::list;  // a resolved scenario has a number, or a list with one per joint
  for (std::size_t i = 0; limit != nullptr && i < limit->items.size() && (!each || i < supply.items.size()); ++i) {
    if (is_zero(limit->items[i])) limit->items[i] = each ? supply.items[i] : supply;
  }
}

const Node* RemedySettings::find(const std::string& path) const {
  const Node* node = &root_;
  for (std::size_t from = 0; node != nullptr && from <= path.size();) {
    const std::size_t to = std::min(path.find('.', from), path.size());
    node = node->find(path.substr(from, to - from));
    from = to + 1;
  }
  return node;
}

std::vector<double> RemedySettings::numbers(const std::string& path) const {
  std::vector<double> all;
  if (const Node* node = find(path)) add_numbers(*node, all);
  return all;
}

bool RemedySettings::changes_in_time(const std::string& path) const {
  const Node* at = find("at");
  const auto sets = [&](const Node& entry) {
    const Node* set = entry.find("set");
    const auto meant = [&](const auto& key) {
      return key.first == path || path.starts_with(key.first + ".") || key.first.starts_with(path + ".");
    };
    return set != nullptr && std::ranges::any_of(set->keys, meant);
  };
  return at != nullptr && std::ranges::any_of(at->items, sets);
}

std::string RemedySettings::missing(const RemedyKey& key) const {
  for (const std::string& path : paths(key)) {
    if (std::ranges::none_of(numbers(path), [](double value) { return value != 0; })) return none_of(path);
    if (changes_in_time(path)) return "set by `at`";
  }
  return "";
}

bool RemedySettings::concerns(const RemedyKey& key) const {
  return !key.of_option || find(split(key.paths.front()).first) != nullptr;
}

/// Reason why a path has no number other than 0.
std::string RemedySettings::none_of(const std::string& path) const {
  const bool servo = find("actuator.voltage") != nullptr;
  if (servo && path == "actuator.i_max") return "0: the stall current at `voltage`";
  if (servo && path == "actuator.u_max" && find("supply") != nullptr) return "0: the voltage of the supply";
  return "missing or 0";
}

double RemedySettings::value(const RemedyKey& key) const {
  const Node* node = find(paths(key).front());
  const std::optional<double> only = node == nullptr || key.paths.size() > 1 ? std::nullopt : number(*node);
  return only.value_or(std::numeric_limits<double>::quiet_NaN());
}

bool RemedySettings::uniform(const std::string& path) const {
  const std::vector<double> all = numbers(path);
  return std::ranges::adjacent_find(all, std::ranges::not_equal_to()) == all.end();
}

void RemedySettings::add_scaled(const std::string& path, double factor, std::vector<std::string>& sets) const {
  if (const Node* node = find(path)) {
    sets.push_back(fmt::format("{}={}", path, scaled_text(*node, factor, "")));
    return;
  }
  const auto [list, key] = split(path);
  const Node* node = find(list);
  if (node != nullptr && node->kind == Node::Kind::list && !node->items.empty())
    sets.push_back(fmt::format("{}={}", list, scaled_text(*node, factor, key)));
}

std::vector<std::string> RemedySettings::scaled(const RemedyKey& key, double factor) const {
  std::vector<std::string> sets;
  for (const std::string& path : paths(key)) add_scaled(path, factor, sets);
  for (const char* path : key.also) add_scaled(path, factor, sets);
  const Node* duration = find("duration");
  if (key.stretches && factor < 1 && duration != nullptr) {
    constexpr double kTick = 1000;  // 1/s
    sets.push_back(fmt::format("duration={}", std::ceil(number(*duration).value_or(0) / factor * kTick) / kTick));
  }
  return sets;
}

RemedySettings settings_of(const Scenario& scenario) {
  const std::unique_ptr<Controller> controller = make_controller(scenario.controller, plugin_info(scenario));
  return RemedySettings(resolved(scenario), controller == nullptr ? std::vector<PositionGains>() : controller->gains());
}

double rounded_setting(double value, double now, bool up) {
  const double change = std::abs(value - now);
  if (!(change > 0)) return value;
  const double unit = std::pow(10, std::floor(std::log10(change)) - 2);
  const double count = value / unit;
  constexpr double kSame = 1e-6;  // the value itself, in spite of rounding errors
  return (up ? std::ceil(count - kSame) : std::floor(count + kSame)) * unit;
}

}  // namespace gaitlab::report
