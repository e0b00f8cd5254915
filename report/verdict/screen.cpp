#include "report/verdict/screen.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/settings/wording.h"
#include "report/analysis/bus.h"
#include "report/analysis/changes.h"
#include "report/analysis/posture.h"
#include "report/verdict/demand.h"
#include "report/verdict/numbers/number_texts.h"

namespace gaitlab::report {

namespace {

constexpr std::size_t kTitle = 10;

class Screen {
 public:
  explicit Screen(std::size_t columns) : columns_(columns) {}
  void add(const std::string& title, const std::string& text, Tone tone = Tone::plain) {
    const std::string broken = wrapped(text, 0, columns_ - kTitle - 2);
    std::string head = title;
    for (std::size_t at = 0; at < broken.size();) {
      const std::size_t end = std::min(broken.find('\n', at), broken.size());
      lines.push_back({head, broken.substr(at, end - at), tone});
      head.clear();
      at = end + 1;
    }
  }
  std::vector<ScreenLine> lines;

 private:
  std::size_t columns_;
};

/// Ids of checks. The four checks of dock loads are replaced by one word if none of them is judged.
std::string names(const std::vector<const Check*>& checks, std::size_t from = 0) {
  constexpr std::ptrdiff_t kOfDocks = 4;  // tension, shear, bending, torsion
  const auto open_dock = [](const Check* check) {
    return check->id.starts_with("dock_") && check->status == CheckStatus::not_judged;
  };
  const bool no_dock = std::ranges::count_if(checks, open_dock) == kOfDocks;
  std::vector<std::string> ids;
  bool docks = false;
  for (std::size_t k = from; k < checks.size(); ++k) {
    const bool dock = no_dock && open_dock(checks[k]);
    if (dock && docks) continue;
    docks = docks || dock;
    ids.push_back(dock ? "docks" : checks[k]->id);
  }
  return fmt::format("{}", fmt::join(ids, ", "));
}

std::vector<const Check*> of_status(const Verdict& verdict, CheckStatus status) {
  std::vector<const Check*> found;
  for (const Check& check : verdict.checks) {
    if (check.status == status) found.push_back(&check);
  }
  return found;
}

void add_kind(Screen& screen, const std::vector<const Check*>& checks, std::size_t skip, std::size_t most, const char* title,
              Tone tone) {
  for (std::size_t k = skip; k < checks.size(); ++k) {
    if (k - skip == most) {
      screen.add("", "and " + names(checks, k) + " (--verbose)", tone);
      return;
    }
    screen.add(k == skip ? title : "", checks[k]->sentence(), tone);
  }
}

constexpr double kTurns = 0.1;  // rad; a smaller change of heading shortens the way by less than 0.2 %

std::string gait(const RunData& run) {
  const Summary& s = run.summary;
  if (run.record.series("com.x").empty() || run.scenario.base != Base::floating) return "";
  std::string text = fmt::format("{:.4f} m/s over the run", s.speed);
  if (const double speed = cycle_speed(run.record, s.judged); s.limit_cycle.found && std::isfinite(speed)) {
    const double period = s.limit_cycle.period;
    text += fmt::format(", {:.4f} m per period of {:.4g} s ({:.4f} m/s)", speed * period, period, speed);
  }
  // A gait that turns travels less far in a longer run.
  if (std::abs(s.heading_change) > kTurns) text += fmt::format(", turns by {:+.2f} rad", s.heading_change);
  if (s.cost_electrical == 0 || !has_motors(run)) return text;
  if (texts::lossless(run)) return text + ", cost of transport not meaningful: these motors lose next to nothing";
  text += fmt::format(", cost of transport {:.3g}", s.cost_electrical);
  if (const std::string much = texts::much_created(run); !much.empty()) text += ": " + much;
  return text;
}

/// `42.3 min: 1.8 A h at a mean current of 2.55 A`; empty without a capacity or a current.
std::string endurance_text(const RunData& run) {
  const Endurance least = endurance(run.scenario, run.record, run.summary.judged.first_row);
  if (!std::isfinite(least.minutes)) return "";
  constexpr double kMany = 1000;  // from which on three digits would be a power of ten
  const std::string minutes =
      least.minutes < kMany ? fmt::format("{:.3g}", least.minutes) : fmt::format("{:.0f}", least.minutes);
  return fmt::format("{} min: {:.4g} A h at a mean current of {:.3g} A{}", minutes, least.capacity, least.current,
                     least.module.empty() ? "" : ", battery of " + least.module);
}

Tone tone_of(Word word) { return word == Word::feasible ? Tone::good : word == Word::not_judged ? Tone::doubtful : Tone::bad; }

}  // namespace

std::string tightest_text(const Verdict& verdict) {
  const Check* const check = verdict.tightest();
  if (check == nullptr) return "";
  std::string name = texts::spaced(check->id);
  if (!check->worst.empty()) name += " of " + check->worst;
  return fmt::format("{}, margin {}", name, texts::percent(check->margin));
}

std::vector<ScreenLine> first_screen(const RunData& run, const Verdict& verdict, std::size_t most, std::size_t columns) {
  Screen screen(columns);
  std::string head = name_of(verdict.word);
  if (verdict.word == Word::feasible) {
    head += std::string(" with these motors") + (verdict.chosen_motors ? " (chosen figures)" : "") +
            (verdict.rests_on.empty() ? "" : ", over " + verdict.rests_on);
  } else if (const std::string why = verdict.why(); !why.empty()) {
    head += ": " + why;
  }
  screen.add("verdict", head, tone_of(verdict.word));
  if (!verdict.draws_text.empty()) {
    const bool all = std::ranges::all_of(verdict.draws, [](const Draw& draw) { return draw.word == Word::feasible; });
    screen.add("draws", verdict.draws_text, all ? Tone::good : Tone::bad);
  }
  const bool led = verdict.word == Word::infeasible || verdict.word == Word::failed;  // the deciding check is printed above
  if (const std::string tightest = tightest_text(verdict); !led && verdict.unstable.empty() && !tightest.empty())
    screen.add("tightest", tightest);
  if (!verdict.demand_doubt.empty()) screen.add("demand", verdict.demand_doubt, Tone::doubtful);
  if (verdict.supply_demand) screen.add(verdict.demand_doubt.empty() ? "demand" : "", text_of(*verdict.supply_demand));
  if (!verdict.unstable.empty()) return screen.lines;  // all else follows from it
  add_kind(screen, verdict.failures(), led ? 1 : 0, most, "fails", Tone::bad);
  add_kind(screen, of_status(verdict, CheckStatus::too_close), 0, most, "too close", Tone::doubtful);
  std::vector<const Check*> warnings = of_status(verdict, CheckStatus::warn);
  // `created` is printed beside the cost of transport, and `measured` in a line of its own.
  std::erase_if(warnings, [](const Check* check) { return check->id == "created" || check->id == "measured"; });
  add_kind(screen, warnings, 0, most, "warns", Tone::doubtful);
  std::vector<const Check*> open = of_status(verdict, CheckStatus::not_judged);
  std::erase_if(open, [](const Check* check) { return !check->concerns; });
  if (!open.empty()) screen.add("unknown", names(open) + " (gaitlab explain verdict)");
  if (const std::string text = gait(run); !text.empty()) screen.add("gait", text);
  if (const std::string text = endurance_text(run); !text.empty()) screen.add("endurance", text);
  const auto log = std::ranges::find(verdict.checks, "measured", &Check::id);
  if (log != verdict.checks.end() && log->concerns)
    screen.add("measured", log->text, log->status == CheckStatus::pass ? Tone::plain : Tone::doubtful);
  const char* title = "changes";
  for (const ToldChange& change : told_changes(run.scenario, run.record.simulated)) {
    screen.add(title, fmt::format("{:.4g} s: {}", change.t, change.text));
    title = "";
  }
  for (const std::string& fault : verdict.faults) screen.add("", fault, Tone::doubtful);
  std::vector<std::string> grounds{verdict.figures};
  if (verdict.word != Word::feasible) grounds.push_back(verdict.conditions);  // printed beside the word `feasible`
  std::erase(grounds, "");
  if (!grounds.empty()) screen.add("rests on", fmt::format("{}", fmt::join(grounds, "; ")));
  return screen.lines;
}

}  // namespace gaitlab::report
