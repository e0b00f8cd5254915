// Score of a run: its objectives, and its violation of constraints and guards.
#pragma once
#include <array>
#include <span>
#include <string>
#include <vector>

#include "core/recording/recording.h"
#include "core/recording/word.h"
#include "core/scenario/scenario.h"
#include "core/simulation/simulation.h"
#include "studies/study/guards.h"
#include "studies/study/study.h"

namespace gaitlab::studies {

/// A quantity, stored as a column of the journal.
struct Quantity {
  std::string name, unit, meaning;
};

/// The check that decided a verdict, and its part. Both are empty if no check decided it.
struct Cause {
  std::string check, part;
  /// Text such as `dock bending of m5`.
  [[nodiscard]] std::string text() const;
};

/// Quantities and checks that the program offers.
struct QuantityOffer {
  std::vector<Quantity> common;     ///< quantities that every run has
  std::vector<Quantity> of_joints;  ///< quantities whose names accept [JOINT]
  std::vector<CheckOffer> checks;   ///< checks of the verdict, in its order
  /// Names of the quantities that are known during a run, with and without [JOINT]. `value_so_far` computes such a quantity
  /// from the recording so far.
  std::vector<std::string> so_far = {};
  std::function<double(const std::string& name, const std::string& joint, const Scenario& scenario, const Recording& so_far)>
      value_so_far = {};
  /// First check of the guards that a run has lost before its end; empty without such a check.
  std::function<Cause(std::span<const MarginGuard> guards, const Scenario& scenario, const Recording& so_far)> lost_so_far = {};
};

/// Result of one run: its quantities by column (NaN if not known), the word of its verdict, the reason for that word as a
/// sentence, and its cause.
struct RunMeasured {
  std::vector<double> quantities;
  Word verdict = Word::not_judged;
  std::string why;
  Cause cause = {};
};
/// Function that computes the quantities of a run, with the parts of the recording that the function reads. Several threads may
/// call it at once.
struct Measure {
  std::function<RunMeasured(const Scenario&, const Recording&)> measured;
  Records reads;
  RunMeasured operator()(const Scenario& scenario, const Recording& recording) const { return measured(scenario, recording); }
};

/// A limit of a study: a constraint or a guard.
struct Limit {
  std::string text;  ///< text, as in `torque.rms <= 0.6`
  bool guard = false;
};

struct Score {
  std::array<double, kMostObjectives> objectives{};  ///< values by objective of the study; NaN if not known
  /// Sum of limited_violation() over constraints and guards, plus 1 for each unknown objective.
  double violation = 0;
  [[nodiscard]] double objective() const { return objectives[0]; }
  [[nodiscard]] bool kept() const { return violation == 0; }
};

/// Scores the runs of one study. A constraint with an unknown quantity has a relative violation of 1. A guard does not count if
/// the run lacks its margin, such as a motor's margin in a robot without motors.
class Scorer {
 public:
  /// `columns` are those of the journal, in order. Faulty expressions and unknown quantities are problems at their places.
  Scorer(const Study& study, const std::vector<Quantity>& columns, const QuantityOffer& offer,
         const std::vector<std::string>& joints, Problems& problems);

  /// Score of a run. Without `reserve`, a margin of 0 suffices if the study requires more.
  [[nodiscard]] Score score(std::span<const double> quantities, Word verdict, bool reserve = true) const;
  /// Constraints and guards that a run violates, as in `torque.rms <= 0.6 (0.7)`. `why` is the sentence after the verdict.
  [[nodiscard]] std::vector<std::string> broken(std::span<const double> quantities, Word verdict, const std::string& why,
                                                bool reserve = true) const;
  /// All limits of the study: constraints, then guards.
  [[nodiscard]] std::vector<Limit> limits() const;
  [[nodiscard]] const std::vector<std::string>& objectives() const { return objective_texts_; }
  /// Guards on margins, in the order of the checks of the verdict.
  [[nodiscard]] const std::vector<MarginGuard>& margins() const { return guards_.margins(); }

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

/// Violation of a relation a <= b, a >= b or a == b. An unknown a in a guard gives 0.
double broken(const Formula& relation, std::span<const double> quantities, bool guard = false);

/// Relative violation of an upper limit: max(0, value - limit) / |limit|, or max(0, value - limit) if the limit is 0. If
/// `least` is true, the limit is a lower one. An unknown value or limit gives 1.
double broken(double value, double limit, bool least);

/// Columns of a journal: all quantities of every run, and the quantities of single joints that the study names. Unknown joints
/// are omitted here, because Scorer reports them.
std::vector<Quantity> columns_of(const Study& study, const QuantityOffer& offer, const std::vector<std::string>& joints);

}  // namespace gaitlab::studies
