#include "core/simulation/batch.h"

#include <algorithm>
#include <exception>

#include "core/parallel.h"
#include "core/scenario/read_scenario.h"

namespace gaitlab {

namespace {

using LaneGroup = std::vector<std::size_t>;  ///< indices of rollouts; one that stands twice fills a lane that nobody needs

/// How many lanes to take for so many rollouts that are left: all that the widest gives, or the fewest that hold the rest.
std::size_t width(std::span<const std::size_t> widths, std::size_t left, std::size_t most) {
  std::size_t best = widths.front();
  for (const std::size_t lanes : widths) {
    if (most != 0 && lanes > most) break;
    best = lanes;
    if (lanes >= left) break;
  }
  return best;
}

std::vector<LaneGroup> lane_groups(std::span<const Scenario> rollouts, std::size_t most) {
  std::vector<LaneGroup> groups;
  for (std::size_t i = 0; i < rollouts.size(); ++i) {
    const auto group = std::find_if(groups.begin(), groups.end(),
                                    [&](const LaneGroup& g) { return can_share(rollouts[g.front()], rollouts[i]); });
    if (group == groups.end()) {
      groups.push_back({i});
    } else {
      group->push_back(i);
    }
  }
  std::vector<LaneGroup> all;
  for (const LaneGroup& group : groups) {
    const std::vector<std::size_t>& widths = rollouts[group.front()].physics.engine->lanes;
    for (std::size_t from = 0; from < group.size();) {
      const std::size_t lanes = width(widths, group.size() - from, most);
      LaneGroup together;
      for (std::size_t l = 0; l < lanes; ++l) together.push_back(group[std::min(from + l, group.size() - 1)]);
      all.push_back(together);
      from += lanes;
    }
  }
  return all;
}

}  // namespace

void run_batch(std::span<const Scenario> rollouts, const BatchSettings& settings,
               const std::function<void(std::size_t, Recording&&)>& end) {
  const std::vector<LaneGroup> all = lane_groups(rollouts, settings.lanes);
  std::vector<std::exception_ptr> refused(rollouts.size());
  const auto alone = [&](std::size_t i) {
    try {
      Simulation simulation({&rollouts[i], 1});
      std::string outcome = "done";
      try {
        simulation.run();
      } catch (const SimulationError& error) {
        outcome = error.what();
      }
      Recording recording = simulation.take_recording(0);
      recording.outcome = std::move(outcome);
      end(i, std::move(recording));
    } catch (const InputError&) {
      refused[i] = std::current_exception();
    }
  };
  parallel(all.size(), settings.threads, [&](std::size_t p) {
    LaneGroup together = all[p];
    std::vector<Scenario> lanes;
    for (const std::size_t i : together) lanes.push_back(rollouts[i]);
    together.erase(std::unique(together.begin(), together.end()), together.end());
    std::unique_ptr<Simulation> simulation;
    try {
      if (together.size() > 1) {
        simulation = std::make_unique<Simulation>(lanes);
        simulation->run();
      }
    } catch (const RunError&) {  // one lane's, or of what all share: each tells for itself
      simulation.reset();
    } catch (const InputError&) {
      simulation.reset();
    }
    for (std::size_t l = 0; l < together.size(); ++l) {
      if (simulation == nullptr) {
        alone(together[l]);
        continue;
      }
      end(together[l], simulation->take_recording(l));
    }
  });
  for (const std::exception_ptr& error : refused) {
    if (error) std::rethrow_exception(error);
  }
}

std::vector<Scenario> rollouts(const std::string& file, const std::vector<std::string>& sets,
                               std::span<const std::vector<std::string>> own, Catalog& catalog) {
  const ScenarioTemplate common(file, sets, catalog);
  std::vector<Scenario> all;
  Problems problems;
  for (const std::vector<std::string>& overrides : own) {
    try {
      all.push_back(common.with(overrides));
    } catch (const InputError& error) {
      for (const Problem& problem : error.problems()) problems.add(problem.place, problem.text);
    }
  }
  problems.raise();
  return all;
}

}  // namespace gaitlab
