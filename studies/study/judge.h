// By what the run of a point is judged: its objective, and how far it is from what is allowed.
#pragma once
#include <array>
#include <span>
#include <string>
#include <vector>

#include "core/recording/recording.h"
#include "core/scenario/scenario.h"
#include "studies/study/guards.h"
#include "studies/study/study.h"

namespace gaitlab::studies {

/// A quantity, which is a column of the journal.
struct Quantity {
  std::string name, unit, meaning;
};

/// What the program can tell of a run.
struct QuantityOffer {
  std::vector<Quantity> common;     ///< of every run
  std::vector<Quantity> of_joints;  ///< names that may be followed by [JOINT]
  std::vector<CheckOffer> checks;   ///< of the verdict, in its order
  /// What is known while a run goes on: names, with and without [JOINT]; and how to learn it of what is recorded so far.
  std::vector<std::string> so_far = {};
  std::function<double(const std::string& name, const std::string& joint, const Scenario& scenario, const Recording& so_far)>
      value_so_far = {};
};

/// The quantities of one run, by column, NaN where not known; the word of its verdict, and the sentence behind it.
struct Judged {
  std::vector<double> quantities;
  std::string verdict, why;
};
/// May be called from several threads at once.
using Measure = std::function<Judged(const Scenario&, const Recording&)>;

/// A limit: a constraint, or a guard.
struct Limit {
  std::string text;  ///< `torque.rms <= 0.6`
  bool guard = false;
};

struct Score {
  std::array<double, kMostObjectives> objectives{};  ///< of the study; NaN: not known
  double violation = 0;                              ///< sum over constraints and guards of how far each is broken; 0: none is
  [[nodiscard]] double objective() const { return objectives[0]; }
  [[nodiscard]] bool kept() const { return violation == 0; }
};

/// Judges runs of one study. A constraint whose quantities are not known counts as broken by 1; a guard on a margin that the
/// run does not have (of motors, where nothing drives the joints) does not count.
class Judge {
 public:
  /// `columns`: of the journal, in order. Faults of expressions and unknown quantities are problems at their places.
  Judge(const Study& study, const std::vector<Quantity>& columns, const QuantityOffer& offer,
        const std::vector<std::string>& joints, Problems& problems);

  [[nodiscard]] Score score(std::span<const double> quantities, const std::string& verdict) const;
  /// Constraints and guards that a run breaks, `torque.rms <= 0.6 (0.7)`; `why`: the sentence behind its verdict.
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

/// How far a relation a <= b, a >= b or a == b is broken; of a guard, what is not known does not count.
double broken(const Formula& relation, std::span<const double> quantities, bool guard = false);

/// How far a limit is broken: max(0, value - limit) / |limit| (of 0: over 1); `least` the other way round; 1 of what is not
/// known.
double broken(double value, double limit, bool least);

/// The columns of a journal: all quantities of every run, and of those of one joint what the study names. Unknown joints are
/// told by Judge.
std::vector<Quantity> columns_of(const Study& study, const QuantityOffer& offer, const std::vector<std::string>& joints);

}  // namespace gaitlab::studies
