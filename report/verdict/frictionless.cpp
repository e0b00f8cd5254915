#include "report/verdict/frictionless.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/simulation/simulation.h"
#include "report/analysis/collisions.h"

namespace gaitlab::report {

std::optional<Word> word_of(const Scenario& scenario, const std::function<void(double)>& progress,
                            const std::atomic<bool>& stop) {
  Recording record;
  try {
    Simulation simulation({&scenario, 1}, kVerdictReads);
    if (!simulation.run(progress, &stop)) return {};
    record = simulation.take_recording(0);
  } catch (const SimulationError&) {
    return Word::failed;
  }
  return verdict(scenario, record, summarise(scenario, record, 0), overlaps(scenario, record)).word;
}

bool take_word_without_friction(Verdict& verdict, const std::string& json) try {
  using Json = nlohmann::json;
  const Json old = Json::parse(json);
  const auto stored = old.find("without_chosen_friction");
  if (stored == old.end()) return true;
  const Json own = Json::parse(to_json(verdict));
  for (const char* const same : {"verdict", "window", "decided_by"}) {
    if (old.at(same) != own.at(same)) return false;
  }
  const auto decisive = [&](const Json& of) {
    const Json& checks = of.at("checks");
    const auto at = std::ranges::find(checks, own.at("decided_by"), [](const Json& one) { return one.at("id"); });
    return at == checks.end() ? Json() : Json{at->at("value"), at->at("limit"), at->at("worst"), at->at("parts")};
  };
  if (decisive(old) != decisive(own)) return false;
  const std::optional<Word> word = named<Word>(stored->get<std::string>());
  if (!word) return false;
  verdict.without_friction = word;
  return true;
} catch (const nlohmann::json::exception&) {  // the file was changed and is not valid
  return false;
}

}  // namespace gaitlab::report
