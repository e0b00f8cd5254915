#include "report/page/signals.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <span>

#include "core/model/pattern.h"

namespace gaitlab::report {

namespace {

/// Columns with the same unit and quantum.
struct SignalKind {
  const char *pattern, *unit;  ///< nullptr for the unit of the command
  double quantum;              ///< largest quantum
  bool fine = false;           ///< true: the quantum is smaller for small magnitudes
  bool spare = false;          ///< true: left out if all values are 0
};

// Units are listed here, because a CSV file does not contain them.
constexpr SignalKind kQuantities[] = {{"t", "s", 1e-6},
                                      {"base.?", "m", 2e-5},
                                      {"base.q?", "", 1e-5},
                                      {"com.?", "m", 2e-5},
                                      {"joint.*.setpoint", "rad", 1e-4},
                                      {"joint.*.angle", "rad", 1e-4},
                                      {"joint.*.measured", "rad", 1e-4},
                                      {"joint.*.logged_angle", "rad", 1e-4},
                                      {"joint.*.logged_torque", "N m", 1e-3, true},
                                      {"joint.*.speed", "rad/s", 1e-3, true},
                                      {"joint.*.torque", "N m", 1e-3, true},
                                      {"joint.*.stop_torque", "N m", 1e-3, true, true},
                                      {"joint.*.voltage_command", nullptr, 2e-3, true},
                                      {"joint.*.voltage", "V", 2e-3, true},
                                      {"joint.*.current", "A", 1e-3, true},
                                      {"joint.*.saturation", "", 1},
                                      {"dock.*.tension", "N", 0.01, true},
                                      {"dock.*.shear", "N", 0.01, true},
                                      {"dock.*.bending", "N m", 1e-3, true},
                                      {"dock.*.torsion", "N m", 1e-3, true},
                                      {"stability", "m", 5e-4},
                                      {"energy.*", "J", 1e-3, true},
                                      {"box.*.?", "m", 2e-5},
                                      {"box.*.q?", "", 1e-5}};
constexpr double kForce = 0.02;  // N, quantum of the forces on feet
constexpr double kPlace = 5e-4;  // m, quantum of the positions of feet

double magnitude(const Signal& signal, std::size_t rows) {
  double largest = 0;
  for (std::size_t row = 0; row < rows; ++row) {
    const double value = std::abs(signal[row]);
    if (std::isfinite(value)) largest = std::max(largest, value);
  }
  return largest;
}

void set_quanta(std::span<Signal> group, std::size_t rows, const SignalKind& quantity) {
  double largest = 0;
  for (const Signal& signal : group) largest = quantity.fine ? std::max(largest, magnitude(signal, rows)) : 0;
  for (Signal& signal : group) signal.quantum = quantum_of(largest, quantity.quantum);
}

/// Name of a column in the page. `dock.3.shear` of module 3 becomes `dock.2.shear`, because the first module does not have a
/// dock.
std::string page_name(const std::string& column) {
  constexpr std::string_view kDock = "dock.";
  if (!column.starts_with(kDock)) return column;
  std::size_t module = 0;
  const auto [end, error] = std::from_chars(column.data() + kDock.size(), column.data() + column.size(), module);
  return error == std::errc() && module > 0 ? fmt::format("{}{}{}", kDock, module - 1, end) : column;
}

void add_columns(std::span<const Trace* const> tables, const SignalKind& quantity, const std::string& command_unit,
                 std::vector<Signal>& all) {
  const std::size_t first = all.size();
  const std::size_t rows = tables.front()->rows();
  for (const Trace* table : tables) {
    for (std::size_t i = 0; i < table->columns.size() && table->rows() > 0; ++i) {
      const std::string& name = table->columns[i].name;
      if (!glob(quantity.pattern, name)) continue;
      if (table != tables.front() && name == "t") continue;  // the time is equal in all tables
      Signal signal{page_name(name), quantity.unit == nullptr ? command_unit : quantity.unit, 1, {*table, i}, {}};
      if (!quantity.spare || magnitude(signal, rows) > 0) all.push_back(std::move(signal));
    }
  }
  set_quanta(std::span(all).subspan(first), rows, quantity);
}

/// Adds a signal that is 1 at the times at which the signal `name` is known, because a channel has no gaps.
void add_known(const std::string& name, std::size_t rows, std::vector<Signal>& all) {
  const auto found = std::ranges::find(all, name, &Signal::name);
  if (found == all.end()) return;
  Signal known{name + ".known", "", 1, {}, {}};
  for (std::size_t row = 0; row < rows; ++row) known.values.push_back(std::isfinite((*found)[row]) ? 1 : 0);
  if (std::ranges::find(known.values, 0.0) != known.values.end()) all.push_back(std::move(known));
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
  set_quanta(std::span(all).subspan(first), rows, {"", "N", kForce, true});
  add("x", "m", &Foot::x);
  add("y", "m", &Foot::y);
  add("z", "m", &Foot::z);
}

}  // namespace

std::vector<Signal> signals(const Recording& r, const Trace& loads, const std::vector<Foot>& feet,
                            const std::string& command_unit) {
  std::vector<Signal> all;
  for (const SignalKind& quantity : kQuantities)
    add_columns(std::array{&r.trace, &r.rest, &loads}, quantity, command_unit, all);
  std::vector<std::string> with_gaps{"stability"};  // a log may be shorter than the run
  for (const Signal& signal : all) {
    if (glob("joint.*.logged_*", signal.name)) with_gaps.push_back(signal.name);
  }
  for (const std::string& name : with_gaps) add_known(name, r.rows(), all);
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

std::vector<std::string> left_out(const Scenario& scenario, const std::vector<Signal>& signals) {
  const auto has = [&](const char* pattern) {
    return std::ranges::any_of(signals, [&](const Signal& signal) { return glob(pattern, signal.name); });
  };
  std::vector<const char*> shown;
  if (!scenario.robot->joints.empty()) shown.push_back("joint.*.speed");
  if (!scenario.robot->joints.empty() && scenario.actuator.entry != nullptr) {
    shown.insert(shown.end(),
                 {"joint.*.setpoint", "joint.*.torque", "joint.*.voltage", "joint.*.current", "joint.*.saturation"});
  }
  std::erase_if(shown, has);
  std::vector<std::string> missing;
  if (!shown.empty()) missing.push_back(fmt::format("trace.columns leaves out {}", fmt::join(shown, ", ")));
  if (!has("dock.*") && scenario.robot->modules.size() > 1) {
    missing.emplace_back(
        scenario.contact.model().element_forces
            ? "the loads of docks were not recorded"
            : fmt::format("the loads of docks are not known under contact.law: {}", scenario.contact.model().text));
  }
  if (has("foot.*") && !has("foot.*.fx")) missing.emplace_back("for feet, only the vertical load on their modules is known");
  return missing;
}

}  // namespace gaitlab::report
