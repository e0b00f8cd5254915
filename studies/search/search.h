// One search for the best point of a box: blocks of points spread evenly, then generations, then restarts.
#pragma once
#include <memory>

#include "studies/search/evolution.h"

namespace gaitlab::studies {

struct SearchSettings {
  Method algorithm = Method::cma;
  std::size_t dimensions = 1, objectives = 1;
  std::size_t population = 0;  ///< 0: usual_population
  std::size_t restarts = 3;
  double sigma = 0.25;
  std::uint64_t seed = 1, number = 0;  ///< of the study, and of this search within it
};

/// Coordinates are shares of the box, mirrored at its faces, multiples of 1e-9. A start begins with max(population, 5 (n + 1))
/// points of a Sobol sequence, shifted by a random vector from the seed; the best of them are the first population. It has
/// converged if all coordinates of a generation deviate by less than 1e-4, or if the best has not improved by 1e-4 of itself
/// (with several objectives: no new point in the front) for 10 + 30 n / population generations. Then the search starts again
/// with twice the population, further points of the sequence and another seed.
class Search {
 public:
  explicit Search(const SearchSettings& settings);

  /// The points of the next generation; none: the search has ended. Until tell() it returns the same points again.
  const std::vector<Vector>& ask();
  /// Sets the values of these points by objective: smaller is better, no NaN.
  void tell(const std::vector<Vector>& values);

  [[nodiscard]] std::uint64_t generation() const { return generation_; }
  [[nodiscard]] std::uint64_t restart() const { return restart_; }
  /// Largest deviation of a coordinate among the requested points.
  [[nodiscard]] double spread() const;

 private:
  [[nodiscard]] std::size_t population() const { return population_ << restart_; }
  [[nodiscard]] std::size_t block() const;
  void begin();
  void start(const std::vector<Vector>& values);
  [[nodiscard]] bool improved(const std::vector<Vector>& values);
  [[nodiscard]] bool converged(const std::vector<Vector>& values);

  SearchSettings settings_;
  std::size_t population_;
  Vector shift_;
  std::uint64_t taken_ = 0;  ///< points used of the sequence
  std::uint64_t generation_ = 0, restart_ = 0;
  std::unique_ptr<Evolution> evolution_;  ///< nullptr: the first block is being evaluated
  std::vector<Vector> raw_, asked_;       ///< points of the algorithm, unmirrored and within the box
  std::vector<Vector> front_;             ///< values of this start that no other dominates
  std::size_t idle_ = 0;                  ///< generations since the last improvement
  bool ended_ = false;
};

/// Whether a is at least as good as b in everything, and better in something; smaller is better.
bool dominates(std::span<const double> a, std::span<const double> b);

}  // namespace gaitlab::studies
