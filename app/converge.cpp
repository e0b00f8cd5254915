#include <fmt/format.h>

#include <cmath>

#include "app/app.h"
#include "core/simulation/simulation.h"

namespace gaitlab::app {

namespace {

/// What is compared between two steps, joint by joint: RMS difference of the torque over all rows, relative to the finest run's
/// peak.
struct Change {
  std::vector<double> torque;
  double displacement = 0;  ///< of the centre of mass at the end, relative to the finest run's distance
};

Change change(const RunRecord& coarse, const RunRecord& fine, std::size_t joints) {
  Change c;
  const std::size_t rows = fine.com_x.size();
  for (std::size_t j = 0; j < joints; ++j) {
    double sum = 0;
    double peak = 0;
    for (std::size_t k = 0; k < rows; ++k) {
      const double f = fine.torques[k * joints + j];
      const double d = coarse.torques[k * joints + j] - f;
      sum += d * d;
      peak = std::max(peak, std::abs(f));
    }
    c.torque.push_back(peak > 0 ? std::sqrt(sum / static_cast<double>(rows)) / peak : 0);
  }
  const double x = fine.com_x.back() - fine.com_x.front();
  const double y = fine.com_y.back() - fine.com_y.front();
  const double distance = std::hypot(x, y);
  const double miss =
      std::hypot(coarse.com_x.back() - coarse.com_x.front() - x, coarse.com_y.back() - coarse.com_y.front() - y);
  c.displacement = distance > 0 ? miss / distance : miss;
  return c;
}

}  // namespace

int converge(const ScenarioArguments& arguments, int halvings) {
  Catalog catalog = standard_catalog();
  const Scenario scenario = read(arguments, catalog);
  const std::size_t joints = scenario.robot->joints.size();
  std::vector<double> steps;
  std::vector<RunRecord> runs;
  for (int i = 0; i <= halvings; ++i) {
    Scenario halved = scenario;
    halved.physics.step = scenario.physics.step / static_cast<double>(1 << i);
    Simulation simulation({&halved, 1});
    simulation.run();
    steps.push_back(halved.physics.step);
    runs.push_back(simulation.take_record(0));
  }
  fmt::print("{}: change against step {} s (torque: RMS over the trace / peak of the joint)\n", scenario.name, steps.back());
  fmt::print("{:<18}", "step, s");
  for (std::size_t i = 0; i + 1 < runs.size(); ++i) fmt::print(" {:>12}", steps[i]);
  fmt::print("\n");
  std::vector<Change> changes;
  for (std::size_t i = 0; i + 1 < runs.size(); ++i) changes.push_back(change(runs[i], runs.back(), joints));
  const auto row = [&](const std::string& name, const auto& value) {
    fmt::print("{:<18}", name);
    for (const Change& c : changes) fmt::print(" {:>10.4f} %", 100 * value(c));
    fmt::print("\n");
  };
  for (std::size_t j = 0; j < joints; ++j) row(scenario.robot->joints[j].name, [j](const Change& c) { return c.torque[j]; });
  if (joints > 0) row("worst joint", [](const Change& c) { return *std::max_element(c.torque.begin(), c.torque.end()); });
  row("displacement", [](const Change& c) { return c.displacement; });
  return 0;
}

}  // namespace gaitlab::app
