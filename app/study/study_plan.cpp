// Output of option --dry-run: the runs of a study and their estimated duration.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "app/gait/run_time.h"
#include "app/study/study_quantities.h"
#include "app/study/study_run.h"
#include "core/errors.h"
#include "core/settings/wording.h"
#include "report/verdict/warnings.h"
#include "studies/plan/plan_checks.h"

namespace gaitlab::app {

namespace {

/// Real time of a run on one thread, s, measured with one pack of runs, from all scenarios if there are several. It is only
/// printed, because it depends on the clock.
double seconds_of_run(const studies::Plan& plan, const StudyRunArguments& a, bool searched) {
  const studies::Points& points = plan.points();
  std::uint64_t next = 0;
  std::uint64_t ended = 0;
  std::atomic<bool> stop = false;
  const auto start = std::chrono::steady_clock::now();
  const studies::Measure measure = quantity_measure(plan.columns(), plan.scenario());
  const std::uint64_t pack = std::min<std::uint64_t>(points.runs(), 8);
  const auto timed = [&](std::uint64_t k) {
    return searched ? plan.scenarios()[k % plan.scenarios().size()].nominal : plan.scenario(k * points.runs() / pack);
  };
  const BatchStream stream{.next = [&]() -> std::optional<Rollout> {
                             while (next < pack) {
                               const std::uint64_t run = next++;
                               try {
                                 return Rollout{run, timed(run)};
                               } catch (const InputError&) {  // the refused run will be a row of the study
                               }
                             }
                             return {};
                           },
                           .end =
                               [&](std::vector<RolloutEnd>&& pack) {
                                 for (const RolloutEnd& one : pack) {
                                   if (one.refused.empty()) (void)measure(one.rollout.scenario, one.recording);
                                   ++ended;
                                 }
                               }};
  run_pulled(stream, {1, static_cast<std::size_t>(a.lanes)}, measure.reads, stop);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  return ended == 0 ? 0 : took.count() / static_cast<double>(ended);
}

}  // namespace

void print_plan(const studies::Plan& plan, const StudyRunArguments& a) {
  const studies::Points& points = plan.points();
  const bool searched = studies::is_search(plan.study().method);  // the points of a search are not known yet
  const auto shown = [&](std::uint64_t run) {
    const std::string& name = plan.scenarios()[points.scenario(run)].name;
    return fmt::format("{}{}", name.empty() ? "" : "scenario " + name + ": ", fmt::join(plan.sets(run), " "));
  };
  double simulated = 0;
  for (const studies::StudyScenario& one : plan.scenarios())
    simulated += one.nominal.duration * static_cast<double>(points.points() * points.replicates());
  fmt::print("{} runs: {} points, {} each\n", points.runs(), points.points(), counted(points.runs_of_point(), "run"));
  if (searched) {
    fmt::print("method {} chooses the points, and the best {} are simulated again\n", name_of(plan.study().method),
               plan.study().verify.best);
  } else {
    fmt::print("first  {}\nlast   {}\n", shown(0), shown(points.runs() - 1));
  }
  fmt::print("{:.6g} s simulated in all\n", simulated);
  const double each = seconds_of_run(plan, a, searched);
  const double all = each * static_cast<double>(points.runs());
  const double bytes = static_cast<double>(points.runs()) *
                       (120 + 9.0 * static_cast<double>(plan.columns().size() + plan.study().parameters.size()));
  fmt::print("takes {} on {} ({:.3g} s per run on one thread)\n", about(all / study_threads(a.jobs)),
             counted(static_cast<std::size_t>(study_threads(a.jobs)), "thread"), each);
  fmt::print("journal about {:.3g} MB\n", bytes / 1e6);
  if (searched) return;            // shards are not suggested for a search: each generation waits for the previous one
  constexpr double kShard = 1800;  // s
  fmt::print("shards of 30 min on one thread: {}\n", static_cast<std::uint64_t>(std::max(1.0, std::ceil(all / kShard))));
}

void note_engine(const studies::Plan& plan, const StudyRunArguments& a, bool quiet) {
  if (quiet) return;
  const studies::Points& points = plan.points();
  const double each = static_cast<double>(points.points() * points.replicates()) / study_threads(a.jobs);
  const auto time_of = [&](std::span<const Scenario> scenarios) {
    double sum = 0;
    for (const Scenario& s : scenarios) sum += each * estimated_seconds_in_study(s);
    return sum;
  };
  const auto with = [&](const std::vector<std::string>& sets) {
    std::vector<Scenario> scenarios;
    for (std::size_t k = 0; k < plan.scenarios().size(); ++k) scenarios.push_back(plan.with(sets, k));
    return scenarios;
  };
  const std::vector<Scenario> own = with({});
  const double seconds = time_of(own);
  const std::string advice = faster_engine(own, seconds, time_of, with);
  if (!advice.empty()) say(own.front().file, "note", time_text(seconds, advice));
}

void warn_of_scenarios(const studies::Plan& plan) {
  std::vector<std::string> said;  // scenarios of a study often share a module type
  for (const studies::StudyScenario& one : plan.scenarios()) {
    for (const report::Warning& doubt : report::setup_warnings(one.nominal)) {
      const std::string place = to_string(doubt.place);
      if (!doubt.severe || doubt.of_gait || std::ranges::find(said, place + doubt.text) != said.end()) continue;
      said.push_back(place + doubt.text);
      say(place, "warning", doubt.text);
    }
  }
}

void print_notes(const studies::Plan& plan, bool quiet) {
  warn_of_scenarios(plan);
  if (quiet) return;
  for (const Problem& note : plan.study().notes) say(to_string(note.place), "note", note.text);
  for (const Problem& note : studies::short_runs(plan)) say(to_string(note.place), "note", note.text);
  if (const std::optional<Problem>& cause = plan.bound().not_own())
    say(to_string(cause->place), "note", "the search does not begin with the scenario's own gait: " + cause->text);
  for (const Problem& note : studies::refused_ends(plan)) say(to_string(note.place), "note", note.text);
}

}  // namespace gaitlab::app
