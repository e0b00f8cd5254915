// One search for the best point of a box: evenly spread points, then generations, then restarts.
#pragma once
#include <memory>

#include "studies/search/evolution.h"

namespace gaitlab::studies {

struct SearchSettings {
  Method algorithm = Method::cma;
  std::size_t dimensions = 1, objectives = 1;
  std::size_t population = 0;  ///< 0 selects usual_population()
  std::size_t restarts = 3;
  double sigma = 0.25;
  std::uint64_t seed = 1, number = 0;  ///< seed of the study, and number of this search within the study
  std::vector<Vector> starts = {};     ///< points that take the first places of the first block
};

/// A search whose coordinates are shares of the box, mirrored at its faces, in multiples of 1e-9. A start evaluates
/// first_block() points: the given starts, then points of a Sobol sequence, shifted by a random vector from the seed. The best
/// of these points are the first population. The search has converged if all coordinates of a generation deviate by less than
/// 1e-4. It has also converged if the best value has not improved by a share of 1e-4 for 10 + 30 n / population generations.
/// If there are several objectives, this condition is that no new point has entered the front. A converged search restarts with
/// twice the population, further points of the sequence and another seed.
class Search {
 public:
  explicit Search(const SearchSettings& settings);

  /// The points of the next generation. Empty if the search has ended. Repeated calls return the same points until tell() is
  /// called.
  const std::vector<Vector>& ask();
  /// Sets the ratings of the points from ask().
  void tell(const std::vector<Rating>& ratings);

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
  std::uint64_t taken_ = 0;  ///< number of points used of the Sobol sequence
  std::uint64_t generation_ = 0, restart_ = 0;
  std::unique_ptr<Evolution> evolution_;  ///< null while the first block of points is being evaluated
  std::vector<Vector> raw_, asked_;       ///< points of the algorithm, before and after mirroring into the box
  std::unique_ptr<std::vector<Rated>> rated_ = std::make_unique<std::vector<Rated>>();  ///< all points so far
  std::size_t since_ = 0;      ///< number of points before the present restart
  std::vector<Vector> front_;  ///< objective values of the non-dominated points since the restart
  std::size_t idle_ = 0;       ///< generations since the last improvement
  bool ended_ = false;
};

/// True if a is at least as good as b in every objective, and better in at least one. A smaller value is better.
bool dominates(std::span<const double> a, std::span<const double> b);

}  // namespace gaitlab::studies
