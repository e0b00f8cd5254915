#include "studies/search/evolution.h"

#include <map>
#include <pagmo/algorithm.hpp>
#include <pagmo/algorithms/cmaes.hpp>
#include <pagmo/algorithms/nsga2.hpp>
#include <pagmo/algorithms/pso_gen.hpp>
#include <pagmo/algorithms/sade.hpp>
#include <pagmo/algorithms/xnes.hpp>
#include <pagmo/config.hpp>
#include <pagmo/population.hpp>
#include <pagmo/problem.hpp>

#include "core/errors.h"

namespace gaitlab::studies {

namespace {

struct Answers {
  std::map<Vector, Vector> known;
  std::vector<Vector> asked;  ///< requested points without a known value, in the order of request
};

/// Problem that takes its values from a table, which all copies of the problem share.
struct Recorded {
  std::shared_ptr<Answers> answers = std::make_shared<Answers>();
  Vector low{0}, high{1};
  std::size_t objectives = 1;

  [[nodiscard]] Vector fitness(const Vector& point) const {
    const auto [at, is_new] = answers->known.try_emplace(point, objectives, 0.0);
    if (is_new) answers->asked.push_back(point);
    return at->second;
  }
  [[nodiscard]] std::size_t get_nobj() const { return objectives; }
  [[nodiscard]] std::pair<Vector, Vector> get_bounds() const { return {low, high}; }
};

/// Algorithm that evolves one generation at a time and keeps its memory. The step sizes at which cmaes and xnes end are set to
/// 0, because otherwise these algorithms end immediately on a flat population, as when all points are refused. Bounds are not
/// forced, because the box is mirrored instead.
pagmo::algorithm made(const EvolutionSettings& s) {
  constexpr double kOwn = -1;  // selects the algorithm's default
  switch (s.algorithm) {
    case Method::xnes:
      return pagmo::algorithm(pagmo::xnes(1, kOwn, kOwn, kOwn, s.sigma, 0, 0, true, false, s.seed));
    case Method::sade:
      return pagmo::algorithm(pagmo::sade(1, 2, 1, 0, 0, true, s.seed));
    case Method::pso:
      return pagmo::algorithm(pagmo::pso_gen(1, 0.7298, 2.05, 2.05, 0.5, 5, 2, 4, true, s.seed));
    case Method::nsga2:
      return pagmo::algorithm(pagmo::nsga2(1, 0.95, 10, 1 / static_cast<double>(s.low.size()), 50, s.seed));
    case Method::cma:
      return pagmo::algorithm(pagmo::cmaes(1, kOwn, kOwn, kOwn, kOwn, s.sigma, 0, 0, true, false, s.seed));
    default:
      throw std::logic_error("method without an algorithm of pagmo");
  }
}

class RecordedEvolution final : public PagmoEvolution {
 public:
  explicit RecordedEvolution(const EvolutionSettings& s) : algorithm_(made(s)) {
    const std::size_t objectives = s.values.front().size();
    population_ = pagmo::population(pagmo::problem(Recorded{answers_, s.low, s.high, objectives}), 0, s.seed);
    for (std::size_t k = 0; k < s.points.size(); ++k) population_.push_back(s.points[k], s.values[k]);
  }

  std::vector<Vector> ask() override {
    answers_->known.clear();
    answers_->asked.clear();
    pagmo::algorithm copy = algorithm_;
    (void)copy.evolve(population_);
    asked_ = answers_->asked;
    return asked_;
  }

  void tell(const std::vector<Vector>& values) override {
    answers_->known.clear();
    answers_->asked.clear();
    for (std::size_t k = 0; k < asked_.size(); ++k) answers_->known[asked_[k]] = values[k];
    population_ = algorithm_.evolve(population_);
    if (!answers_->asked.empty()) throw RunError("a point of this generation depends on the result of another");
  }

  [[nodiscard]] std::vector<Vector> points() const override { return population_.get_x(); }
  [[nodiscard]] std::vector<Vector> values() const override { return population_.get_f(); }

 private:
  std::shared_ptr<Answers> answers_ = std::make_shared<Answers>();
  pagmo::algorithm algorithm_;
  pagmo::population population_;
  std::vector<Vector> asked_;
};

}  // namespace

std::unique_ptr<PagmoEvolution> pagmo_evolution(const EvolutionSettings& settings) {
  return std::make_unique<RecordedEvolution>(settings);
}

const char* evolution_library() { return "pagmo " PAGMO_VERSION; }

}  // namespace gaitlab::studies
