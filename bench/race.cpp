#include "bench/race.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/model/pattern.h"
#include "core/scenario/read_scenario.h"

namespace gaitlab::versus {

namespace {

/// A contender at one step, with the scenarios of its lanes and its references.
struct Runner {
  RacePoint point;
  std::vector<Scenario> lanes;
  const Converged* reference = nullptr;
  const Converged* bullet = nullptr;  ///< reference kOther
};

class Race {
 public:
  Race(const RaceSettings& settings, Catalog& catalog) : settings_(settings), catalog_(catalog) {}

  RaceResults run() {
    const ContenderField all = field(catalog_, results_.left_out);
    for (const std::string& file : settings_.scenarios) run(file, all);
    return std::move(results_);
  }

 private:
  void run(const std::string& file, const ContenderField& all) {
    const std::string name = scenario(file, {}, 0).name;  // throws the errors of the scenario file
    std::vector<const Contender*> contenders;
    for (const Contender& c : all.contenders) {
      const bool named = std::ranges::any_of(settings_.only, [&](const std::string& p) { return glob(p, c.name); });
      if (named) contenders.push_back(&c);
    }
    // The memory is reserved, so that pointers to the elements remain valid.
    std::vector<Converged> references;
    references.reserve(all.references.size());
    for (const Reference& r : all.references) {
      const bool wanted =
          std::ranges::any_of(contenders, [&](const Contender* c) { return c->reference == r.name || r.name == kOther; });
      if (wanted) converge(file, name, r, references);
    }
    if (!contenders.empty() && find(references, kOther) == nullptr) {
      results_.left_out.push_back(
          fmt::format("{}: travel and contact force are not checked, for want of reference {}", name, kOther));
    }
    std::vector<Runner> runners;
    for (const Contender* c : contenders) enter(file, name, *c, references, runners);
    for (int round = 0; round < settings_.rounds; ++round) {
      settings_.say(fmt::format("{}: round {} of {}", name, round + 1, settings_.rounds));
      for (std::size_t i = 0; i < runners.size(); ++i) {
        // The order is rotated by a stride that divides no likely number of runners, so that the neighbours of a runner change
        // from round to round.
        step(runners[(i + static_cast<std::size_t>(round) * 7) % runners.size()]);
      }
    }
    for (Runner& r : runners) results_.points.push_back(std::move(r.point));
    for (Converged& r : references) results_.references.push_back(std::move(r));
  }

  Scenario scenario(const std::string& file, const std::vector<std::string>& own, double step) {
    std::vector<std::string> sets = settings_.sets;
    sets.insert(sets.end(), own.begin(), own.end());
    sets.push_back(fmt::format("duration={}", settings_.seconds));
    sets.emplace_back("trace.columns=[joint.*]");
    if (step > 0) sets.push_back(fmt::format("physics.step={}", step));
    return read_scenario(file, sets, catalog_);
  }

  void converge(const std::string& file, const std::string& name, const Reference& r, std::vector<Converged>& references) {
    try {
      Torques before;
      Converged converged{name, r.name, r.steps.back(), {}, {}, {}};
      for (const double step : r.steps) {
        settings_.say(fmt::format("{}: reference {}, step {} s", name, r.name, step));
        before = std::move(converged.torques);
        TimedRun measured = measure({scenario(file, r.sets, step)}, 0);
        converged.torques = std::move(measured.torques);
        converged.course = measured.course;
      }
      if (const Converged* bullet = find(references, kOther)) {
        const std::string reason = strays(converged.course, bullet->course);
        if (!reason.empty()) throw RunError(reason);
      }
      converged.left = torque_error(before, converged.torques, settings_.seconds / 2);
      references.push_back(std::move(converged));
    } catch (const std::runtime_error& error) {
      results_.left_out.push_back(fmt::format("{}: reference {}: {}", name, r.name, error.what()));
    }
  }

  static const Converged* find(const std::vector<Converged>& references, const std::string& name) {
    const auto at = std::ranges::find(references, name, &Converged::name);
    return at == references.end() ? nullptr : &*at;
  }

  /// Adds a benchmark for each time step of a contender. Every lane has different motor values, because rollouts of a study
  /// differ, too.
  void enter(const std::string& file, const std::string& name, const Contender& c, const std::vector<Converged>& references,
             std::vector<Runner>& runners) {
    const Converged* reference = find(references, c.reference);
    if (reference == nullptr) return;  // the reason has been reported
    for (const double step : c.steps) {
      Runner runner;
      runner.point = {name, c.name, c.group, step, c.lanes, settings_.seconds * static_cast<double>(c.lanes), {}, {},
                      {},   {},     {},      {},   {}};
      runner.reference = reference;
      runner.bullet = find(references, kOther);
      try {
        for (std::size_t lane = 0; lane < c.lanes; ++lane) {
          std::vector<std::string> sets = c.sets;
          if (lane > 0) sets.push_back(fmt::format("actuator.R={}", 4.3 + 0.1 * static_cast<double>(lane)));
          runner.lanes.push_back(scenario(file, sets, step));
        }
      } catch (const InputError& error) {
        runner.point.note = error.what();
      }
      runners.push_back(std::move(runner));
    }
  }

  void step(Runner& r) const {
    RacePoint& p = r.point;
    if (!p.note.empty()) return;
    try {
      const TimedRun measured = measure(r.lanes, settings_.least);
      p.course = measured.course;
      if (r.bullet != nullptr) p.note = strays(p.course, r.bullet->course);
      if (!p.note.empty()) return;
      p.wall.push_back(measured.timing.wall);
      p.cpu.push_back(measured.timing.cpu);
      if (p.wall.size() > 1) return;  // repetitions of a run have equal torques
      p.error = torque_error(measured.torques, r.reference->torques, settings_.seconds / 2);
      p.worst_joint = r.lanes[0].robot->joints[p.error.joint].name;
      if (p.group == ContenderGroup::ours && r.bullet != nullptr) {
        p.other = torque_error(measured.torques, r.bullet->torques, settings_.seconds / 2);
      }
    } catch (const std::runtime_error& error) {  // the step is refused, or the run diverged
      p.note = error.what();
    }
  }

  const RaceSettings& settings_;
  Catalog& catalog_;
  RaceResults results_;
};

}  // namespace

double RacePoint::slowest() const { return seconds / *std::ranges::max_element(wall); }
double RacePoint::fastest() const { return seconds / *std::ranges::min_element(wall); }

const RacePoint* RaceResults::fastest(const std::string& scenario, ContenderGroup group, double error) const {
  const RacePoint* best = nullptr;
  for (const RacePoint& p : points) {
    if (p.scenario != scenario || p.group != group || !p.ran() || p.error.worst > error) continue;
    if (best == nullptr || p.cpu_speed() > best->cpu_speed()) best = &p;
  }
  return best;
}

RaceResults race(const RaceSettings& settings, Catalog& catalog) { return Race(settings, catalog).run(); }

}  // namespace gaitlab::versus
