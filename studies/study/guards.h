// Guards: the checks of the verdict that a run of a study must keep.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "core/settings/node.h"
#include "studies/study/study.h"

namespace gaitlab::studies {

/// A check of the verdict. Its margin is the quantity `margin.ID` of every run: 0 or more if it is kept.
struct CheckOffer {
  std::string id, unit, definition;
  bool can_fail = false;  ///< false: it only warns
  bool limited = false;   ///< whether a guard may replace its limit, in `unit`
};

/// Reads the value of the key `guards`: verdict, none, or checks by id. Old names become ids, with a note in the study.
void read_guards(const Node& node, Study& study, Problems& problems);

/// Old names of guards that are still accepted.
std::vector<std::string> old_guards();

/// `margin.stops`; `margin.stops[0.1]` with the study's limit instead of the check's.
std::string margin_column(const Guard& guard);

/// A guard on a quantity, which must be at least `least`; an unknown quantity (of motors, in a robot without motors) counts as
/// kept.
struct MarginGuard {
  std::string check, name;  ///< name: of the quantity
  std::size_t column = 0;
  double least = 0;
  bool of_verdict = false;  ///< a check of the verdict's word; false: named by the study
  [[nodiscard]] double broken(std::span<const double> quantities) const;
};

/// The guards of one study, by the columns of its journal.
class Guards {
 public:
  Guards() = default;
  /// `columns`: names. Unknown checks are problems at their places. `of_energy`: whether an objective is the electrical cost of
  /// transport, for which the energy that gears create is guarded also.
  Guards(const Study& study, const std::vector<std::string>& columns, std::span<const CheckOffer> checks, bool of_energy,
         Problems& problems);

  /// Sum over the guards of the shortfall of each margin; 1 if the verdict is not `feasible` and no margin falls short. 0: no
  /// guard is broken.
  [[nodiscard]] double violation(std::span<const double> quantities, const std::string& verdict) const;
  /// The guards that a run breaks; `why`: the sentence after its verdict.
  [[nodiscard]] std::vector<std::string> broken(std::span<const double> quantities, const std::string& verdict,
                                                const std::string& why) const;
  /// Relations over columns, `margin.stops >= 0`; for a verdict with checks that the study replaces, a sentence.
  [[nodiscard]] std::vector<std::string> texts() const;

 private:
  /// Whether an infeasible verdict fails only by checks whose limits the study replaces.
  [[nodiscard]] bool made_up_for(std::span<const double> quantities, const std::string& verdict) const;

  bool verdict_ = false;
  std::vector<MarginGuard> all_;
  std::vector<MarginGuard> replaced_;  ///< checks of the verdict that the study replaces, with the verdict's limits
};

}  // namespace gaitlab::studies
