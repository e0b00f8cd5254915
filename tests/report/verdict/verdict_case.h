// Recorded walk that tests of the verdict change before they compute the verdict.
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <optional>
#include <string>

#include "report/verdict/verdict.h"
#include "tests/program/fixture.h"

namespace gaitlab::test {

using namespace report;

/// Run of the caterpillar for 4 s, which is one period. Tests change its recording.
struct Case {
  Scenario scenario = shipped("caterpillar.yaml", {"duration=4", "physics.engine=articulated"});
  Recording record = run(scenario);
  std::optional<Overlaps> known = {};                  ///< if absent, computed from the record, which is slow
  std::function<void(Summary&, Overlaps&)> also = {};  ///< changes the summary and overlaps of the record

  [[nodiscard]] Verdict judged() const {
    Summary summary = summarise(scenario, record, 0);
    Overlaps there = known ? *known : overlaps(scenario, record);
    if (also) also(summary, there);
    return verdict(scenario, record, summary, there);
  }
  [[nodiscard]] Check check(const std::string& id) const {
    const Verdict made = judged();
    const auto found = std::ranges::find(made.checks, id, &Check::id);
    return found != made.checks.end() ? *found : Check();
  }
  [[nodiscard]] CheckStatus status(const std::string& id) const { return check(id).status; }
  /// Cell of a joint in a row of the recording's ticks.
  double& tick(std::size_t row, std::size_t joint, TickColumn column) {
    return record.ticks.values.at(row * record.ticks.columns.size() + 1 + joint * kTickColumns + column);
  }
  [[nodiscard]] std::size_t last_tick() const { return record.ticks.rows() - 1; }
  [[nodiscard]] double time(std::size_t row) const { return record.ticks.values.at(row * record.ticks.columns.size()); }
  /// Cells of the tables of poses and of loads. These tables have the same rows as the ticks.
  double& pose(const std::string& column, std::size_t row) { return cell(record.poses, column, row); }
  double& load(const std::string& column, std::size_t row) { return cell(record.loads, column, row); }
  static double& cell(Trace& of, const std::string& column, std::size_t row) {
    return of.values.at(row * of.columns.size() + of.find(column));
  }
};

inline Case& walk() {
  static Case made;
  return made;
}

/// Run of three periods, which is sufficient evidence of a gait, with the loads of docks and feet.
inline Case& gait() {
  static Case made = [] {
    Scenario scenario = shipped("caterpillar.yaml", {"duration=12", "physics.engine=articulated"});
    Simulation simulation({&scenario, 1}, Loads::recorded);
    simulation.run();
    Recording record = simulation.take_recording(0);
    return Case{std::move(scenario), std::move(record)};
  }();
  return made;
}

/// Change of a recorded run by a test.
using Change = std::function<void(Case&)>;

/// Run of gait() with ratings of motors, gears and docks that are far above its loads. Torque errors are not estimated, and
/// overlaps of bodies are set to none, which saves most of the time of a test.
inline Case& rated_gait() {
  static Case made = [] {
    const Connector connector{.tension = 1000, .shear = 800, .bending = 400, .torsion = 200, .source = "chosen: test"};
    Case rated = gait();
    rated.scenario = shipped("caterpillar.yaml",
                             {"duration=12", "physics.engine=articulated", "actuator.i_continuous=1",
                              "actuator.gear_torque_peak=5", "actuator.gear_torque_continuous=3", "actuator.speed_max=10"});
    Robot robot = *rated.scenario.robot;
    for (ModuleType& type : robot.types) {
      type.connectors = {{"latch", connector}};
      for (FaceType& face : type.faces) face.connector = "latch";
    }
    rated.scenario.robot = std::make_shared<const Robot>(std::move(robot));
    rated.record.tally.estimated = false;
    rated.known = Overlaps{rated.scenario.robot->bodies.size()};
    return rated;
  }();
  return made;
}

/// Check `id` of rated_gait(), or of another case, after a change.
inline Check changed(const std::string& id, const Change& change, Case made = rated_gait()) {
  change(made);
  return made.check(id);
}

/// Run of walk() in which joint 3 is at the limit in the last `rows` ticks, except in ticks whose number is a multiple of
/// `every`.
inline Case at_limit(TickColumn column, std::size_t rows, std::size_t every = 0) {
  Case made = walk();
  double total = 0;
  for (std::size_t k = made.last_tick() - rows + 1; k <= made.last_tick(); ++k) {
    const bool gap = every > 0 && k % every == 0;
    if (!gap) total += made.time(k) - made.time(k - 1);
    made.tick(k, 3, column) = total;
  }
  return made;
}

}  // namespace gaitlab::test
