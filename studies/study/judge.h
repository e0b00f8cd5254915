// Scoring of the run of a point: its objectives and its violation of constraints and guards.
#pragma once
#include <array>
#include <span>
#include <string>
#include <vector>

#include "core/recording/recording.h"
#include "core/scenario/scenario.h"
#include "core/simulation/simulation.h"
#include "studies/study/guards.h"
#include "studies/study/study.h"

namespace gaitlab::studies {

/// A quantity: a column of the journal.
struct Quantity {
  std::string name, unit, meaning;
};

/// Quantities and checks that the program offers.
struct QuantityOffer {
  std::vector<Quantity> common;     ///< of every run
  std::vector<Quantity> of_joints;  ///< names that accept [JOINT]
  std::vector<CheckOffer> checks;   ///< of the verdict, in its order
  /// Names of quantities known during a run, with and without [JOINT]; and the function that computes them from the recording
  /// so far.
  std::vector<std::string> so_far = {};
  std::function<double(const std::string& name, const std::string& joint, const Scenario& scenario, const Recording& so_far)>
      value_so_far = {};
};

/// The quantities of one run, by column, NaN if not known; the word of its verdict, and the sentence after it.
struct Judged {
  std::vector<double> quantities;
  std::string verdict, why;
};
/// Function that judges a run, with the parts of its recording that it needs. May be called from several threads at once.
struct Measure {
  std::function<Judged(const Scenario&, const Recording&)> judged;
  Records reads;
  Judged operator()(const Scenario& scenario, const Recording& recording) const { return judged(scenario, recording); }
};

/// A limit: a constraint, or a guard.
struct Limit {
  std::string text;  ///< `torque.rms <= 0.6`
  bool guard = false;
};

struct Score {
  std::array<double, kMostObjectives> objectives{};  ///< by objective of the study; NaN: not known
  double violation = 0;                              ///< sum over constraints and guards of their relative violations; 0: none
  [[nodiscard]] double objective() const { return objectives[0]; }
  [[nodiscard]] bool kept() const { return violation == 0; }
};

/// Scores runs of one study. A constraint with unknown quantities counts as broken by 1; a guard on a margin that the run does
/// not have (of motors, in a robot without motors) does not count.
class Judge {
 public:
  /// `columns` of the journal, in order. Faults of expressions and unknown quantities are problems at their places.
  Judge(const Study& study, const std::vector<Quantity>& columns, const QuantityOffer& offer,
        const std::vector<std::string>& joints, Problems& problems);

  [[nodiscard]] Score score(std::span<const double> quantities, const std::string& verdict) const;
  /// Constraints and guards that a run breaks, `torque.rms <= 0.6 (0.7)`; `why`: the sentence after its verdict.
  [[nodiscard]] std::vector<std::string> broken(std::span<const double> quantities, const std::string& verdict,
                                                const std::string& why) const;
  /// Constraints, then guards.
  [[nodiscard]] std::vector<Limit> limits() const;
  [[nodiscard]] const std::vector<std::string>& objectives() const { return objective_texts_; }

 private:
  Naming find(const std::string& name, const std::string& joint) const;

  std::vector<Quantity> columns_;
  QuantityOffer offer_;
  std::vector<std::string> joints_;
  std::vector<Formula> objectives_;
  std::vector<std::string> objective_texts_;
  std::vector<Formula> constraints_;
  std::vector<std::string> constraint_texts_;
  Guards guards_;
};

/// Violation of a relation a <= b, a >= b or a == b; in a guard an unknown value does not count.
double broken(const Formula& relation, std::span<const double> quantities, bool guard = false);

/// Violation of a limit: max(0, value - limit) / |limit| (limit 0: divided by 1); `least`: with the opposite sign; 1 for an
/// unknown value.
double broken(double value, double limit, bool least);

/// Columns of a journal: all quantities of every run, and the quantities of single joints that the study names. Judge reports
/// unknown joints.
std::vector<Quantity> columns_of(const Study& study, const QuantityOffer& offer, const std::vector<std::string>& joints);

}  // namespace gaitlab::studies
