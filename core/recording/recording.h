// A run as a value: its rows, and the statistics of all its steps. Summary, figures, goldens and pages use it, for a run that
// has just ended and for one in a folder.
#pragma once
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

/// One column of a table, row by row; valid as long as the table is not changed.
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

/// Patterns of the columns that summary, figures and warnings use; recorded for any `trace.columns`.
const std::vector<std::string>& report_columns();

inline constexpr std::size_t kMostTickRows = 20000;  ///< of Recording::ticks, even: 5 min of control ticks 15 ms apart
/// Columns of a joint in Recording::ticks, after t.
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

/// Recording of one rollout.
struct Recording {
  /// Rows at every trace tick, and at the end, or some of them (thin_rows). trace: the columns that `trace.columns` names;
  /// rest: the other ones of report_columns().
  Trace trace, rest;
  std::string hash_of_all;  ///< hash() of all rows of `trace`; empty: these are all
  /// At control ticks at least 2 ms apart (above 20 000 rows: every second of them, and so on), and at the end: for each joint
  /// the largest |torque| (and whether the motor was at a limit then), |set point - angle|, |speed|, |voltage|, |current| and
  /// share of the available torque since the row before, and from t = 0 the integrals of torque^2 and current^2 and the time at
  /// each limit. Over all steps, so that a peak or an RMS of any part of the run does not depend on trace.period.
  Trace ticks;
  bool ticks_of_rows = false;  ///< `ticks` were computed from the trace's rows: the folder has no statistics of all steps
  /// Rows as in `ticks`, but under the new commands: loads of docks and feet, slip distances of feet, stability margin. Without
  /// columns if the simulation was not told to record them.
  Trace loads;
  /// Rows as in `ticks`: pose of the base, angles and set points of the joints, centre of mass, and normal force of the ground
  /// on the robot. Folders of older formats have no rows, or only pose and angles.
  Trace poses;
  /// For a motion that is not predictable: numbers (report/verdict/spread.h) of this run, then of runs under a minimally
  /// different gravity, a row each. Without columns if predictability was not tested.
  Trace spread;
  std::vector<JointStatistics> joints;  ///< empty: the robot has no joints, or the run has a format without them
  Ledger ledger;                        ///< at the end
  StepTally tally;                      ///< of the engine's steps
  double simulated = 0;                 ///< s
  Stability worst;                      ///< the largest rate seen at a control tick
  double worst_time = 0;                ///< s
  std::int64_t control_ticks = 0, control_ticks_above_1 = 0;
  std::int64_t steps = 0;
  Outcome outcome;

  [[nodiscard]] std::size_t rows() const { return trace.rows(); }
  [[nodiscard]] std::string trace_hash() const { return hash_of_all.empty() ? hash(trace) : hash_of_all; }
  /// A column of `trace` or `rest` by name; empty if neither has it.
  [[nodiscard]] Series series(const std::string& column) const;
  /// `joint.N.QUANTITY`: angle, setpoint, torque.
  [[nodiscard]] Series joint(std::size_t number, const char* quantity) const;
  /// A column of `poses` by name; empty if a folder of an older format does not have it.
  [[nodiscard]] Series pose(const std::string& column) const;
  /// Centre of mass at the time of a row.
  [[nodiscard]] Vec3 com(std::size_t row) const;
  /// Displacement of the centre of mass from the first row to the last.
  [[nodiscard]] Vec3 travel() const { return rows() == 0 ? Vec3(Vec3::Zero()) : Vec3(com(rows() - 1) - com(0)); }
  /// Number of joints in `ticks`.
  [[nodiscard]] std::size_t ticked() const {
    return joints.empty() ? (ticks.columns.size() + kTickColumns - 2) / kTickColumns : joints.size();
  }
  /// A joint's column of `ticks`; empty if it is missing, as in a folder of an older format.
  [[nodiscard]] Series tick(std::size_t joint, TickColumn column) const;
  /// Whether the columns for `state` exist, as they do except in a folder of an older format.
  [[nodiscard]] bool has_states(const Robot& robot) const;
  /// Angles and pose at the time of a row; speeds 0.
  [[nodiscard]] RobotState state(const Robot& robot, std::size_t row) const;
};

/// All rows of a recording that keeps only some of them.
struct AllRows {
  Trace trace, rest;
  /// Exchanges these rows with those of the recording.
  void swap(Recording& r);
};

/// Reduces the rows of a recording to every k-th and the last, with the least k for which trace and rest have at most `most`
/// bytes. Returns all rows, or nothing if k is 1. Travel, figures and pages use such rows; peaks and checks use `ticks`,
/// `poses` and `loads`, which stay.
std::optional<AllRows> thin_rows(Recording& r, std::size_t most = kMostInMemory);

/// Columns of Recording::ticks for `joints` joints, and of Recording::poses; older folders have only the first of the latter.
std::vector<Column> tick_columns(std::size_t joints);
std::vector<Column> pose_columns(std::size_t joints);
constexpr std::size_t old_pose_columns(std::size_t joints) { return 8 + joints; }
/// Merges each two rows after the first: the later one, with the larger of their peaks.
void halve_ticks(Trace& ticks);
/// Merges each two rows after the first: the later one, with the larger of their loads of docks and the smaller stability
/// margin.
void halve_rows(Trace& table);

}  // namespace gaitlab
