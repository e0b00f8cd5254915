#include "studies/search/scbo.h"

#include <algorithm>
#include <cmath>

#include "core/math/random.h"
#include "studies/search/fitness.h"
#include "studies/search/point_models.h"

namespace gaitlab::studies {

namespace {

constexpr std::uint64_t kCandidates = 600;
constexpr double kMoved = 0.4;  // probability that a coordinate of a candidate differs from the centre's
constexpr double kFirstSide = 0.8, kLargest = 1.2, kSmallest = 0.02, kAgain = 0.6;
constexpr double kGrow = 1.6, kShrink = 1.7;
constexpr int kSuccesses = 2, kFailures = 3;
constexpr double kGain = 0.003;

enum class ScboDraw : std::uint64_t { which = 201, where, objective, violation };

class Scbo final : public Evolution {
 public:
  explicit Scbo(const EvolutionSettings& s)
      : rated_(*s.rated), since_(s.since), seed_(s.seed), population_(s.points.size()), best_(best().rating.fitness[0]) {}

  std::vector<Vector> ask() override {
    if (!have_models(rated_)) return candidates(population_);
    const Vector& centre = best().point;
    const PointModels models(rated_, centre);
    const std::vector<Vector> among = candidates(kCandidates);
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

  /// Points in the trust region that differ from its centre in at least one coordinate.
  [[nodiscard]] std::vector<Vector> candidates(std::uint64_t count) const {
    const Vector& centre = best().point;
    const std::uint64_t d = centre.size();
    std::vector<Vector> all(count, centre);
    for (std::uint64_t k = 0; k < count; ++k) {
      const auto sure = static_cast<std::uint64_t>(math::uniform({stream(ScboDraw::which), k, d}) * static_cast<double>(d));
      for (std::uint64_t c = 0; c < d; ++c) {
        if (c != sure && math::uniform({stream(ScboDraw::which), k, c}) >= kMoved) continue;
        const double low = std::max(0.0, centre[c] - side_ / 2);
        const double high = std::min(1.0, centre[c] + side_ / 2);
        all[k][c] = low + math::uniform({stream(ScboDraw::where), k, c}) * (high - low);
      }
    }
    return all;
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
