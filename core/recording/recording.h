// Recording of a run, from the simulation or a run folder: rows, and statistics over all steps.
#pragma once
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/model/kinematics.h"
#include "core/recording/ledger.h"
#include "core/recording/outcome.h"
#include "core/recording/statistics.h"
#include "core/recording/trace.h"

namespace gaitlab {

/// View of one column of a table. The view is valid until the table changes.
class Series {
 public:
  Series() = default;
  Series(const Trace& table, std::size_t column)
      : first_(table.values.data() + column), stride_(table.columns.size()), size_(table.rows()) {}
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] bool empty() const { return size_ == 0; }
  double operator[](std::size_t row) const { return first_[row * stride_]; }
  [[nodiscard]] double front() const { return (*this)[0]; }
  [[nodiscard]] double back() const { return (*this)[size_ - 1]; }
  [[nodiscard]] std::vector<double> values() const;

 private:
  const double* first_ = nullptr;
  std::size_t stride_ = 0, size_ = 0;
};

/// Patterns for the columns that summary, figures and warnings need. These columns are recorded whatever `trace.columns`
/// selects.
const std::vector<std::string>& report_columns();

inline constexpr std::size_t kMostTickRows = 20000;  ///< most rows of Recording::ticks, even; 5 min of ticks every 15 ms
/// Columns of each joint in Recording::ticks, after the column t.
enum TickColumn : std::size_t {
  kTorquePeak,
  kErrorPeak,
  kPeakLimit,
  kTorqueSquare,
  kVoltageLimited,
  kCurrentLimited,
  kSpeedPeak,
  kEnvelopePeak,
  kCurrentSquare,
  kVoltagePeak,
  kCurrentPeak,
  kTickColumns
};

/// Columns of the first bus in Recording::supply, after the column t. Those of each further bus follow.
enum SupplyColumn : std::size_t { kLeastVoltage = 1, kLargestCurrent, kHeld, kCharge, kBusSquare };
inline constexpr std::size_t kBusColumns = kBusSquare;  ///< per bus

/// Recording of one rollout.
struct Recording {
  /// Rows at every trace tick and at the end, or every k-th of these rows (see thin_rows). `trace` has the columns that
  /// `trace.columns` selects. `rest` has the other columns of report_columns().
  Trace trace, rest;
  std::string hash_of_all;  ///< hash() of `trace` before thin_rows() removed rows; empty if none were removed
  /// Rows at control ticks that are at least 2 ms apart, and at the end. Above 20 000 rows, every second row is removed,
  /// repeatedly. A row has, for each joint, the largest |torque|, |set point - angle|, |speed|, |voltage|, |current| and share
  /// of the available torque since the previous row. It also has the motor limit at the largest torque and, from t = 0, the
  /// integrals of torque^2 and current^2 and the time at each limit. All steps count, so that peaks and RMS values of any part
  /// of the run do not depend on trace.period.
  Trace ticks;
  /// Loads of docks and feet, slip distances of feet and stability margin, with the rows of `ticks` but under the new commands.
  /// It has no columns if no loads were to be recorded.
  Trace loads;
  /// Pose of the base, angles and set points of the joints, centre of mass, and normal force of the ground on the robot, with
  /// the rows of `ticks`.
  Trace poses;
  /// Numbers (report/verdict/spread.h) of a motion that is not predictable: of this run in the first row, and of runs under
  /// minimally different gravity in the other rows. It has no columns if predictability was not tested.
  Trace spread;
  /// Verdicts on this run in the first row, and on draws with other seeds in the other rows (report/verdict/draws.h). It has no
  /// columns without draws.
  Trace draws;
  /// Bus of a scenario with a supply, with the times of `ticks`: the least voltage and the largest current at the control ticks
  /// since the previous row, 0 in `held` if no voltage satisfied its law at one of them, and, from t = 0, the charge drawn and
  /// the integral of current^2. It has no columns without a supply.
  Trace supply;
  double current_peak = NAN, current_rms = NAN;  ///< A, of the sum of all motors' |current|; NaN if no currents are known
  std::vector<JointStatistics> joints;           ///< empty if the robot has no joints
  Ledger ledger;                                 ///< energies at the end
  StepTally tally;                               ///< counts of the steps of the engine
  double simulated = 0;                          ///< s
  Stability worst;                               ///< largest damping rate at a control tick
  double worst_time = 0;                         ///< s
  std::int64_t control_ticks = 0, control_ticks_above_1 = 0;
  std::int64_t steps = 0;
  Outcome outcome;

  [[nodiscard]] std::size_t rows() const { return trace.rows(); }
  /// True if only rows of the trace exist, as from a CSV file without recording.h5. Every other recording has poses.
  [[nodiscard]] bool rows_alone() const { return rows() > 0 && poses.columns.empty(); }
  [[nodiscard]] std::string trace_hash() const { return hash_of_all.empty() ? hash(trace) : hash_of_all; }
  /// A column of `trace` or `rest` by name; empty if neither has it.
  [[nodiscard]] Series series(const std::string& column) const;
  /// Column `joint.N.QUANTITY`, where QUANTITY is angle, setpoint or torque.
  [[nodiscard]] Series joint(std::size_t number, const char* quantity) const;
  /// Number of buses in `supply`.
  [[nodiscard]] std::size_t buses() const { return supply.columns.empty() ? 0 : (supply.columns.size() - 1) / kBusColumns; }
  /// Number in a row of `supply`.
  [[nodiscard]] double bus(std::size_t row, std::size_t number, SupplyColumn column) const {
    return supply.at(row, number * kBusColumns + column);
  }
  /// A column of `poses` by name; empty if the column does not exist.
  [[nodiscard]] Series pose(const std::string& column) const;
  /// Centre of mass at the time of a row.
  [[nodiscard]] Vec3 com(std::size_t row) const;
  /// Displacement of the centre of mass from the first row to the last.
  [[nodiscard]] Vec3 travel() const { return rows() == 0 ? Vec3(Vec3::Zero()) : Vec3(com(rows() - 1) - com(0)); }
  /// Number of joints in `ticks`.
  [[nodiscard]] std::size_t ticked() const {
    return joints.empty() ? (ticks.columns.size() + kTickColumns - 2) / kTickColumns : joints.size();
  }
  /// Column of `ticks` for one joint; empty if it is missing (rows_alone()).
  [[nodiscard]] Series tick(std::size_t joint, TickColumn column) const;
  /// True if the columns that state() needs exist. Only some CSV files lack them.
  [[nodiscard]] bool has_states(const Robot& robot) const;
  /// Angles and pose at the time of a row. The speeds are 0.
  [[nodiscard]] RobotState state(const Robot& robot, std::size_t row) const;
};

/// All rows of a recording that keeps every k-th row.
struct AllRows {
  Trace trace, rest;
  std::size_t stride = 1;  ///< k
  /// Exchanges these rows with the rows of the recording.
  void swap(Recording& r);
};

/// Keeps every k-th row of a recording and the last one. k is the smallest number for which `trace` and `rest` together do not
/// exceed `most` bytes. Returns all rows, or nothing if k is 1. The reduced rows have a k times longer trace period. travel(),
/// figures and pages use the reduced rows. Peaks and checks use `ticks`, `poses` and `loads`, which are not reduced.
std::optional<AllRows> thin_rows(Recording& r, std::size_t most = kMostInMemory);

/// Columns of Recording::ticks and of Recording::poses for `joints` joints.
std::vector<Column> tick_columns(std::size_t joints);
std::vector<Column> pose_columns(std::size_t joints);
/// Columns of Recording::supply, for the buses of these modules (`m3`; "" for the scenario's supply).
std::vector<Column> supply_columns(const std::vector<std::string>& modules = {""});
/// Merges each pair of rows after the first row into the later one, with the larger peaks of both.
void halve_ticks(Trace& ticks);
/// Merges each pair of rows after the first row into the later one by keep_worst().
void halve_rows(Trace& table);
/// Copies the worse numbers of the previous row into `now`: larger dock loads, the smaller stability margin, the lower voltage
/// and larger current of the bus. Tension is signed, and the stability margin is NaN while nothing touches the ground.
void keep_worst(const ColumnList& columns, In before, Out now);

}  // namespace gaitlab
