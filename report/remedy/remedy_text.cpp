#include "report/remedy/remedy_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>

#include "core/scenario/resolved.h"
#include "core/settings/wording.h"

namespace gaitlab::report {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view kDock = "dock_";

/// Values of a setting in texts: with its unit, or as a factor if joints differ.
class Values {
 public:
  explicit Values(const Scenario& scenario) : settings_(resolved(scenario)) {}

  [[nodiscard]] double now(const RemedyKey& key) const { return settings_.value(key); }
  [[nodiscard]] std::string text(const RemedyKey& key, double factor) const {
    if (std::isnan(now(key))) return fmt::format("{:.4g} times", factor);
    return fmt::format("{:.4g}{}{}", now(key) * factor, *key.unit == '\0' ? "" : " ", key.unit);
  }
  /// Text such as ` (now 0.408 A)`; empty if joints differ.
  [[nodiscard]] std::string before(const RemedyKey& key) const {
    return std::isnan(now(key)) ? "" : fmt::format(" (now {})", text(key, 1));
  }

 private:
  RemedySettings settings_;
};

bool at_end(const RemedyAnswer& answer) { return answer.until >= 4.99 || answer.until <= 0.201; }

/// Text such as `i_max >= 0.719 A (now 0.408 A)`, or with both ends of the range.
std::string change(const RemedyAnswer& answer, const Values& values) {
  const RemedyKey& key = *answer.key;
  if (at_end(answer))
    return fmt::format("{} {} {}{}", key.name, answer.up ? ">=" : "<=", values.text(key, answer.factor), values.before(key));
  return fmt::format("{} {} to {}{}", key.name, values.text(key, answer.factor), values.text(key, answer.until),
                     values.before(key));
}

std::string speed_text(const RemedyRun& run) { return std::isfinite(run.speed) ? fmt::format(": {:.4f} m/s", run.speed) : ""; }

/// Text such as `i_continuous >= 0.298 A (now 0.229 A; m1/active)` or `docks that hold 1.31 N m of bending (now 1 N m; m3)`.
std::string rating_text(const RatingNeeded& rating) {
  const std::string more = rating.parts > 1 ? fmt::format(" and {} more", rating.parts - 1) : "";
  const std::string value = fmt::format("{:.4g} {}", rating.rating, rating.unit);
  const std::string needed = rating.check.starts_with(kDock)
                                 ? fmt::format("docks that hold {} of {}", value, rating.check.substr(kDock.size()))
                                 : fmt::format("{} >= {}", rating.setting, value);
  return fmt::format("{} (now {:.4g} {}; {}{})", needed, rating.now, rating.unit, rating.part, more);
}

/// `a, b or c`
std::string alternatives(const std::vector<std::string>& names) {
  if (names.size() < 2) return joined(names);
  return fmt::format("{} or {}", fmt::join(names.begin(), names.end() - 1, ", "), names.back());
}

std::vector<std::string> helpless(const Remedy& remedy) {
  std::vector<std::string> names;
  for (const RemedyAnswer& answer : remedy.answers) {
    const auto helps = [&](const RemedyAnswer& other) { return other.key == answer.key && other.crosses && other.confirmed; };
    if (std::ranges::none_of(remedy.answers, helps) && !std::ranges::count(names, answer.key->name))
      names.emplace_back(answer.key->name);
  }
  return names;
}

class Lines {
 public:
  void add(std::string text, Tone tone = Tone::plain) {
    lines.push_back({lines.empty() ? "remedy" : "", std::move(text), tone});
  }
  std::vector<ScreenLine> lines;
};

void add_reserves(const Remedy& remedy, const Values& values, Lines& lines) {
  for (const RemedyAnswer& answer : remedy.answers) {
    if (!answer.crosses) continue;
    const RemedyKey& key = *answer.key;
    lines.add(fmt::format("{} {} {} {}{}; then {}", lines.lines.empty() ? "stays feasible with" : "or with", key.name,
                          answer.up ? "up to" : "down to", values.text(key, answer.factor), values.before(key),
                          answer.farthest.fails));
  }
  std::vector<std::string> free;
  for (const RemedyAnswer& answer : remedy.answers) {
    const bool moves = std::ranges::any_of(remedy.answers, [&](const auto& a) { return a.key == answer.key && a.crosses; });
    if (!moves && std::ranges::count(free, answer.key->name) == 0) free.emplace_back(answer.key->name);
  }
  if (free.empty()) return;
  lines.add(fmt::format("{} any {} from a fifth to five times", lines.lines.empty() ? "stays feasible with" : "or with",
                        alternatives(free)));
}

void add_cures(const Remedy& remedy, const Values& values, Lines& lines) {
  const auto lead = [&] { return lines.lines.empty() ? "feasible with" : "or with"; };
  if (remedy.ratings_suffice) {
    std::vector<std::string> needed;
    for (const RatingNeeded& rating : remedy.ratings) needed.push_back(rating_text(rating));
    lines.add(fmt::format("feasible with {}", fmt::join(needed, " and ")), Tone::good);
  }
  for (const RemedyAnswer& answer : remedy.answers) {
    if (answer.crosses && answer.confirmed)
      lines.add(fmt::format("{} {}{}", lead(), change(answer, values), speed_text(answer.run)), Tone::good);
  }
  const auto tells_pair = [&](const RemedyPair& pair) {
    const auto value = [&](const char* name, double factor) {
      const auto key = std::ranges::find_if(remedy_keys(), [&](const RemedyKey& k) { return std::string(name) == k.name; });
      return fmt::format("{} {}{}", name, values.text(*key, factor), values.before(*key));
    };
    lines.add(fmt::format("feasible with {} and {} together{}", value("frequency", pair.frequency),
                          value("amplitude", pair.amplitude), speed_text(pair.run)),
              Tone::good);
  };
  if (remedy.pair) tells_pair(*remedy.pair);
  if (lines.lines.empty()) {
    lines.add("not feasible by " + alternatives(helpless(remedy)) + ", from a fifth to five times" +
                  (remedy.map ? ", nor by frequency and amplitude together" : ""),
              Tone::bad);
  } else if (const std::vector<std::string> names = helpless(remedy); !names.empty()) {
    lines.add("not by " + alternatives(names) + " alone, from a fifth to five times");
  }
  if (remedy.ratings_suffice) return;
  for (const RatingNeeded& rating : remedy.ratings) lines.add("with the motion as it is, also " + rating_text(rating));
}

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(); }

Json json_of(const RemedyRun& run) {
  return {{"verdict", name_of(run.word)}, {"margin", number(run.margin)}, {"speed", number(run.speed)}, {"weakest", run.fails}};
}

Json json_of(const RemedyAnswer& answer, const Values& values) {
  const double now = values.now(*answer.key);
  Json json{{"setting", answer.key->name}, {"keys", answer.key->paths},
            {"unit", answer.key->unit},    {"direction", answer.up ? "up" : "down"},
            {"now", number(now)},          {"changes_verdict", answer.crosses}};
  json["farthest"] = json_of(answer.farthest);
  if (!answer.crosses) return json;
  json["confirmed"] = answer.confirmed;
  json["factor"] = answer.factor;
  json["value"] = number(now * answer.factor);
  json["until"] = {{"factor", answer.until}, {"value", number(now * answer.until)}};
  json["run"] = json_of(answer.run);
  json["set"] = answer.sets;
  return json;
}

Json json_of(const RemedyMap& map, const Values& values) {
  Json json{{"factors", map.factors}};
  for (const RemedyKey& key : remedy_keys()) {
    const std::string name = key.name;
    if (name == "frequency" || name == "amplitude") json[name] = {{"now", number(values.now(key))}, {"unit", key.unit}};
  }
  json["cells"] = Json::array();
  for (const RemedyRun& run : map.runs) json["cells"].push_back(json_of(run));
  return json;
}

}  // namespace

std::vector<ScreenLine> remedy_lines(const Remedy& remedy, const Scenario& scenario) {
  const Values values(scenario);
  Lines lines;
  if (remedy.word == Word::feasible) {
    add_reserves(remedy, values, lines);
  } else {
    add_cures(remedy, values, lines);
  }
  for (const RemedyAnswer& answer : remedy.answers) {
    if (answer.crosses && !answer.confirmed && std::abs(answer.factor - 1) > 0.01) {
      lines.add(fmt::format("not confirmed by engine {}: {}: {}", scenario.physics.engine->name, change(answer, values),
                            answer.run.fails),
                Tone::doubtful);
    }
  }
  std::vector<std::string> lacking;
  for (const RemedyKey* key : remedy.lacking) lacking.emplace_back(key->name);
  if (!lacking.empty()) lines.add("not tried, because this scenario does not have them: " + joined(lacking));
  return lines.lines;
}

std::string to_json(const Remedy& remedy, const Scenario& scenario) {
  const Values values(scenario);
  Json json{{"format", 1}, {"verdict", name_of(remedy.word)}, {"engine", remedy.engine}, {"runs", remedy.runs}};
  json["text"] = Json::array();
  for (const ScreenLine& line : remedy_lines(remedy, scenario)) json["text"].push_back(line.text);
  json["answers"] = Json::array();
  for (const RemedyAnswer& answer : remedy.answers) json["answers"].push_back(json_of(answer, values));
  json["ratings"] = Json::array();
  for (const RatingNeeded& rating : remedy.ratings) {
    json["ratings"].push_back({{"check", rating.check},
                               {"setting", rating.setting},
                               {"part", rating.part},
                               {"rating", rating.rating},
                               {"now", rating.now},
                               {"unit", rating.unit},
                               {"parts", rating.parts}});
  }
  json["ratings_suffice"] = remedy.ratings_suffice;
  json["lacking"] = Json::array();
  for (const RemedyKey* key : remedy.lacking) json["lacking"].push_back(key->name);
  if (remedy.map) json["map"] = json_of(*remedy.map, values);
  if (remedy.pair) {
    json["pair"] = {{"frequency", remedy.pair->frequency},
                    {"amplitude", remedy.pair->amplitude},
                    {"run", json_of(remedy.pair->run)},
                    {"set", remedy.pair->sets}};
  }
  return json.dump(2) + "\n";
}

}  // namespace gaitlab::report
