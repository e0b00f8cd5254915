#include "core/simulation/recorder.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <new>
#include <string>
#include <system_error>

#include "core/recording/h5.h"
#include "core/scenario/buses.h"

namespace gaitlab {

namespace {

constexpr std::size_t kReleasedRows = 4096;  // rows per release, about 20 MB for a walking robot with all columns
constexpr double kTickRows = 2e-3;           // shortest interval between rows of Recording::ticks, s

/// Error for rows that exceed the memory or the disk. Rows are kept until the end of the run.
TooManyRows too_many_rows(const Scenario& s, const RowsNeeded& needed, const std::string& there_is) {
  return {s.place("duration"),
          fmt::format("the run would record {:.3g} rows of {:.0f} columns, {:.3g} GB, {}: take a longer trace.period than "
                      "{:.3g} s, fewer trace.columns, or a shorter duration",
                      needed.rows, needed.columns, needed.bytes() / 1e9, there_is, s.trace.period)};
}

/// Throws InputError if the rows exceed the disk, or the memory of the container (cgroup 2) or of the process (ulimit -v).
void check_space(const Scenario& s, const RowsNeeded& needed) {
  constexpr double kLittle = 1e8;  // bytes; less is not checked, because the query takes longer than a short rollout
  if (needed.bytes() < kLittle) return;
  const auto check = [&](double bytes, const std::string& whose, const char* of) {
    if (bytes > 0 && needed.bytes() > bytes)
      throw too_many_rows(s, needed, fmt::format("{} {:.3g} GB of {}", whose, bytes / 1e9, of));
  };
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
    check(static_cast<double>(limit.rlim_cur), "but ulimit -v allows", "memory");
  if (needed.bytes() > static_cast<double>(kMostInMemory)) {
    std::error_code error;
    const std::filesystem::space_info disk = std::filesystem::space(spill_folder(), error);
    constexpr double kWithFile = 1 + kFileShare;  // space for the values and for the file made from them
    if (!error && kWithFile * needed.bytes() > static_cast<double>(disk.available)) {
      throw too_many_rows(
          s, needed,
          fmt::format("which needs {:.3g} GB in {} (TMPDIR), but that has {:.3g} GB", kWithFile * needed.bytes() / 1e9,
                      spill_folder().string(), static_cast<double>(disk.available) / 1e9));
    }
    if (!error) return;
    check(static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE)), "but this machine has",
          "memory");
  }
  double container = 0;
  if (std::ifstream("/sys/fs/cgroup/memory.max") >> container) check(container, "but this container has", "memory");
}

}  // namespace

Recorder::Recorder(const Scenario& scenario, const std::vector<ContactElement>& contacts, const Cpg* cpg,
                   std::string_view command_unit, const Sample& sample, const Records& wanted,
                   std::vector<std::size_t> rated_gears)
    : scenario_(scenario), probes_(std::make_unique<Probes>(scenario, contacts, cpg, command_unit, sample)) {
  if (wanted.rows) {
    recording.trace.columns = probes_->columns();
    recording.rest.columns = probes_->rest_columns();
  } else {
    probes_.reset();  // Probes has checked trace.columns and is not needed any more
  }
  const std::size_t joints = scenario.robot->joints.size();
  recording.ticks.columns = tick_columns(joints);
  recording.poses.columns = pose_columns(joints);
  if (const std::vector<MotorBus> all = buses(scenario); !all.empty()) {
    std::vector<std::string> modules;
    bus_since_row_ = {0};
    for (const MotorBus& bus : all) {
      modules.push_back(bus.module);
      bus_since_row_.insert(bus_since_row_.end(), {bus.supply.voltage, 0, 1, 0, 0});
    }
    recording.supply.columns = supply_columns(modules);
  }
  ticks_per_row_ = std::max<std::int64_t>(1, static_cast<std::int64_t>(std::ceil(kTickRows / scenario.control_period - 1e-9)));
  ticks_per_load_ = ticks_per_row_;
  check_space(scenario, rows_needed());
  if (wanted.loads != Loads::left_out) {
    loads_ = std::make_unique<LoadMeter>(scenario, contacts, wanted.loads, std::move(rated_gears));
    recording.loads.columns = loads_->columns();
  }
  reserve_rows(scenario);
}

RowsNeeded Recorder::rows_needed() const {
  return {scenario_.duration / scenario_.trace.period + 2,
          static_cast<double>(recording.trace.columns.size() + recording.rest.columns.size())};
}

void Recorder::reserve_rows(const Scenario& s) {
  const auto reserve = [&](Trace& table, double rows) {
    try {
      table.values.reserve(static_cast<std::size_t>(rows + 3) * table.columns.size());
    } catch (const std::bad_alloc&) {
      throw too_many_rows(s, rows_needed(), "but that much memory is not available");
    }
  };
  for (Trace* table : {&recording.trace, &recording.rest}) reserve(*table, s.duration / s.trace.period);
  const double ticks = s.duration / (s.control_period * static_cast<double>(ticks_per_row_));
  for (Trace* table : {&recording.ticks, &recording.poses, &recording.loads, &recording.supply})
    reserve(*table, std::min(ticks, static_cast<double>(kMostTickRows)));
}

void Recorder::add_row() {
  Recording& r = recording;
  for (Trace* table : {&r.trace, &r.rest}) table->values.resize(table->values.size() + table->columns.size());
  probes_->fill(Out(r.trace.values).last(r.trace.columns.size()), Out(r.rest.values).last(r.rest.columns.size()));
  if (++unreleased_ == kReleasedRows) release_rows();
}

void Recorder::release_rows() {
  release(recording.trace.values);
  release(recording.rest.values);
  unreleased_ = 0;
}

std::optional<Out> Recorder::add_tick(double t, bool last) {
  Trace& ticks = recording.ticks;
  const std::size_t columns = ticks.columns.size();
  if (!ticks.values.empty() && ticks.values[ticks.values.size() - columns] == t) return {};
  if (ticks.rows() > kMostTickRows) {
    halve_ticks(ticks);
    halve_rows(recording.loads);
    halve_rows(recording.poses);
    halve_rows(recording.supply);
    ticks_per_row_ *= 2;
    if (!tick_due() && !last) {
      skip_tick();
      return {};
    }
  }
  ticks.values.resize(ticks.values.size() + columns);
  const Out row = Out(ticks.values).last(columns);
  row[0] = t;
  if (!bus_since_row_.empty()) {
    bus_since_row_[0] = t;
    recording.supply.values.insert(recording.supply.values.end(), bus_since_row_.begin(), bus_since_row_.end());
    for (std::size_t bus = 0; bus + 1 < bus_since_row_.size(); bus += kBusColumns) {
      bus_since_row_[bus + kLeastVoltage] = INFINITY;
      bus_since_row_[bus + kLargestCurrent] = 0;
      bus_since_row_[bus + kHeld] = 1;
    }
  }
  loads_due_ = loads_ != nullptr;
  skipped_ = false;
  return row.subspan(1);
}

void Recorder::add_buses(std::span<const BusState> all) {
  const auto worse = [](double& now, double value) { now = std::min(now, value); };
  for (std::size_t b = 0; b < all.size(); ++b) {
    const BusState& bus = all[b];
    const Out row = Out(bus_since_row_).subspan(b * kBusColumns, 1 + kBusColumns);
    worse(row[kLeastVoltage], bus.voltage);
    worse(row[kHeld], bus.held ? 1 : 0);
    row[kLargestCurrent] = std::max(row[kLargestCurrent], std::abs(bus.current));
    row[kCharge] += bus.current * scenario_.control_period;
    row[kBusSquare] += bus.current * bus.current * scenario_.control_period;
  }
}

void Recorder::skip_tick() {
  if (loads_ == nullptr || recording.control_ticks % ticks_per_load_ != 0) return;
  loads_due_ = true;
  skipped_ = true;
}

void Recorder::add_pose(double t, const Sample& s) {
  SpilledVector<double>& values = recording.poses.values;
  const Vec3& p = s.state.position;
  const Quat& q = s.state.orientation;
  for (const double value : {t, p.x(), p.y(), p.z(), q.w(), q.x(), q.y(), q.z()}) values.push_back(value);
  values.insert(values.end(), s.state.q.begin(), s.state.q.end());
  const std::vector<Joint>& joints = scenario_.robot->joints;
  for (std::size_t j = 0; j < joints.size(); ++j) values.push_back(joints[j].driven() ? s.setpoint[j] : s.state.q[j]);
  double load = 0;
  for (const ContactSample& contact : s.contacts) load += contact.fn;
  for (const double value : {s.sums.com.x(), s.sums.com.y(), s.sums.com.z(), load}) values.push_back(value);
}

void Recorder::add_loads() {
  Trace& loads = recording.loads;
  loads_now_.resize(loads.columns.size());
  loads_->measure(loads_now_);
  if (!since_row_.empty()) keep_worst(loads.columns, since_row_, loads_now_);
  if (skipped_) {
    since_row_ = loads_now_;
  } else {
    loads.values.insert(loads.values.end(), loads_now_.begin(), loads_now_.end());
    since_row_.clear();
  }
}

void Recorder::finish(std::int64_t steps, double t, const Outcome& outcome, const Sample& last) {
  // Loads since the last row, for a run that has diverged.
  recording.loads.values.insert(recording.loads.values.end(), since_row_.begin(), since_row_.end());
  if (loads_) loads_->drop_idle_feet(recording.loads);
  recording.steps = steps;
  recording.simulated = t;
  recording.tally = last.tally;
  recording.ledger = last.ledger;
  recording.outcome = outcome;
}

}  // namespace gaitlab
