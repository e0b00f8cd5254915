#include "report/signals.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace gaitlab::report {

namespace {

/// Columns that are rounded alike.
struct Quantity {
  const char* pattern;
  double quantum;      ///< the largest
  bool fine = false;   ///< less for small magnitudes
  bool spare = false;  ///< left out where it is 0 all the time
};

constexpr Quantity kQuantities[] = {{"t", 1e-6},
                                    {"base.?", 2e-5},
                                    {"base.q?", 1e-5},
                                    {"com.?", 2e-5},
                                    {"joint.*.setpoint", 1e-4},
                                    {"joint.*.angle", 1e-4},
                                    {"joint.*.speed", 1e-3, true},
                                    {"joint.*.torque", 1e-3, true},
                                    {"joint.*.stop_torque", 1e-3, true, true},
                                    {"joint.*.voltage_command", 2e-3, true},
                                    {"joint.*.voltage", 2e-3, true},
                                    {"joint.*.current", 1e-3, true},
                                    {"joint.*.saturation", 1},
                                    {"dock.*.tension", 0.01, true},
                                    {"dock.*.shear", 0.01, true},
                                    {"dock.*.bending", 1e-3, true},
                                    {"dock.*.torsion", 1e-3, true},
                                    {"stability", 5e-4},
                                    {"energy.*", 1e-3, true},
                                    {"box.*.?", 2e-5},
                                    {"box.*.q?", 1e-5}};
constexpr double kForce = 0.02;  // N, of feet
constexpr double kPlace = 5e-4;  // m, of feet

double magnitude(const Signal& signal, std::size_t rows) {
  double largest = 0;
  for (std::size_t row = 0; row < rows; ++row) {
    const double value = std::abs(signal[row]);
    if (std::isfinite(value)) largest = std::max(largest, value);
  }
  return largest;
}

void set_quanta(std::span<Signal> group, std::size_t rows, const Quantity& quantity) {
  double largest = 0;
  for (const Signal& signal : group) largest = quantity.fine ? std::max(largest, magnitude(signal, rows)) : 0;
  for (Signal& signal : group) signal.quantum = quantum_of(largest, quantity.quantum);
}

void add_columns(const Recording& r, const Quantity& quantity, std::vector<Signal>& all) {
  const std::size_t first = all.size();
  for (const Trace* table : {&r.trace, &r.rest}) {
    for (std::size_t i = 0; i < table->columns.size() && table->rows() > 0; ++i) {
      const Column& column = table->columns[i];
      if (!glob(quantity.pattern, column.name)) continue;
      Signal signal{column.name, column.unit, 1, {*table, i}, {}};
      if (!quantity.spare || magnitude(signal, r.rows()) > 0) all.push_back(std::move(signal));
    }
  }
  set_quanta(std::span(all).subspan(first), r.rows(), quantity);
}

void add_feet(const std::vector<Foot>& feet, std::size_t rows, std::vector<Signal>& all) {
  const auto add = [&](const char* what, const char* unit, std::vector<double> Foot::*values) {
    for (std::size_t i = 0; i < feet.size(); ++i) {
      if (!(feet[i].*values).empty()) all.push_back({fmt::format("foot.{}.{}", i, what), unit, kPlace, {}, feet[i].*values});
    }
  };
  const std::size_t first = all.size();
  add("fx", "N", &Foot::fx);
  add("fy", "N", &Foot::fy);
  add("fz", "N", &Foot::fz);
  set_quanta(std::span(all).subspan(first), rows, {"", kForce, true});
  add("x", "m", &Foot::x);
  add("y", "m", &Foot::y);
  add("z", "m", &Foot::z);
}

}  // namespace

std::vector<Signal> signals(const Recording& r, const std::vector<Foot>& feet) {
  std::vector<Signal> all;
  for (const Quantity& quantity : kQuantities) add_columns(r, quantity, all);
  add_feet(feet, r.rows(), all);
  return all;
}

std::size_t thinned(std::size_t rows, std::size_t stride) { return rows == 0 ? 0 : (rows - 1 + stride - 1) / stride + 1; }

Packing packed(const std::vector<Signal>& signals, std::size_t rows, std::size_t stride) {
  Packing packing;
  std::vector<double> values(thinned(rows, stride));
  for (const Signal& signal : signals) {
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = signal[std::min(i * stride, rows - 1)];
    packing.add(signal.name, signal.unit, signal.quantum, values);
  }
  return packing;
}

std::vector<std::string> left_out(const Scenario& scenario, const Recording& r) {
  const bool driven = scenario.actuator.entry != nullptr;
  std::vector<const char*> shown;
  if (!scenario.robot->joints.empty()) shown.push_back("joint.*.speed");
  if (!scenario.robot->joints.empty() && driven)
    shown.insert(shown.end(),
                 {"joint.*.setpoint", "joint.*.torque", "joint.*.voltage", "joint.*.current", "joint.*.saturation"});
  if (scenario.ground.kind != Ground::Kind::none && !contact_elements(*scenario.robot, scenario.contact.on).empty())
    shown.push_back("contact.*");
  if (scenario.robot->modules.size() > 1 && !scenario.contact.solver()) shown.push_back("reaction.*");
  shown.push_back("energy.*");
  const auto has = [&](const char* pattern) {
    const auto covers = [&](const Column& column) { return glob(pattern, column.name); };
    return std::ranges::any_of(r.trace.columns, covers) || std::ranges::any_of(r.rest.columns, covers);
  };
  std::vector<std::string> missing;
  for (const char* pattern : shown) {
    if (!has(pattern)) missing.emplace_back(pattern);
  }
  return missing;
}

}  // namespace gaitlab::report
