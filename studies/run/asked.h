// Points that another program asks for: a number for each, the same after every start.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "studies/plan/plan.h"

namespace gaitlab::studies {

/// Points are numbered in the order of the first question for each. A program that is started again and asks the same questions
/// so finds their rows; one that asks others finds the rows of points that were run before, and gets the numbers that are free.
class Asked {
 public:
  /// Plan and journal must outlive it.
  Asked(Plan& plan, Journal& journal);
  /// The number of the point with these values, as for --set. InputError: there are too many points.
  std::uint64_t point(std::vector<std::string> values);
  /// Runs with a smaller number belong to points that are known.
  [[nodiscard]] std::uint64_t end() const { return next_ * plan_.points().runs_of_point(); }

 private:
  struct Known {
    std::string name;
    std::uint64_t run = 0, rows = 0;  ///< one of its runs that have a row, and how many have
  };
  void pass_taken();

  Plan& plan_;
  Journal& journal_;
  std::map<std::uint64_t, Known> in_journal_;     ///< by number
  std::map<std::string, std::uint64_t> numbers_;  ///< by name: all rows are there, or the number is below next_
  std::uint64_t next_ = 0;
};

/// A study that is asked has at most so many runs.
inline constexpr std::int64_t kMostAsked = 100'000'000;

}  // namespace gaitlab::studies
