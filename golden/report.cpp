#include "golden/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/recording/column_names.h"
#include "core/settings/changed_settings.h"
#include "core/settings/wording.h"

namespace gaitlab::golden {

namespace {

constexpr std::size_t kMostShown = 10;
constexpr std::size_t kMostFindings = 5;
constexpr double kBandChange = 1.2;  // factor; smaller changes are not reported

template <class Check>
using Checks = std::vector<const Check*>;

/// Sorts by the deviation in bands, largest first. NaN is the largest.
template <class Check>
Checks<Check> ordered(Checks<Check> checks) {
  const auto size = [](const Check* check) { return std::isnan(check->ratio()) ? INFINITY : check->ratio(); };
  std::stable_sort(checks.begin(), checks.end(), [&](const Check* a, const Check* b) { return size(a) > size(b); });
  return checks;
}

template <class Check>
Checks<Check> strayed(const std::vector<Check>& checks) {
  Checks<Check> some;
  for (const Check& check : checks) {
    if (!check.passed()) some.push_back(&check);
  }
  return ordered(some);
}

template <class Check>
Checks<Check> worst(Checks<Check> checks) {
  checks.resize(std::min(checks.size(), kMostShown));
  return checks;
}

template <class Check>
Checks<Check> changed(const std::vector<Check>& checks) {
  Checks<Check> some;
  for (const Check& check : checks) {
    if (check.ratio() != 0) some.push_back(&check);
  }
  return worst(ordered(some));
}

std::string with_its_unit(double value, int digits, const std::string& unit) {
  return fmt::format("{:.{}g}{}{}", value, digits, unit.empty() ? "" : " ", unit);
}

std::string table(const Checks<ColumnCheck>& columns) {
  if (columns.empty()) return "";
  std::vector<std::vector<std::string>> rows{
      {"column", "RMS off by", "of its range", "band", "in bands", "outside from", "late by"}};
  for (const ColumnCheck* c : columns) {
    const std::string share = percent(c->rms) + (c->constant ? " of " + with_its_unit(c->scale, 3, c->unit) : "");
    rows.push_back({c->label, with_its_unit(c->rms * c->scale, 3, c->unit), share, percent(c->band), bands(c->ratio()),
                    c->outside ? fmt::format("{:.4g} s", *c->outside) : "never",
                    c->time_shift == 0 ? "-" : fmt::format("{:+.3g} s", c->time_shift)});
  }
  return aligned(rows, 2);
}

std::string table(const Checks<NumberCheck>& numbers) {
  if (numbers.empty()) return "";
  std::vector<std::vector<std::string>> rows{{"number", "golden", "now", "change", "band", "in bands"}};
  for (const NumberCheck* n : numbers) {
    rows.push_back({n->label, with_its_unit(n->golden, 6, n->unit), with_its_unit(n->now, 6, n->unit), percent(n->change),
                    percent(n->band), bands(n->ratio())});
  }
  return aligned(rows, 2);
}

std::string sentence(const BoundCheck& bound) {
  const std::string log = bound.log.empty() ? "the log" : "log " + in_quotes(bound.log);
  if (std::isnan(bound.value)) return fmt::format("{} is not known: the run covers fewer than two rows of {}", bound.name, log);
  return fmt::format("{} is {}, its bound {} ({})", bound.name, with_its_unit(bound.value, 6, bound.unit),
                     with_its_unit(bound.most, 6, bound.unit), log);
}

/// Number that represents all numbers next to a table of columns: the distance, or else the worst number. Null if all numbers
/// are within their bands.
const NumberCheck* first_number(const Checks<NumberCheck>& numbers) {
  const auto distance = std::find_if(numbers.begin(), numbers.end(), [](const auto* n) { return n->name == "distance"; });
  if (distance != numbers.end()) return *distance;
  return numbers.empty() ? nullptr : numbers.front();
}

std::string brief(const GoldenDifference& difference) {
  const Checks<ColumnCheck> columns = strayed(difference.columns);
  const Checks<NumberCheck> numbers = strayed(difference.numbers);
  if (columns.empty()) return table(worst(numbers));
  std::string text = table(worst(columns));
  if (const NumberCheck* n = first_number(numbers); n != nullptr) {
    text += fmt::format("  {}: {:.6g} -> {}, {} bands\n", n->label, n->golden, with_its_unit(n->now, 6, n->unit),
                        bands(n->ratio()));
  }
  return text;
}

/// Text such as `0.1.0+abc` from `0.1.0+abc (GNU 12.2.0; Bullet 3.24)`, if the text after it is the same in both builds.
std::string build_change(const std::string& then, const std::string& now) {
  const auto rest = [](const std::string& build) { return build.substr(std::min(build.find(" ("), build.size())); };
  const std::string same = rest(then) == rest(now) ? rest(then) : "";
  return fmt::format("  build: {} -> {}\n", then.substr(0, then.size() - same.size()), now.substr(0, now.size() - same.size()));
}

}  // namespace

std::string percent(double share) { return fmt::format("{:.3g} %", 100 * share); }

std::string bands(double ratio) { return ratio < 1000 ? fmt::format("{:.3g}", ratio) : fmt::format("{:.0f}", ratio); }

std::string parts(const Band& band) {
  return fmt::format("max(ensemble {}, halving {}, floor {})", percent(band.ensemble), percent(band.halving),
                     percent(band.floor));
}

std::string plural(std::size_t count, const std::string& what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

std::string since_approval(const Golden& golden) {
  return fmt::format("since approval {} ({}):\n", golden.history.back().number, golden.history.back().reason);
}

std::string origin_changes(const GoldenProvenance& then, const GoldenProvenance& now, std::size_t most) {
  std::string text = then.build == now.build ? "" : build_change(then.build, now.build);
  if (then.scenario == now.scenario) return text;
  if (!then.resolved.empty()) {
    for (const std::string& setting : changed_settings(then.resolved, now.resolved, most)) text += "  " + setting + "\n";
    return text;
  }
  const auto add = [&](const char* what, const auto& before, const auto& after) {
    if (before != after) text += fmt::format("  {}: {} -> {}\n", what, before, after);
  };
  add("name", then.name, now.name);
  add("engine", then.engine, now.engine);
  add("integrator", then.integrator, now.integrator);
  add("step", then.step, now.step);
  return text + "  the scenario has changed; the golden does not contain the approved scenario, which is not UTF-8\n";
}

std::string verdict_change(const Golden& golden, const GoldenRun& run, std::size_t width) {
  if (!run.verdict || golden.verdict == run.verdict) return "";
  const std::string words = fmt::format("verdict: {} -> {}", name_of(golden.verdict), name_of(*run.verdict));
  return wrapped(run.why.empty() ? words : words + ": " + run.why, 2, width);
}

std::string band_changes(const Golden& before, const Golden& now, const std::vector<std::string>& joints) {
  struct Change {
    std::string name;
    double then, now;
    [[nodiscard]] double size() const { return std::abs(std::log(now / then)); }
  };
  std::vector<Change> changes;
  const auto add = [&](const std::string& name, const Band& then, const Band& band) {
    const Change change{name, then.width(), band.width()};
    if (change.size() > std::log(kBandChange)) changes.push_back(change);
  };
  for (std::size_t i = 1; i < now.bands.size(); ++i) {
    const std::size_t j = before.run.trace.find(now.run.trace.columns[i].name);
    if (j < before.bands.size())
      add(readable_column(now.run.trace.columns[i].name, {joints, {}}), before.bands[j], now.bands[i]);
  }
  for (std::size_t i = 0; i < now.numbers.size(); ++i) {
    for (std::size_t j = 0; j < before.numbers.size(); ++j) {
      if (before.numbers[j].name == now.numbers[i].name)
        add(readable_number(now.numbers[i].name), before.number_bands[j], now.number_bands[i]);
    }
  }
  std::stable_sort(changes.begin(), changes.end(), [](const Change& a, const Change& b) { return a.size() > b.size(); });
  std::string text;
  for (std::size_t i = 0; i < std::min(changes.size(), kMostShown); ++i)
    text += fmt::format("  band of {}: then {}, now {}\n", changes[i].name, percent(changes[i].then), percent(changes[i].now));
  if (changes.size() > kMostShown) text += fmt::format("  ... and {} more bands\n", changes.size() - kMostShown);
  return text;
}

std::size_t strayed_columns(const GoldenDifference& difference) { return strayed(difference.columns).size(); }

std::string outside(const GoldenDifference& d) {
  const std::size_t beyond = strayed(d.bounds).size();
  const std::string bounds = beyond == 0 ? "" : fmt::format("{} of {} exceeded", beyond, plural(d.bounds.size(), "bound"));
  if (d.columns.empty() && d.numbers.empty() && d.findings.empty() && beyond > 0) return bounds;
  return fmt::format("{} of {} and {} of {} outside their bands", strayed(d.columns).size(), plural(d.columns.size(), "column"),
                     strayed(d.numbers).size(), plural(d.numbers.size(), "number")) +
         (bounds.empty() ? "" : ", " + bounds) + (d.findings.empty() ? "" : ", and other differences");
}

std::string differences(const GoldenDifference& difference, Shown shown) {
  const std::vector<std::string>& findings = difference.findings;
  const std::size_t told = shown == Shown::brief ? std::min(findings.size(), kMostFindings) : findings.size();
  std::string text;
  for (std::size_t i = 0; i < told; ++i) text += "  " + findings[i] + "\n";
  if (told < findings.size()) text += fmt::format("  ... and {} more like these\n", findings.size() - told);
  for (const BoundCheck* bound : strayed(difference.bounds)) text += "  " + sentence(*bound) + "\n";
  switch (shown) {
    case Shown::brief:
      return text + brief(difference);
    case Shown::strayed:
      return text + table(strayed(difference.columns)) + table(strayed(difference.numbers));
    case Shown::changed:
      break;
  }
  return text + table(changed(difference.columns)) + table(changed(difference.numbers));
}

std::size_t left_out(const GoldenDifference& difference) {
  const std::size_t columns = strayed(difference.columns).size();
  const std::size_t numbers = strayed(difference.numbers).size();
  const std::size_t numbers_named = columns == 0 ? kMostShown : 1;
  return columns - std::min(columns, kMostShown) + numbers - std::min(numbers, numbers_named);
}

}  // namespace gaitlab::golden
