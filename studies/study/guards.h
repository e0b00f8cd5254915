// Guards: the checks of the verdict that a run of a study must pass.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "core/recording/word.h"
#include "core/settings/node.h"
#include "studies/study/study.h"

namespace gaitlab::studies {

/// A check of the verdict. Its margin is the quantity `margin.ID` of every run; 0 or more means that the check passes.
struct CheckOffer {
  std::string id, unit, definition;
  bool can_fail = false;  ///< false if the check can only warn
  bool limited = false;   ///< true if a guard may replace the limit of the check by another one, in `unit`
};

/// Reads the value of the key `guards`: `verdict`, `none`, or checks by id.
void read_guards(const Node& node, Study& study, Problems& problems);

/// Column with the margin of a guard: `margin.stops`, or `margin.stops[0.1]` if the study replaces the limit of the check by
/// 0.1.
std::string margin_column(const Guard& guard);

/// Share v / (1 + v) of a relative violation v: a violation far beyond its limit counts at most 1, so that it does not hide the
/// others.
constexpr double limited_violation(double v) { return v < 1e12 ? v / (1 + v) : 1; }

/// A guard on a quantity, which must be at least `least`. An unknown quantity satisfies the guard, such as a motor's margin in
/// a robot without motors.
struct MarginGuard {
  std::string check, name;  ///< id of the check, and name of the quantity with its margin
  std::size_t column = 0;
  double least = 0;
  bool of_verdict = false;  ///< true for a check that decides the verdict; false for a check that the study names
  [[nodiscard]] double broken(std::span<const double> quantities, bool reserve = true) const;
};

/// The guards of one study, with the columns of its journal.
class Guards {
 public:
  Guards() = default;
  /// Selects the guards. `columns` are names. Unknown checks are problems at their places. `of_energy` is true if an objective
  /// is the electrical cost of transport; the energy that gears create is then guarded as well.
  Guards(const Study& study, const std::vector<std::string>& columns, std::span<const CheckOffer> checks, bool of_energy,
         Problems& problems);

  /// Sum over the guards of limited_violation() of the amount by which each margin is too small. It is 0.5 if the verdict is
  /// not `feasible` although no margin is too small, and 0 if all guards are satisfied. Without `reserve`, a margin of 0
  /// suffices if the study requires more, because the reserve may be used up.
  [[nodiscard]] double violation(std::span<const double> quantities, Word verdict, bool reserve = true) const;
  /// Texts of the guards that a run violates. `why` is the sentence after the run's verdict.
  [[nodiscard]] std::vector<std::string> broken(std::span<const double> quantities, Word verdict, const std::string& why,
                                                bool reserve = true) const;
  /// Relations over columns, as in `margin.stops >= 0`. The text is a sentence if the verdict has checks that the study
  /// replaces.
  [[nodiscard]] std::vector<std::string> texts() const;
  /// All guards on margins.
  [[nodiscard]] const std::vector<MarginGuard>& margins() const { return all_; }

 private:
  /// True if the verdict is infeasible only because of checks that the study replaces.
  [[nodiscard]] bool made_up_for(std::span<const double> quantities, Word verdict) const;

  bool verdict_ = false;
  std::vector<MarginGuard> all_;
  std::vector<MarginGuard> replaced_;  ///< checks of the verdict that the study replaces, with their original limits
};

}  // namespace gaitlab::studies
