#include "core/simulation/batch.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <utility>

#include "core/parallel.h"
#include "core/scenario/read_scenario.h"
#include "core/settings/settings_numbers.h"

namespace gaitlab {

namespace {

using LaneGroup = std::vector<std::size_t>;  ///< indices of waiting rollouts

/// Frequencies among the settings of the CPG, Hz. A setting with a value per joint counts with the value of the first joint.
std::vector<double> frequencies(const Scenario& s) {
  std::vector<double> all;
  const SettingsNumbers settings(s.cpg);
  for (const SettingsNumbers::Found& one : settings.all()) {
    if (one.unit == "Hz") all.push_back(one.value[0]);
  }
  return all;
}

/// Queue of waiting rollouts, from which threads take lane groups.
class Waiting {
 public:
  Waiting(const BatchStream& stream, const BatchSettings& settings, std::size_t look_ahead)
      : stream_(stream), settings_(settings), look_ahead_(look_ahead) {}

  /// Takes out rollouts that can share lanes, in the order of next(). Empty after the last rollout.
  std::vector<Rollout> take() {
    const std::lock_guard lock(mutex_);
    while (more_ && waiting_.size() < look_ahead_ && (waiting_.size() < kFew || links_ < kMostLinks)) {
      std::optional<Rollout> one = stream_.next();
      more_ = one.has_value();
      if (one) {
        std::vector<double> of_cpg = frequencies(one->scenario);
        links_ += one->scenario.robot->links.size();
        waiting_.push_back({std::move(*one), std::move(of_cpg)});
      }
    }
    if (waiting_.empty()) return {};
    const Scenario& first = waiting_.front().rollout.scenario;
    LaneGroup group;
    for (std::size_t i = 0; i < waiting_.size(); ++i) {
      if (i == 0 || can_share(first, waiting_[i].rollout.scenario)) group.push_back(i);
    }
    if (estimated_by_rollouts(first)) group.resize(1);
    keep_nearest(group, lane_width(*first.physics.engine, fair(group.size()), settings_.lanes));
    std::vector<Rollout> pack;
    for (const std::size_t i : group) {
      links_ -= waiting_[i].rollout.scenario.robot->links.size();
      pack.push_back(std::move(waiting_[i].rollout));
    }
    for (std::size_t k = group.size(); k-- > 0;) waiting_.erase(waiting_.begin() + static_cast<std::ptrdiff_t>(group[k]));
    if (stream_.begin) stream_.begin(pack);
    return pack;
  }

 private:
  // Each rollout with tolerances has a separate robot, of 6 kB per link. Only few rollouts of large robots may therefore wait.
  static constexpr std::size_t kFew = 64, kMostLinks = 20000;

  /// Largest number of the `left` waiting rollouts for one thread: all while more are to come, and then an equal share, so that
  /// the last rollouts occupy all threads.
  [[nodiscard]] std::size_t fair(std::size_t left) const {
    const auto threads = static_cast<std::size_t>(std::max(1, settings_.threads));
    return more_ ? left : (left + threads - 1) / threads;
  }

  /// Keeps, in their order, the `most` rollouts whose frequencies are nearest to those of the first rollout.
  void keep_nearest(LaneGroup& group, std::size_t most) const {
    const auto apart = [&, &first = waiting_[group.front()].frequencies](std::size_t i) {
      const std::vector<double>& own = waiting_[i].frequencies;
      double sum = 0;
      for (std::size_t k = 0; k < std::min(own.size(), first.size()); ++k) sum += std::abs(own[k] - first[k]);
      return sum;
    };
    std::ranges::stable_sort(group, {}, apart);
    group.resize(std::min(group.size(), most));
    std::ranges::sort(group);
  }

  struct Candidate {
    Rollout rollout;
    std::vector<double> frequencies;
  };

  const BatchStream& stream_;
  const BatchSettings& settings_;
  std::size_t look_ahead_;
  std::mutex mutex_;
  std::vector<Candidate> waiting_;
  std::size_t links_ = 0;  ///< links of the robots of waiting rollouts
  bool more_ = true;
};

/// Runs one rollout alone. Returns false if stopped.
bool run_alone(RolloutEnd& end, const BatchStream& stream, Records records, const std::atomic<bool>& stop) {
  try {
    Simulation simulation({&end.rollout.scenario, 1}, records);
    if (stream.watch) simulation.watch([&](std::size_t, const Recording& so_far) { return stream.watch(end.rollout, so_far); });
    std::optional<Outcome> thrown;
    try {
      if (!simulation.run({}, &stop)) return false;
    } catch (const SimulationError& error) {
      thrown = error.outcome();
    }
    end.recording = simulation.take_recording(0);
    if (thrown) end.recording.outcome = std::move(*thrown);
  } catch (const InputError& error) {
    end.refused = error.problems();
  }
  return true;
}

/// Runs a lane group. Returns false if stopped.
bool run_pack(std::vector<RolloutEnd>& pack, const BatchStream& stream, const BatchSettings& settings, Records records,
              const std::atomic<bool>& stop) {
  if (pack.size() > 1) {
    try {
      std::vector<Scenario> lanes;
      lanes.reserve(pack.size());
      for (const RolloutEnd& one : pack) lanes.push_back(one.rollout.scenario);
      // Unused lanes repeat the last rollout.
      lanes.resize(lane_width(*lanes.front().physics.engine, lanes.size(), settings.lanes), lanes.back());
      Simulation simulation(lanes, records);
      if (stream.watch) {
        simulation.watch([&](std::size_t lane, const Recording& so_far) {
          return stream.watch(pack[std::min(lane, pack.size() - 1)].rollout, so_far);
        });
      }
      if (!simulation.run({}, &stop)) return false;
      for (std::size_t l = 0; l < pack.size(); ++l) pack[l].recording = simulation.take_recording(l);
      return true;
    } catch (const RunError&) {  // run_alone runs each rollout again and reports errors
    } catch (const InputError&) {
    }
  }
  return std::ranges::all_of(pack, [&](RolloutEnd& one) { return run_alone(one, stream, records, stop); });
}

}  // namespace

std::size_t lane_width(const Engine& engine, std::size_t wanted, std::size_t most) {
  std::size_t best = engine.lanes.front();
  for (const std::size_t lanes : engine.lanes) {
    if (most != 0 && lanes > most) break;
    best = lanes;
    if (lanes >= wanted) break;
  }
  return best;
}

bool run_pulled(const BatchStream& stream, const BatchSettings& settings, Records records, std::atomic<bool>& stop,
                std::size_t look_ahead) {
  Waiting waiting(stream, settings, look_ahead);
  std::atomic<bool> whole = true;
  const auto threads = static_cast<std::size_t>(std::max(1, settings.threads));
  parallel(threads, settings.threads, [&](std::size_t) {
    try {
      while (!stop) {
        std::vector<RolloutEnd> pack;
        for (Rollout& one : waiting.take()) pack.push_back({std::move(one)});
        if (pack.empty()) return;
        if (!run_pack(pack, stream, settings, records, stop)) break;
        stream.end(std::move(pack));
      }
      whole = false;
    } catch (...) {
      stop = true;
      throw;
    }
  });
  return whole;
}

bool run_all(std::span<const Scenario> rollouts, const BatchSettings& settings, Records records, std::atomic<bool>& stop,
             const std::function<void(std::size_t, RolloutEnd&&)>& end) {
  std::size_t next = 0;
  const BatchStream stream{.next = [&]() -> std::optional<Rollout> {
                             if (next == rollouts.size()) return {};
                             const std::size_t number = next++;
                             return Rollout{number, rollouts[number]};
                           },
                           .end =
                               [&](std::vector<RolloutEnd>&& pack) {
                                 for (RolloutEnd& one : pack) {
                                   const std::size_t number = one.rollout.number;
                                   end(number, std::move(one));
                                 }
                               }};
  return run_pulled(stream, settings, records, stop, rollouts.size());
}

void run_batch(std::span<const Scenario> rollouts, const BatchSettings& settings,
               const std::function<void(std::size_t, Recording&&)>& end) {
  std::vector<std::vector<Problem>> refused(rollouts.size());
  std::atomic<bool> stop = false;
  run_all(rollouts, settings, Loads::left_out, stop, [&](std::size_t number, RolloutEnd&& one) {
    if (one.refused.empty()) {
      end(number, std::move(one.recording));
    } else {
      refused[number] = std::move(one.refused);
    }
  });
  for (std::vector<Problem>& problems : refused) {
    if (!problems.empty()) throw InputError(std::move(problems));
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
