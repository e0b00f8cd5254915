// Error of the simulated logs as a function of the fitted keys, to second order about a point.
#pragma once
#include <Eigen/Dense>
#include <atomic>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/simulation/batch.h"
#include "identify/bench.h"
#include "identify/key.h"
#include "report/analysis/measured.h"

namespace gaitlab::identify {

/// Values of some of the keys; the others keep the values of the bench.
struct Point {
  std::vector<std::size_t> keys;  ///< indices into the list of all keys
  Eigen::VectorXd values;         ///< one per key, in its unit
};

/// Error of a log about a point: the mean of 2 (sqrt(1 + r^2) - 1) over its rows, joints and compared quantities, which is r^2
/// for small differences r = (simulated - measured) / b and 2 |r| for large ones (pseudo-Huber: P. Charbonnier et al.,
/// Deterministic edge-preserving regularization, 1997, eq. 8), so that a few rows far off do not decide. b is a width for each
/// quantity. As a function of the keys:
///
///     cost + 2 gradient . d + d . curvature d        d: change of the keys, each in units of its scale
///
/// gradient = J' W r / n, curvature = J' W J / n with the differences J of r and W = 1 / sqrt(1 + r^2), whose parabola is above
/// the error. `local` = J' W^3 J / n is the curvature itself, for intervals.
struct ErrorModel {
  bool whole = false;  ///< false if the run was refused or diverged; the other numbers are then 0
  double cost = 0;
  double mae = 0;  ///< mean of |r|
  Eigen::VectorXd gradient;
  Eigen::MatrixXd curvature, local;
};

struct Question {
  std::size_t log = 0;
  Point point;
};

/// A log beside its run at a point.
struct Compared {
  std::optional<report::LogErrors> errors;      ///< none if the run did not reach its end
  double largest_current = 0;                   ///< A, of the logged joints
  double largest_speed = 0;                     ///< rad/s, of the logged joints
  double largest_torque = 0;                    ///< N m, on the logged joints, over all steps
  std::vector<MeasuredLog::OfJoint> simulated;  ///< as MeasuredLog::joints: values of the run at the rows of the log
};

/// Mean magnitude of the differences of a run from its log, in the unit of the quantity.
double error_of(const Compared& run, Logged kind);
/// Mean of it over the logs that are held out, or over the others; nothing without such logs.
std::optional<double> mean_error(const std::vector<BenchLog>& logs, const std::vector<Compared>& runs, Logged kind,
                                 bool held_out);

/// Thrown by ErrorModels if its work was stopped.
struct Stopped {};

/// Simulator of the logs of a bench at any point.
class ErrorModels {
 public:
  /// `kinds` are the compared quantities. b is half the mean magnitude of the differences of a quantity at the values of the
  /// bench, over the fitted logs. Logs and keys must outlive this object. Throws RunError if a run of the bench does not reach
  /// its end.
  ErrorModels(const std::vector<BenchLog>& logs, const std::vector<Key>& keys, std::vector<Logged> kinds, int threads,
              std::atomic<bool>& stop);

  /// Answers in the order of the questions. Each needs a run for the point and one for each of its keys, which share lanes. The
  /// answers do not depend on threads. Throws Stopped if `stop` was set.
  std::vector<ErrorModel> operator()(std::span<const Question> questions);

  /// Every log beside its run at a point, in the order of the logs. Throws InputError for a point that a scenario refuses.
  std::vector<Compared> compared(const Point& point);

  [[nodiscard]] const std::vector<Key>& keys() const { return keys_; }
  [[nodiscard]] const std::vector<BenchLog>& logs() const { return logs_; }
  [[nodiscard]] const std::vector<Logged>& kinds() const { return kinds_; }
  [[nodiscard]] std::size_t runs() const { return runs_; }
  /// Unit in which a change of a key is counted: its start value, or a part of its range if that is 0.
  [[nodiscard]] double scale(std::size_t key) const;

 private:
  void run(std::size_t count, const std::function<Scenario(std::size_t)>& scenario,
           const std::function<void(const RolloutEnd&)>& end);
  [[nodiscard]] Point varied(const Point& point, std::size_t key) const;
  [[nodiscard]] double step(const Point& point, std::size_t varied) const;

  const std::vector<BenchLog>& logs_;
  const std::vector<Key>& keys_;
  std::vector<Logged> kinds_;
  int threads_;
  std::atomic<bool>& stop_;
  std::size_t runs_ = 0;
  std::vector<double> widths_;  ///< b of each of kinds_, in its unit
};

/// The settings of a point in the form of --set: of all keys, because a usual value may follow from another key.
std::vector<std::string> sets_of(const Point& point, const std::vector<Key>& keys);

}  // namespace gaitlab::identify
