// Recorder of one lane: rows of the trace, ticks, poses and loads, and the totals at the end.
#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "core/errors.h"
#include "core/recording/recording.h"
#include "core/simulation/bus_state.h"
#include "core/simulation/load_meter.h"
#include "core/simulation/probes.h"
#include "core/simulation/records.h"

namespace gaitlab {

/// Error for a run whose rows exceed the memory or the disk.
class TooManyRows : public InputError {
 public:
  using InputError::InputError;
};

/// Adds rows to the recording from samples, which the simulation fills. Allocates at construction, and for rows of loads.
class Recorder {
 public:
  /// `rated_gears` are the joints whose gears have a rated peak torque. `sample` is the sample of the lane in its initial
  /// state. `sample`, `scenario` and `contacts` must outlive this object. Throws InputError if a column does not exist or the
  /// rows do not fit into memory.
  Recorder(const Scenario& scenario, const std::vector<ContactElement>& contacts, const Cpg* cpg, std::string_view command_unit,
           const Sample& sample, const Records& wanted, std::vector<std::size_t> rated_gears = {});

  [[nodiscard]] RowsNeeded rows_needed() const;

  [[nodiscard]] bool has_rows() const { return probes_ != nullptr; }
  /// True if columns of the trace need places of bodies, or reactions (Probes). False without rows.
  [[nodiscard]] bool wants_places() const { return has_rows() && probes_->want_places(); }
  [[nodiscard]] bool wants_reactions() const { return has_rows() && probes_->want_reactions(); }
  /// Adds a row to Recording::trace and Recording::rest from the sample.
  void add_row();

  /// True if Recording::ticks gets a row at the next control tick.
  [[nodiscard]] bool tick_due() const { return recording.control_ticks % ticks_per_row_ == 0; }
  /// Adds a row to Recording::ticks with the time t, and returns its other numbers, which the caller fills in. Returns nothing
  /// if the row exists already, or if rows were just thinned out so that this tick is no longer due. `last` is true when the
  /// lane ends.
  std::optional<Out> add_tick(double t, bool last);
  /// Marks a control tick without a row. Its loads count for the next row.
  void skip_tick();
  /// Adds the buses of a control tick and of the time until the next tick to the next row of Recording::supply.
  void add_buses(std::span<const BusState> all);
  /// Adds a row to Recording::poses: state, set points, centre of mass and contacts of the sample.
  void add_pose(double t, const Sample& sample);

  /// True if the loads of this control tick have not been measured yet.
  [[nodiscard]] bool loads_due() const { return loads_due_; }
  void leave_out_loads() { loads_due_ = false; }
  /// True if the loads of docks or gears are measured, also between control ticks.
  [[nodiscard]] bool watches_docks() const { return loads_ != nullptr && loads_->want_reactions(); }
  /// Meter whose sample the caller fills before add_loads() or LoadMeter::watch(). Requires loads_due() or watches_docks().
  [[nodiscard]] LoadMeter& loads() { return *loads_; }
  /// Measures the loads, and adds them as a row to Recording::loads if the tick has a row.
  void add_loads();

  /// Sets the totals of the recording at its end, from the last sample.
  void finish(std::int64_t steps, double t, const Outcome& outcome, const Sample& last);

  Recording recording;

 private:
  void reserve_rows(const Scenario& scenario);
  void release_rows();

  const Scenario& scenario_;
  std::unique_ptr<Probes> probes_;    ///< nullptr if no rows are wanted
  std::unique_ptr<LoadMeter> loads_;  ///< nullptr if no loads are wanted
  std::int64_t ticks_per_row_ = 1;    ///< control ticks per row of Recording::ticks
  std::int64_t ticks_per_load_ = 1;   ///< control ticks per measurement of loads; ticks_per_row_ at the start
  bool loads_due_ = false;
  bool skipped_ = false;               ///< true if the loads that are due have no row
  std::vector<double> since_row_;      ///< worst loads since the last row; empty if none were measured
  std::vector<double> loads_now_;      ///< scratch: the loads of this tick
  std::vector<double> bus_since_row_;  ///< next row of Recording::supply; empty without a supply
  std::size_t unreleased_ = 0;         ///< rows since the last release_rows(), which lets their pages leave memory
};

}  // namespace gaitlab
