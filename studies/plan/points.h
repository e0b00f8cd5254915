// The points of a study by number, independent of earlier runs.
#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "studies/study/study.h"

namespace gaitlab::studies {

/// Points and runs by number. Runs are numbered from 0. The runs of a point are consecutive: its replicates in the first
/// scenario, then those in the next scenario.
class Points {
 public:
  explicit Points(const Study& study) : study_(study) {}

  [[nodiscard]] std::uint64_t points() const;
  [[nodiscard]] std::uint64_t replicates() const { return study_.replicates.number(); }
  [[nodiscard]] std::uint64_t runs_of_point() const { return study_.runs_of_point(); }
  [[nodiscard]] std::uint64_t runs() const { return points() * runs_of_point(); }
  [[nodiscard]] std::uint64_t point(std::uint64_t run) const { return run / runs_of_point(); }
  [[nodiscard]] std::size_t scenario(std::uint64_t run) const { return run % runs_of_point() / replicates(); }
  [[nodiscard]] std::uint64_t replicate(std::uint64_t run) const { return run % replicates(); }

  /// Adds the next point of a method that chooses points by earlier results.
  void add(std::vector<std::string> values) { chosen_.push_back(std::move(values)); }

  /// Value of each parameter in the form of --set. The last parameter of a grid changes fastest.
  [[nodiscard]] std::vector<std::string> values(std::uint64_t point) const;
  /// Draw of each variation in the form of --set. `nominal` contains the point's number for each key.
  [[nodiscard]] std::vector<std::string> drawn(std::uint64_t replicate, const std::map<std::string, double>& nominal) const;
  /// Seed for the random numbers of the scenario in this replicate, 53 bits.
  [[nodiscard]] std::int64_t seed(std::uint64_t replicate) const;

 private:
  const Study& study_;
  std::vector<std::vector<std::string>> chosen_;
};

/// Value of a parameter at a share of its range: 0 is low, 1 is high. It is rounded to 12 digits, so that a grid of tenths is
/// exact.
double between(const Parameter& parameter, double share);
/// Share of a parameter's range at a value within it.
double share_at(const Parameter& parameter, double value);

}  // namespace gaitlab::studies
