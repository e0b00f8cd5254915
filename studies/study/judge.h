// By what the run of a point is judged: its objective, and how far it is from what is allowed.
#pragma once
#include <array>
#include <span>
#include <string>
#include <vector>

#include "core/recording/recording.h"
#include "core/scenario/scenario.h"
#include "studies/study/study.h"

namespace gaitlab::studies {

/// A figure, which is a column of the journal.
struct FigureName {
  std::string name, unit, meaning;
};

/// What the program can tell of a run.
struct FigureOffer {
  std::vector<FigureName> common;     ///< of every run
  std::vector<FigureName> of_joints;  ///< names that may be followed by [JOINT]
  /// What is known while a run goes on: names, with and without [JOINT]; and how to learn it of what is recorded so far.
  std::vector<std::string> so_far = {};
  std::function<double(const std::string& name, const std::string& joint, const Scenario& scenario, const Recording& so_far)>
      value_so_far = {};
};

/// The figures of one run, by column, NaN where not known; and the word of its verdict.
struct Judged {
  std::vector<double> figures;
  std::string verdict;
};
/// May be called from several threads at once.
using Measure = std::function<Judged(const Scenario&, const Recording&)>;

/// What a gait must keep so that its figures mean something: a figure and the most (or least) that it may be.
struct Guard {
  const char* figure;
  bool least;  ///< the limit is the least that is allowed
  double (*limit)(const Limits& limits);
  const char* about;
};
/// Those of `guards: gait`; the last stands only where the objective names the electrical cost of transport.
std::span<const Guard> guards();

/// A limit: a constraint, or a guard.
struct Limit {
  std::string text;  ///< `torque.rms <= 0.6`
  bool guard = false;
};

struct Score {
  std::array<double, kMostObjectives> objectives{};  ///< of the study; NaN: not known
  double violation = 0;                              ///< sum over constraints and guards of how far each is broken; 0: none is
  [[nodiscard]] double objective() const { return objectives[0]; }
  [[nodiscard]] bool feasible() const { return violation == 0; }
};

/// Judges runs of one study. A constraint whose figures are not known counts as broken by 1; a guard whose figure the run does
/// not have (of motors, where nothing drives the joints) does not count.
class Judge {
 public:
  /// `columns`: of the journal, in order. Faults of expressions and unknown figures are problems at their places.
  Judge(const Study& study, const std::vector<FigureName>& columns, const FigureOffer& offer, const Limits& limits,
        const std::vector<std::string>& joints, Problems& problems);

  [[nodiscard]] Score score(const Scenario& scenario, std::span<const double> figures) const;
  /// Constraints and guards that a run breaks, `range.share <= 0.01 (0.2)`.
  [[nodiscard]] std::vector<std::string> broken(const Scenario& scenario, std::span<const double> figures) const;
  /// Constraints, then guards.
  [[nodiscard]] std::vector<Limit> limits() const;
  [[nodiscard]] const std::vector<std::string>& objectives() const { return objective_texts_; }

 private:
  struct Kept {
    const Guard* guard;
    std::size_t column;
    std::optional<double> limit;  ///< of the study instead of the scenario
  };
  Naming find(const std::string& name, const std::string& joint) const;
  void read_guards(const Study& study, Problems& problems);

  std::vector<FigureName> columns_;
  FigureOffer offer_;
  Limits limits_;
  std::vector<std::string> joints_;
  std::vector<Formula> objectives_;
  std::vector<std::string> objective_texts_;
  std::vector<Formula> constraints_;
  std::vector<std::string> constraint_texts_;
  std::vector<Kept> kept_;
};

/// How far a relation a <= b, a >= b or a == b is broken; of a guard, what is not known does not count.
double broken(const Formula& relation, std::span<const double> figures, bool guard = false);

/// How far a limit is broken: max(0, value - limit) / |limit| (of 0: over 1); `least` the other way round; 1 of what is not
/// known.
double broken(double value, double limit, bool least);

/// The columns of a journal: all figures of every run, and of those of one joint what the study names. Unknown joints are told
/// by Judge.
std::vector<FigureName> columns_of(const Study& study, const FigureOffer& offer, const std::vector<std::string>& joints);

}  // namespace gaitlab::studies
