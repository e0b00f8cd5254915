#include "golden/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/settings/changed_lines.h"

namespace gaitlab::golden {

namespace {

constexpr std::size_t kMostShown = 10;
constexpr double kBandChange = 1.2;  // times: less is not news

// Those to show, by falling ratio where they are the worst, else in the golden's order.
template <class Check>
std::vector<const Check*> chosen(const std::vector<Check>& checks, Shown shown) {
  std::vector<const Check*> some;
  for (const Check& check : checks) {
    if (shown == Shown::worst ? check.ratio() != 0 : !check.passed()) some.push_back(&check);
  }
  if (shown == Shown::failing) return some;
  std::stable_sort(some.begin(), some.end(), [](const Check* a, const Check* b) { return a->ratio() > b->ratio(); });
  some.resize(std::min(some.size(), kMostShown));
  return some;
}

template <class Check>
std::size_t failing(const std::vector<Check>& checks) {
  return static_cast<std::size_t>(std::count_if(checks.begin(), checks.end(), [](const Check& c) { return !c.passed(); }));
}

template <class Check>
std::size_t width(const std::vector<const Check*>& checks, std::size_t least) {
  for (const Check* check : checks) least = std::max(least, check->name.size());
  return least;
}

std::string table(const std::vector<const ColumnCheck*>& columns) {
  if (columns.empty()) return "";
  const std::size_t name = width(columns, 6);
  std::string text = fmt::format("  {:<{}} {:>11} {:>11} {:>9} {:>11} {:>13}  {}\n", "column", name, "RMS/range", "band",
                                 "RMS/band", "max/range", "outside from", "late by");
  for (const ColumnCheck* c : columns) {
    const std::string from = c->outside ? fmt::format("{:.6g} s", *c->outside) : "never";
    const std::string late =
        c->time_shift == 0 ? "-" : fmt::format("{:+.4g} s, then {}", c->time_shift, percent(c->rms_after_shift));
    text += fmt::format("  {:<{}} {:>11} {:>11} {:>9} {:>11} {:>13}  {}\n", c->name, name, percent(c->rms), percent(c->band),
                        bands(c->ratio()), percent(c->maximum), from, late);
  }
  return text;
}

std::string table(const std::vector<const NumberCheck*>& numbers) {
  if (numbers.empty()) return "";
  const std::size_t name = width(numbers, 6);
  std::string text = fmt::format("  {:<{}} {:>13} {:>13} {:>11} {:>11} {:>11}  {}\n", "number", name, "golden", "now", "change",
                                 "band", "change/band", "unit");
  for (const NumberCheck* n : numbers) {
    text += fmt::format("  {:<{}} {:>13.7g} {:>13.7g} {:>11} {:>11} {:>11}  {}\n", n->name, name, n->golden, n->now,
                        percent(n->change), percent(n->band), bands(n->ratio()), n->unit);
  }
  return text;
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

std::string origin_changes(const Golden& golden, const GoldenProvenance& now) {
  const GoldenProvenance& then = golden.origin;
  std::string text;
  const auto add = [&](const char* what, const auto& before, const auto& after) {
    if (before != after) text += fmt::format("  {}: then {}, now {}\n", what, before, after);
  };
  add("build", then.build, now.build);
  add("compiler", then.compiler, now.compiler);
  add("name", then.name, now.name);
  add("engine", then.engine, now.engine);
  add("integrator", then.integrator, now.integrator);
  add("step", then.step, now.step);
  if (then.scenario == now.scenario) return text;
  text += "  scenario: its resolved text is another";
  if (then.resolved.empty()) return text + "\n";
  return text + fmt::format(":\n    {}\n", fmt::join(changed_lines(then.resolved, now.resolved), "\n    "));
}

std::string band_changes(const Golden& before, const Golden& now) {
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
    if (j < before.bands.size()) add(now.run.trace.columns[i].name, before.bands[j], now.bands[i]);
  }
  for (std::size_t i = 0; i < now.numbers.size(); ++i) {
    for (std::size_t j = 0; j < before.numbers.size(); ++j) {
      if (before.numbers[j].name == now.numbers[i].name) add(now.numbers[i].name, before.number_bands[j], now.number_bands[i]);
    }
  }
  std::stable_sort(changes.begin(), changes.end(), [](const Change& a, const Change& b) { return a.size() > b.size(); });
  std::string text;
  for (std::size_t i = 0; i < std::min(changes.size(), kMostShown); ++i)
    text += fmt::format("  band of {}: then {}, now {}\n", changes[i].name, percent(changes[i].then), percent(changes[i].now));
  if (changes.size() > kMostShown) text += fmt::format("  ... and {} more bands\n", changes.size() - kMostShown);
  return text;
}

std::size_t strayed_columns(const GoldenDifference& difference) { return failing(difference.columns); }

std::string outside(const GoldenDifference& d) {
  return fmt::format("{} of {} and {} of {} outside their bands", failing(d.columns), plural(d.columns.size(), "column"),
                     failing(d.numbers), plural(d.numbers.size(), "number")) +
         (d.findings.empty() ? "" : ", and a run of another form");
}

std::string differences(const GoldenDifference& difference, Shown shown) {
  std::string text;
  for (const std::string& finding : difference.findings) text += "  " + finding + "\n";
  text += table(chosen(difference.columns, shown));
  text += table(chosen(difference.numbers, shown));
  return text;
}

}  // namespace gaitlab::golden
