#include "bench/measure.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>

namespace gaitlab::versus {

namespace {

double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

constexpr double kStays = 1e-3;  // m

double wall_seconds() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

}  // namespace

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

RaceTorqueError torque_error(const Torques& torques, const Torques& reference, double from) {
  const std::size_t joints = reference.joints();
  std::vector<double> errors;
  for (std::size_t j = 0; j < joints; ++j) {
    double squares = 0;
    double peak = 0;
    double rows = 0;
    for (std::size_t row = 0; row < reference.time.size(); ++row) {
      if (reference.time[row] < from) continue;
      const double wanted = reference.values[row * joints + j];
      const double difference = torques.values[row * joints + j] - wanted;
      squares += difference * difference;
      peak = std::max(peak, std::abs(wanted));
      ++rows;
    }
    errors.push_back(peak > 0 ? std::sqrt(squares / rows) / peak : 0);
  }
  const auto worst = std::max_element(errors.begin(), errors.end());
  if (worst == errors.end()) return {};
  return {*worst, median(errors), static_cast<std::size_t>(worst - errors.begin())};
}

Course course(const Recording& record, double from) {
  const std::size_t rows = record.rows();
  std::size_t first = 0;
  while (first < rows && record.trace.at(first, 0) < from) ++first;
  if (first == rows) return {};
  double force = 0;
  for (const Trace* table : {&record.trace, &record.rest}) {
    for (std::size_t c = 0; c < table->columns.size(); ++c) {
      if (!table->columns[c].name.starts_with("load.")) continue;
      for (std::size_t row = first; row < rows; ++row) force += table->at(row, c);
    }
  }
  const Vec3 way = record.com(rows - 1) - record.com(first);
  return {std::hypot(way.x(), way.y()), force / static_cast<double>(rows - first)};
}

std::string strays(const Course& seen, const Course& bullet) {
  const auto apart = [](double a, double b, double least) { return !(std::abs(a - b) <= std::max(kApart * b, least)); };
  std::string out;
  if (apart(seen.travel, bullet.travel, kStays)) {
    out = fmt::format("travels {:.3g} m, under bullet {:.3g} m", seen.travel, bullet.travel);
  }
  if (apart(seen.force, bullet.force, 0)) {
    out += fmt::format("{}the ground carries {:.3g} N in the mean, under bullet {:.3g} N", out.empty() ? "" : "; ", seen.force,
                       bullet.force);
  }
  return out;
}

TimedRun measure(const std::vector<Scenario>& lanes, double least) {
  TimedRun measured;
  double runs = 0;
  Timing sum;
  while (runs == 0 || sum.wall < least) {
    Simulation simulation(lanes);
    const double wall = wall_seconds();
    const double cpu = cpu_seconds();
    simulation.run();
    for (std::size_t l = 0; l < lanes.size(); ++l) {
      if (!simulation.outcome(l).done()) throw RunError(simulation.outcome(l).message);
    }
    sum.cpu += cpu_seconds() - cpu;
    sum.wall += wall_seconds() - wall;
    if (++runs > 1) continue;
    const Recording record = simulation.take_recording(0);
    measured.torques.time = record.series("t").values();
    measured.course = course(record, lanes[0].duration / 2);
    std::vector<Series> torques;
    for (std::size_t j = 0; j < record.joints.size(); ++j) torques.push_back(record.joint(j, "torque"));
    for (std::size_t row = 0; row < record.rows(); ++row) {
      for (const Series& torque : torques) measured.torques.values.push_back(torque[row]);
    }
  }
  measured.timing = {sum.wall / runs, sum.cpu / runs};
  return measured;
}

}  // namespace gaitlab::versus
