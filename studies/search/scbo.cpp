#include "studies/search/scbo.h"

#include <algorithm>
#include <cmath>

#include "core/math/random.h"
#include "studies/search/box.h"
#include "studies/search/fitness.h"
#include "studies/search/point_models.h"

namespace gaitlab::studies {

namespace {

constexpr std::uint64_t kCandidates = 400;
constexpr double kMoved = 0.4;   // probability that a coordinate of a candidate differs from the centre's
constexpr double kOfBest = 0.7;  // share of the candidates that are made from the best points
constexpr std::size_t kBest = 16;
constexpr double kMostSteps = 1.5;  // largest multiple of the difference of two points
constexpr double kSpread = 0.02;    // largest random change of a coordinate
constexpr double kFirstSide = 0.8, kLargest = 1.2, kSmallest = 0.02, kAgain = 0.6;
constexpr double kGrow = 1.6, kShrink = 1.7;
constexpr int kSuccesses = 2, kFailures = 2;
constexpr double kGain = 0.003;

enum class ScboDraw : std::uint64_t { which = 201, where, objective, violation, kind, best, steps };

class Scbo final : public Evolution {
 public:
  explicit Scbo(const EvolutionSettings& s)
      : rated_(*s.rated), since_(s.since), seed_(s.seed), population_(s.points.size()), best_(best().rating.fitness[0]) {}

  std::vector<Vector> ask() override {
    if (!have_models(rated_)) return candidates(population_);
    const Vector& centre = best().point;
    const PointModels models(rated_, centre);
    const std::vector<Vector> among = candidates(std::max<std::uint64_t>(kCandidates, 2 * population_));
    const Eigen::MatrixXd at = matrix_of(among);
    const Eigen::MatrixXd objective = models.objective().samples(at, population_, stream(ScboDraw::objective));
    const Eigen::MatrixXd violation = models.violation().samples(at, population_, stream(ScboDraw::violation));
    std::vector<Vector> chosen;
    std::vector<bool> taken(among.size());
    for (std::size_t k = 0; k < population_; ++k) {
      const auto draw = static_cast<Eigen::Index>(k);
      for (const std::size_t c : PointModels::order(objective.col(draw), violation.col(draw))) {
        if (taken[c]) continue;
        taken[c] = true;
        chosen.push_back(among[c]);
        break;
      }
    }
    return chosen;
  }

  void tell(const std::vector<Vector>&) override {
    const double now = best().rating.fitness[0];
    const bool gained = fitness_gain(best_, now) > kGain;
    best_ = now;
    ++generation_;
    successes_ = gained ? successes_ + 1 : 0;
    failures_ = gained ? 0 : failures_ + 1;
    if (successes_ == kSuccesses) {
      side_ = std::min(kLargest, side_ * kGrow);
      successes_ = 0;
    } else if (failures_ == kFailures) {
      side_ /= kShrink;
      failures_ = 0;
    }
    if (side_ < kSmallest) side_ = kAgain;
  }

 private:
  [[nodiscard]] const Rated& best() const {
    return *std::ranges::min_element(rated_.begin() + static_cast<std::ptrdiff_t>(since_), rated_.end(), {},
                                     [](const Rated& one) { return one.rating.fitness[0]; });
  }

  [[nodiscard]] std::uint64_t stream(ScboDraw draw) const {
    return math::hash64({static_cast<std::uint64_t>(draw), seed_, generation_});
  }

  [[nodiscard]] double uniform(ScboDraw draw, std::uint64_t candidate, std::uint64_t number = 0) const {
    return math::uniform({static_cast<std::uint64_t>(draw), seed_, generation_, candidate, number});
  }

  /// Points of both kinds, in random order.
  [[nodiscard]] std::vector<Vector> candidates(std::uint64_t count) const {
    const std::vector<const Rated*> elite = best_points();
    std::vector<Vector> all;
    for (std::uint64_t k = 0; k < count; ++k)
      all.push_back(uniform(ScboDraw::kind, k) < kOfBest ? of_best(elite, k) : in_region(elite.front()->point, k));
    return all;
  }

  /// The best points since the restart, best first.
  [[nodiscard]] std::vector<const Rated*> best_points() const {
    std::vector<const Rated*> all;
    for (std::size_t k = since_; k < rated_.size(); ++k) all.push_back(&rated_[k]);
    std::ranges::stable_sort(all, {}, [](const Rated* one) { return one->rating.fitness[0]; });
    all.resize(std::min(all.size(), kBest));
    return all;
  }

  /// One of the best points, moved by a multiple of the difference of two others, and a little at random.
  [[nodiscard]] Vector of_best(const std::vector<const Rated*>& elite, std::uint64_t k) const {
    const auto pick = [&](std::uint64_t which) -> const Vector& {
      return elite[static_cast<std::size_t>(uniform(ScboDraw::best, k, which) * static_cast<double>(elite.size()))]->point;
    };
    const double steps = kMostSteps * uniform(ScboDraw::steps, k);
    Vector point = pick(0);
    for (std::size_t c = 0; c < point.size(); ++c) {
      const double by = steps * (pick(1)[c] - pick(2)[c]) + kSpread * (2 * uniform(ScboDraw::where, k, c) - 1);
      point[c] += by;
    }
    return within_box(std::move(point));  // mirrored, because clamped points would be equal
  }

  /// A point in the trust region that differs from its centre in at least one coordinate.
  [[nodiscard]] Vector in_region(Vector point, std::uint64_t k) const {
    const std::size_t d = point.size();
    const auto sure = static_cast<std::size_t>(uniform(ScboDraw::which, k, d) * static_cast<double>(d));
    for (std::size_t c = 0; c < d; ++c) {
      if (c != sure && uniform(ScboDraw::which, k, c) >= kMoved) continue;
      const double low = std::max(0.0, point[c] - side_ / 2);
      const double high = std::min(1.0, point[c] + side_ / 2);
      point[c] = low + uniform(ScboDraw::where, k, c) * (high - low);
    }
    return point;
  }

  const std::vector<Rated>& rated_;
  std::size_t since_;
  std::uint64_t seed_, generation_ = 0;
  std::size_t population_;
  double best_;  ///< fitness
  double side_ = kFirstSide;
  int successes_ = 0, failures_ = 0;
};

}  // namespace

std::unique_ptr<Evolution> scbo(const EvolutionSettings& settings) { return std::make_unique<Scbo>(settings); }

}  // namespace gaitlab::studies
