#include "report/remedy/remedy_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string_view>

#include "core/settings/wording.h"

namespace gaitlab::report {

namespace {

constexpr std::string_view kDock = "dock_";
constexpr double kFirst = 0.201, kLast = 4.99;  // factors at the ends of the range, with a margin for rounding

/// Value of a setting with its unit, or the factor if joints differ.
std::string value_text(const Remedy& remedy, const RemedyKey& key, double factor) {
  const double now = remedy.settings.value(key);
  if (std::isnan(now)) return fmt::format("{:.4g} times", factor);
  return fmt::format("{:.4g}{}{}", now * factor, *key.unit == '\0' ? "" : " ", key.unit);
}

/// Text such as ` (now 0.408 A)`; empty if joints differ.
std::string before(const Remedy& remedy, const RemedyKey& key) {
  return std::isnan(remedy.settings.value(key)) ? "" : fmt::format(" (now {})", value_text(remedy, key, 1));
}

/// Text such as `i_max >= 0.719 A (now 0.408 A)`, or with both ends of the range.
std::string change(const Remedy& remedy, const RemedyAnswer& answer) {
  const RemedyKey& key = *answer.key;
  const std::string from = value_text(remedy, key, answer.factor);
  if (answer.until >= kLast || answer.until <= kFirst)
    return fmt::format("{} {} {}{}", key.name, answer.up ? ">=" : "<=", from, before(remedy, key));
  return fmt::format("{} from {} to {}{}", key.name, from, value_text(remedy, key, answer.until), before(remedy, key));
}

std::string speed_text(const RemedyRun& run) {
  if (!std::isfinite(run.speed)) return "";
  return fmt::format("; speed {:.4f} m/s{}", run.speed, run.still ? ", hardly moves" : "");
}

/// Text such as `i_continuous >= 0.298 A (now 0.229 A; m1/active)` or `docks that hold 1.31 N m of bending (now 1 N m; m3)`.
std::string rating_text(const RatingNeeded& rating) {
  const std::string parts = rating.part + (rating.parts > 1 ? fmt::format(" and {} more", rating.parts - 1) : "");
  const bool dock = rating.check.starts_with(kDock);
  const std::string load = dock ? rating.check.substr(kDock.size()) : "";
  if (!rating.same) {
    constexpr double kTenth = 100;
    const double times = std::ceil(rating.rating / rating.now * kTenth) / kTenth;
    return dock ? fmt::format("docks that hold {} times their rated {} ({})", times, load, parts)
                : fmt::format("{} of {} times the ratings ({})", rating.setting, times, parts);
  }
  const std::string value = fmt::format("{:.4g} {}", rating.rating, rating.unit);
  const std::string needed =
      dock ? fmt::format("docks that hold {} of {}", value, load) : fmt::format("{} >= {}", rating.setting, value);
  return fmt::format("{} (now {:.4g} {}; {})", needed, rating.now, rating.unit, parts);
}

/// `a, b or c`
std::string alternatives(const std::vector<std::string>& names) {
  if (names.size() < 2) return joined(names);
  return fmt::format("{} or {}", fmt::join(names.begin(), names.end() - 1, ", "), names.back());
}

/// First clause of a text, for a line.
std::string clause(const std::string& text) { return text.substr(0, text.find(';')); }

/// Names of settings whose verdict changes in no direction, and that were simulated up to both ends of the range.
std::vector<std::string> unmoved(const Remedy& remedy) {
  std::vector<std::string> names;
  for (const RemedyAnswer& answer : remedy.answers) {
    const auto moves = [&](const RemedyAnswer& a) { return a.key == answer.key && (a.crosses || !a.refused.empty()); };
    if (std::ranges::none_of(remedy.answers, moves) && std::ranges::count(names, answer.key->name) == 0)
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

void add_reserves(const Remedy& remedy, Lines& lines) {
  const auto lead = [&] { return lines.lines.empty() ? "stays feasible with" : "or with"; };
  for (const RemedyAnswer& answer : remedy.answers) {
    if (!answer.confirmed) continue;
    const std::string end = answer.beyond.simulated ? "; then " + clause(answer.beyond.weakest) : "";
    lines.add(fmt::format("{} {} {} {}{}{}", lead(), answer.key->name, answer.up ? "up to" : "down to",
                          value_text(remedy, *answer.key, answer.factor), before(remedy, *answer.key), end));
  }
  const std::vector<std::string> free = unmoved(remedy);
  if (free.empty()) return;
  const std::string by = remedy.engine == remedy.own_engine ? "" : fmt::format(" (engine {})", remedy.engine);
  lines.add(fmt::format("{} any {} from a fifth to five times{}", lead(), alternatives(free), by));
}

std::string pair_text(const Remedy& remedy, const RemedyPair& pair) {
  const auto value = [&](const char* name, double factor) {
    const auto key = std::ranges::find_if(remedy_keys(), [&](const RemedyKey& k) { return std::string(name) == k.name; });
    return fmt::format("{} {}{}", name, value_text(remedy, *key, factor), before(remedy, *key));
  };
  return fmt::format("feasible with {} and {} together{}", value("frequency", pair.frequency),
                     value("amplitude", pair.amplitude), speed_text(pair.run));
}

void add_cures(const Remedy& remedy, Lines& lines) {
  std::vector<std::string> ratings;
  for (const RatingNeeded& rating : remedy.ratings) ratings.push_back(rating_text(rating));
  if (remedy.ratings_suffice) lines.add(fmt::format("feasible with {}", fmt::join(ratings, " and ")), Tone::good);
  std::vector<std::pair<double, std::string>> cures;  // speeds and texts
  for (const RemedyAnswer& answer : remedy.answers) {
    if (answer.confirmed) cures.emplace_back(answer.run.speed, change(remedy, answer) + speed_text(answer.run));
  }
  std::ranges::stable_sort(cures, std::greater{}, [](const auto& cure) { return cure.first; });
  for (const auto& [speed, text] : cures) lines.add((lines.lines.empty() ? "feasible with " : "or with ") + text, Tone::good);
  if (remedy.pair) lines.add(pair_text(remedy, *remedy.pair), Tone::good);
  if (const std::vector<std::string> names = unmoved(remedy); !names.empty()) {
    const std::string grid = remedy.map && !remedy.pair ? ", and no pair of frequency and amplitude does" : "";
    lines.add(fmt::format("no {}, from a fifth to five times, makes it feasible alone{}", alternatives(names), grid),
              lines.lines.empty() ? Tone::bad : Tone::plain);
  }
  if (remedy.ratings_suffice) return;
  for (const std::string& rating : ratings)
    lines.add("the present motion also needs " + rating + ", which alone does not suffice");
}

/// Lines on answers that are not confirmed, and on values that the scenario cannot have.
void add_open(const Remedy& remedy, Lines& lines) {
  for (const RemedyAnswer& answer : remedy.answers) {
    if (answer.crosses && !answer.confirmed) {
      const std::string why = answer.less_suffices   ? "a smaller change also makes it feasible"
                              : answer.run.simulated ? clause(answer.run.weakest)
                                                     : "next to no change";
      lines.add(fmt::format("not confirmed by engine {}: {}: {}", remedy.own_engine, change(remedy, answer), why),
                Tone::doubtful);
    }
    if (answer.refused.empty()) continue;
    lines.add(fmt::format("{} not tried {} {}: {}", answer.key->name, answer.up ? "above" : "below",
                          value_text(remedy, *answer.key, answer.until), clause(answer.refused)));
  }
  std::vector<std::string> lacking;
  for (const RemedyLack& lack : remedy.lacking) lacking.push_back(fmt::format("{} ({})", lack.key->name, lack.reason));
  if (!lacking.empty()) lines.add("not tried: " + fmt::format("{}", fmt::join(lacking, ", ")));
}

}  // namespace

std::vector<ScreenLine> remedy_lines(const Remedy& remedy) {
  Lines lines;
  if (remedy.word == Word::feasible) {
    add_reserves(remedy, lines);
  } else {
    add_cures(remedy, lines);
  }
  add_open(remedy, lines);
  return lines.lines;
}

}  // namespace gaitlab::report
