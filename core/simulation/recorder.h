// The recording of one lane as it grows: rows of the trace, of ticks, poses and loads, and the numbers at its end.
#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "core/recording/recording.h"
#include "core/simulation/load_meter.h"
#include "core/simulation/probes.h"
#include "core/simulation/records.h"

namespace gaitlab {

/// Takes samples and writes them down; what a sample holds is the simulation's. Allocates at construction, and for rows of
/// loads.
class Recorder {
 public:
  /// sample: the lane's, as at the start; it outlives this, as do scenario and contacts. Throws InputError: a column that does
  /// not exist; rows that do not fit into memory.
  Recorder(const Scenario& scenario, const std::vector<ContactElement>& contacts, const Cpg* cpg, std::string_view command_unit,
           const Sample& sample, const Records& wanted);

  [[nodiscard]] RowsNeeded rows_needed() const;

  [[nodiscard]] bool has_rows() const { return probes_ != nullptr; }
  /// Inputs of the columns of a row (Probes); false without rows.
  [[nodiscard]] bool wants_places() const { return has_rows() && probes_->want_places(); }
  [[nodiscard]] bool wants_reactions() const { return has_rows() && probes_->want_reactions(); }
  /// A row of Recording::trace and rest, from the sample.
  void add_row();

  /// Whether Recording::ticks has a row at the next control tick.
  [[nodiscard]] bool tick_due() const { return recording.control_ticks % ticks_per_row_ == 0; }
  /// A row of Recording::ticks: its numbers behind the time, to be filled in; nothing: that row exists already, or the rows
  /// have just become fewer. last: the lane ends.
  std::optional<Out> add_tick(double t, bool last);
  /// A row of Recording::poses: state, set points, centre of mass and contacts of the sample.
  void add_pose(double t, const Sample& sample);

  /// Whether the last row of ticks lacks one of Recording::loads.
  [[nodiscard]] bool loads_due() const { return loads_due_; }
  void leave_out_loads() { loads_due_ = false; }
  /// The meter whose sample is to be filled in before add_loads; only if loads_due().
  [[nodiscard]] LoadMeter& loads() { return *loads_; }
  void add_loads();

  /// The numbers at the end, from the last sample.
  void finish(std::int64_t steps, double t, const Outcome& outcome, const Sample& last);

  Recording recording;

 private:
  void reserve_rows(const Scenario& scenario);
  void release_rows();

  const Scenario& scenario_;
  std::unique_ptr<Probes> probes_;    ///< nullptr: no rows
  std::unique_ptr<LoadMeter> loads_;  ///< nullptr: not wanted
  std::int64_t ticks_per_row_ = 1;    ///< control ticks per row of Recording::ticks
  bool loads_due_ = false;
  std::size_t unreleased_ = 0;  ///< rows since release_rows() let their pages leave memory
};

}  // namespace gaitlab
