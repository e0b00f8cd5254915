// Numbering of points that another program requests; a restart of that program does not change the numbers.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "studies/plan/plan.h"

namespace gaitlab::studies {

/// Numbers points in the order of their first request. If a program repeats its requests after a restart, it finds their rows.
/// If the requests differ, it finds the rows of points that ran before; the other points get unused numbers.
class Asked {
 public:
  /// Plan and journal must outlive this object.
  Asked(Plan& plan, Journal& journal);
  /// Number of the point with these values, in the form of --set. Throws InputError if there are too many points.
  std::uint64_t point(std::vector<std::string> values);
  /// End of the run numbers that belong to known points.
  [[nodiscard]] std::uint64_t end() const { return next_ * plan_.points().runs_of_point(); }

 private:
  struct Known {
    std::string name;
    std::uint64_t run = 0, rows = 0;  ///< number of a run of this point with a row, and number of all such runs
  };
  void pass_taken();

  Plan& plan_;
  Journal& journal_;
  std::map<std::uint64_t, Known> in_journal_;  ///< points of the journal by number
  /// Numbers of points by name, for points with all rows or with a number below next_.
  std::map<std::string, std::uint64_t> numbers_;
  std::uint64_t next_ = 0;
};

/// Largest number of runs in a study whose points another program requests.
inline constexpr std::int64_t kMostAsked = 100'000'000;

}  // namespace gaitlab::studies
