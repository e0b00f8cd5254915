// A judged run in the search of a remedy.
#pragma once
#include <string>

#include "core/recording/recording.h"
#include "core/scenario/scenario.h"
#include "report/verdict/verdict.h"

namespace gaitlab::report {

/// Verdict on the gait with some settings multiplied by factors.
struct RemedyRun {
  Word word = Word::failed;
  double margin = 0;         ///< least margin; NaN if not known
  double speed = 0;          ///< m/s; NaN if not known
  std::string weakest = {};  ///< the deciding check and its part: `voltage of m6/active`; the reason of `not judged`
  bool still = false;        ///< true if the robot hardly moves (check `progress`)
  bool simulated = false;    ///< false if no run was made
  std::string refused = {};  ///< message of the reader, if the scenario cannot have these settings
  /// False for a run that a stopped search has not made.
  [[nodiscard]] bool known() const { return simulated || !refused.empty(); }
  [[nodiscard]] bool feasible() const { return simulated && word == Word::feasible; }
};

RemedyRun judged(const Scenario& scenario, const Recording& recording);

/// The run of a scenario that cannot be read with its settings.
RemedyRun refused_run(const std::vector<Problem>& problems);

}  // namespace gaitlab::report
