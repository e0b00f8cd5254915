// Points requested by another program, with numbers that are the same after every start.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "studies/plan/plan.h"

namespace gaitlab::studies {

/// Numbers points in the order of their first request. A program that is started again with the same requests finds their rows;
/// one with other requests finds the rows of points that were run before, and gets free numbers for the rest.
class Asked {
 public:
  /// Plan and journal must outlive it.
  Asked(Plan& plan, Journal& journal);
  /// Number of the point with these values, in the form of --set. Throws InputError if there are too many points.
  std::uint64_t point(std::vector<std::string> values);
  /// Runs with a smaller number belong to known points.
  [[nodiscard]] std::uint64_t end() const { return next_ * plan_.points().runs_of_point(); }

 private:
  struct Known {
    std::string name;
    std::uint64_t run = 0, rows = 0;  ///< one of its runs with a row, and their number
  };
  void pass_taken();

  Plan& plan_;
  Journal& journal_;
  std::map<std::uint64_t, Known> in_journal_;     ///< by number
  std::map<std::string, std::uint64_t> numbers_;  ///< by name: points with all rows, or with a number below next_
  std::uint64_t next_ = 0;
};

/// Largest number of runs in a study with requested points.
inline constexpr std::int64_t kMostAsked = 100'000'000;

}  // namespace gaitlab::studies
