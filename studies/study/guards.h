// Guards: the checks of the verdict that a run of a study must keep.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "core/settings/node.h"
#include "studies/study/study.h"

namespace gaitlab::studies {

/// A check of the verdict. Its margin is the quantity `margin.ID` of every run: 0 or more where it is kept.
struct CheckOffer {
  std::string id, unit, definition;
  bool can_fail = false;  ///< false: it only warns
  bool limited = false;   ///< whether a guard may replace its limit, in `unit`
};

/// The value of the key `guards`: verdict, none, or checks by id. Old names become ids, with a note in the study.
void read_guards(const Node& node, Study& study, Problems& problems);

/// Names that guards had before they were checks, and that are read.
std::vector<std::string> old_guards();

/// `margin.stops`; `margin.stops[0.1]` against a limit of the study's own.
std::string margin_column(const Guard& guard);

/// A guard on a quantity, which is at least `least`; a quantity that is not known (of motors, where nothing drives the joints)
/// keeps it.
struct MarginGuard {
  std::string check, name;  ///< name: of the quantity
  std::size_t column = 0;
  double least = 0;
  bool of_verdict = false;  ///< one of those that the verdict's word stands for; false: the study names it
  [[nodiscard]] double broken(std::span<const double> quantities) const;
};

/// The guards of one study, by the columns of its journal.
class Guards {
 public:
  Guards() = default;
  /// `columns`: names. Unknown checks are problems at their places. `of_energy`: whether an objective is the electrical cost of
  /// transport, for which energy that gears create is guarded, too.
  Guards(const Study& study, const std::vector<std::string>& columns, std::span<const CheckOffer> checks, bool of_energy,
         Problems& problems);

  /// Sum over the guards of how far each margin is below what is asked for; 1 where the verdict is not `feasible` and no margin
  /// is below. 0: none is broken.
  [[nodiscard]] double violation(std::span<const double> quantities, const std::string& verdict) const;
  /// The guards that a run breaks; `why`: the sentence behind its verdict.
  [[nodiscard]] std::vector<std::string> broken(std::span<const double> quantities, const std::string& verdict,
                                                const std::string& why) const;
  /// Relations over columns, `margin.stops >= 0`; of a verdict of which the study asks some checks otherwise a sentence.
  [[nodiscard]] std::vector<std::string> texts() const;

 private:
  /// Whether the study's own limits of checks make up for an infeasible verdict: it fails by no other check.
  [[nodiscard]] bool made_up_for(std::span<const double> quantities, const std::string& verdict) const;

  bool verdict_ = false;
  std::vector<MarginGuard> all_;
  std::vector<MarginGuard> replaced_;  ///< checks of the verdict that the study asks otherwise: as the verdict has them
};

}  // namespace gaitlab::studies
