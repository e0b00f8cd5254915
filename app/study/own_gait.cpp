// Trial run of a scenario's own settings before a study, which shows the error caused by the step.
#include "app/study/own_gait.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "app/app.h"
#include "app/shell/stop_on_signal.h"
#include "app/study/study_progress.h"
#include "app/study/study_quantities.h"
#include "core/errors.h"
#include "core/settings/wording.h"
#include "core/simulation/batch.h"
#include "report/verdict/numbers/number_texts.h"
#include "report/verdict/trust.h"
#include "studies/search/step_limit.h"

namespace gaitlab::app {

namespace {

constexpr double kMuch = 0.005;  // relative error of the objective above which a remedy is printed

struct Way {
  std::vector<std::string> sets;
  std::optional<double> objective = {};  ///< first objective of the study; nothing if the run was refused or failed, or the
                                         ///< objective is not known
  report::TorqueError error = {};
};

/// The runs of the scenario: with the step of the study, with half of it, and with an adaptive step.
std::vector<Way> ways(const Scenario& own) {
  std::vector<Way> all{{{}}};
  if (own.physics.adapts()) return all;
  all.push_back({{"physics.step=" + number_text(own.physics.step / 2)}});
  const Integrator* const adaptive = own.physics.engine->adaptive();
  if (adaptive != nullptr && !own.contact.model().has_step_of_its_own)
    all.push_back({{"physics.step=auto", std::string("physics.integrator=") + adaptive->name}});
  return all;
}

/// Simulates all ways. Returns false if the program was stopped.
bool try_all(const studies::Plan& plan, std::size_t scenario, std::vector<Way>& all) {
  const studies::Measure measure = quantity_measure(plan.columns(), plan.scenario());
  std::vector<Scenario> tried;
  std::vector<Way*> of;
  for (Way& way : all) {
    try {
      tried.push_back(plan.with(way.sets, scenario));
      of.push_back(&way);
    } catch (const InputError&) {  // the engine refuses this step
    }
  }
  AgainProgress progress(false, "scenario's own gait");
  std::size_t done = 0;
  return run_all(tried, {}, measure.reads, stopped(), [&](std::size_t k, RolloutEnd&& end) {
    progress(++done, tried.size());
    if (!end.refused.empty() || !end.recording.outcome.done()) return;
    const studies::RunMeasured measured = measure(end.rollout.scenario, end.recording);
    const double value = plan.scorer().score(measured.quantities, measured.verdict).objective();
    if (std::isfinite(value)) of[k]->objective = value;
    of[k]->error = report::torque_error(end.recording);
  });
}

/// Relative error of a value against the limit of vanishing steps.
struct Cost {
  double limit;
  [[nodiscard]] double of(double value) const { return std::abs(value - limit) / std::abs(limit); }
};

std::string text(const studies::Plan& plan, const Scenario& own, const std::vector<Way>& all) {
  const Way& given = all.front();
  const std::string error =
      given.error.estimated ? ", and the torque error is about " + report::texts::rough_percent(given.error.share) : "";
  const bool known = given.objective && all.size() > 1 && all[1].objective;
  const bool much = given.error.estimated && !(given.error.share <= report::torque_error_limit(own));
  if (!known) {
    return much ? "the torque error of the scenario's own gait is about " + report::texts::rough_percent(given.error.share)
                : "";
  }
  const Cost cost{studies::step_limit(*given.objective, *all[1].objective, std::max(1, own.physics.integrator->order))};
  if (!(std::abs(cost.limit) > 0)) return "";
  const std::string& objective = plan.scorer().objectives().front();
  std::string said =
      fmt::format("step {} s causes an error of {} in {} for the scenario's own gait", number_text(own.physics.step),
                  report::texts::rough_percent(cost.of(*given.objective)), clipped(objective));
  const bool chooses = all.size() > 2 && all[2].objective;
  if (chooses) said += ", auto " + report::texts::rough_percent(cost.of(*all[2].objective));
  said += error;
  if (cost.of(*given.objective) > kMuch)
    said += chooses ? ": take physics.step: auto" : ": take physics.step: " + number_text(own.physics.step / 2);
  return said;
}

}  // namespace

void print_own_gait(const studies::Plan& plan, bool quiet) {
  if (quiet) return;
  for (std::size_t k = 0; k < plan.scenarios().size(); ++k) {
    const Scenario& own = plan.scenarios()[k].nominal;
    std::vector<Way> all = ways(own);
    if (!try_all(plan, k, all)) return;
    const std::string said = text(plan, own, all);
    if (!said.empty()) say(own.file, "note", said);
  }
}

}  // namespace gaitlab::app
