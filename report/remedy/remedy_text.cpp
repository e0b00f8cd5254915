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

/// Names of a setting's keys: `u_max`, or `u_max and i_max together`.
std::string subject(const Remedy& remedy, const RemedyKey& key) {
  if (key.paths.size() == 1) return remedy.settings.name(key);
  std::vector<std::string> names;
  for (const std::string path : key.paths) names.push_back(path.substr(path.rfind('.') + 1));
  return fmt::format("{} together", fmt::join(names, " and "));
}

/// True if the setting has a single value, which the lines state. If joints or keys differ, the lines state the factor.
bool has_value(const Remedy& remedy, const RemedyKey& key) { return !std::isnan(remedy.settings.value(key)); }

/// `0.719 A`; `1.388 times the present value` if joints or keys differ.
std::string value_text(const Remedy& remedy, const RemedyKey& key, double factor) {
  if (!has_value(remedy, key)) return fmt::format("{:.4g} times the present value", factor);
  return fmt::format("{:.4g}{}{}", remedy.settings.value(key) * factor, *key.unit == '\0' ? "" : " ", key.unit);
}

/// Text such as ` (now 0.408 A)`; empty if joints or keys differ.
std::string before(const Remedy& remedy, const RemedyKey& key) {
  return has_value(remedy, key) ? fmt::format(" (now {})", value_text(remedy, key, 1)) : "";
}

/// Text such as `i_max >= 0.719 A (now 0.408 A)` or `u_max and i_max together at least 1.388 times the present value`, or with
/// both ends of the range.
std::string change(const Remedy& remedy, const RemedyAnswer& answer) {
  const RemedyKey& key = *answer.key;
  const std::string name = subject(remedy, key), from = value_text(remedy, key, answer.factor);
  const bool value = has_value(remedy, key);
  if (answer.until >= kLast || answer.until <= kFirst) {
    const char* const bound = answer.up ? (value ? ">=" : "at least") : (value ? "<=" : "at most");
    return fmt::format("{} {} {}{}", name, bound, from, before(remedy, key));
  }
  const std::string first = value ? from : fmt::format("{:.4g}", answer.factor);
  return fmt::format("{} from {} to {}{}", name, first, value_text(remedy, key, answer.until), before(remedy, key));
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
  return fmt::format("{} (now {:.4g} {}{})", needed, rating.now, rating.unit, parts.empty() ? "" : "; " + parts);
}

/// `a, b or c`
std::string alternatives(const std::vector<std::string>& names) {
  if (names.size() < 2) return joined(names);
  return fmt::format("{} or {}", fmt::join(names.begin(), names.end() - 1, ", "), names.back());
}

/// First clause of a text, for a line.
std::string clause(const std::string& text) { return text.substr(0, text.find(';')); }

/// Settings that do not change the verdict in either direction, and that were simulated up to both ends of the range.
std::vector<std::string> unmoved(const Remedy& remedy) {
  std::vector<std::string> names;
  for (const RemedyAnswer& answer : remedy.answers) {
    const auto moves = [&](const RemedyAnswer& a) {
      return a.key == answer.key && (a.crosses || a.stopped || !a.refused.empty());
    };
    if (std::ranges::none_of(remedy.answers, moves) && std::ranges::count(names, subject(remedy, *answer.key)) == 0)
      names.push_back(subject(remedy, *answer.key));
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

/// `frequency up to 0.34 Hz (now 0.25 Hz)`
std::string reserve(const Remedy& remedy, const RemedyAnswer& answer) {
  return fmt::format("{} {} {}{}", subject(remedy, *answer.key), answer.up ? "up to" : "down to",
                     value_text(remedy, *answer.key, answer.factor), before(remedy, *answer.key));
}

void add_reserves(const Remedy& remedy, Lines& lines) {
  const auto lead = [&] { return lines.lines.empty() ? "stays feasible with" : "or with"; };
  for (const RemedyAnswer& answer : remedy.answers) {
    if (!answer.confirmed) continue;
    const std::string end = answer.beyond.simulated ? "; then " + clause(answer.beyond.weakest) : "";
    lines.add(fmt::format("{} {}{}", lead(), reserve(remedy, answer), end));
  }
  const std::vector<std::string> free = unmoved(remedy);
  if (free.empty()) return;
  const std::string by = remedy.engine == remedy.own_engine ? "" : fmt::format(" (engine {})", remedy.engine);
  lines.add(fmt::format("{} any {} from a fifth to five times the present value{}", lead(), alternatives(free), by));
}

std::string pair_text(const Remedy& remedy, const RemedyPair& pair) {
  const auto value = [&](const char* name, double factor) {
    const auto key = std::ranges::find_if(remedy_keys(), [&](const RemedyKey& k) { return std::string(name) == k.name; });
    return fmt::format("{} {}{}{}", name, has_value(remedy, *key) ? "" : "of ", value_text(remedy, *key, factor),
                       before(remedy, *key));
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
    lines.add(
        fmt::format("no {} from a fifth to five times the present value makes it feasible alone{}", alternatives(names), grid),
        lines.lines.empty() ? Tone::bad : Tone::plain);
  }
  if (remedy.ratings_suffice) return;
  for (const std::string& rating : ratings)
    lines.add("the present motion also needs " + rating + ", which alone does not suffice");
}

/// Reason of a refusal without the value that the line states: `expected 0 to 1.5 rad` of `amplitude is 2 rad; expected 0 to
/// 1.5 rad`.
std::string reason(const std::string& refused) {
  constexpr std::string_view kExpected = "; expected ";
  const std::size_t end = refused.find(kExpected);
  return end == std::string::npos ? refused : refused.substr(end + 2);
}

/// `amplitude is tried only up to 1.196 rad, because 1.894 rad is refused: expected 0 to 1.5 rad`
std::string refusal(const Remedy& remedy, const RemedyAnswer& answer) {
  const RemedyKey& key = *answer.key;
  return fmt::format("{} {} tried only {} {}, because {} is refused: {}", subject(remedy, key),
                     key.paths.size() > 1 ? "are" : "is", answer.up ? "up to" : "down to",
                     value_text(remedy, key, answer.until), value_text(remedy, key, answer.refused_at), reason(answer.refused));
}

/// Lines on a search that was interrupted: the answers without a confirming run, and the settings that were not tried to the
/// end.
void add_interruption(const Remedy& remedy, Lines& lines) {
  std::vector<std::string> untried;
  for (const RemedyAnswer& answer : remedy.answers) {
    if (answer.stopped && !answer.crosses)
      untried.push_back(fmt::format("{} {}", answer.up ? "larger" : "smaller", subject(remedy, *answer.key)));
    if (!answer.stopped || !answer.crosses) continue;
    lines.add(remedy.word == Word::feasible ? "probably stays feasible with " + reserve(remedy, answer)
                                            : "probably feasible with " + change(remedy, answer),
              Tone::doubtful);
  }
  if (std::ranges::none_of(remedy.answers, &RemedyAnswer::stopped)) untried.emplace_back("frequency and amplitude together");
  const char* const shown = lines.lines.empty() ? "which show no answer yet" : "on which the lines above rest";
  std::string text = fmt::format("interrupted after {}, {}", counted(remedy.runs, "run"), shown);
  if (!untried.empty()) text += fmt::format("; not tried to the end: {}", fmt::join(untried, ", "));
  lines.add(text, Tone::doubtful);
}

/// Lines on answers that are not confirmed, and on values that the scenario cannot have.
void add_open(const Remedy& remedy, Lines& lines) {
  for (const RemedyAnswer& answer : remedy.answers) {
    if (answer.crosses && !answer.confirmed && !answer.stopped) {
      const std::string why = answer.less_suffices   ? "a smaller change also makes it feasible"
                              : answer.run.simulated ? clause(answer.run.weakest)
                                                     : "next to no change";
      lines.add(fmt::format("not confirmed by engine {}: {}: {}", remedy.own_engine, change(remedy, answer), why),
                Tone::doubtful);
    }
    if (!answer.refused.empty()) lines.add(refusal(remedy, answer));
  }
  std::vector<std::string> lacking;
  for (const RemedyLack& lack : remedy.lacking)
    lacking.push_back(fmt::format("{} ({})", subject(remedy, *lack.key), lack.reason));
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
  if (remedy.interrupted) add_interruption(remedy, lines);
  add_open(remedy, lines);
  if (remedy.finer.empty() || remedy.word == Word::not_judged) return lines.lines;
  Lines all;
  all.add(fmt::format("with {} the run is accurate enough, and {}; starting from these settings:", fmt::join(remedy.finer, " "),
                      name_of(remedy.word)));
  for (const ScreenLine& line : lines.lines) all.add(line.text, line.tone);
  return all.lines;
}

}  // namespace gaitlab::report
