#include "studies/search/cma_gp.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/math/functions.h"
#include "core/math/random.h"
#include "studies/search/box.h"
#include "studies/search/point_models.h"

namespace gaitlab::studies {

namespace {

constexpr std::size_t kOffspring = 6;     // offspring per point of a generation
constexpr std::size_t kFewestRated = 30;  // least number of rated points for a preselection
constexpr double kMostSigma = 0.5;        // share of the box

enum class CmaDraw : std::uint64_t { offspring = 211, rest };

/// Weights and rates of Hansen (2016), table 1, for n coordinates and a generation of `points`.
struct Rates {
  Eigen::VectorXd weights;
  double effective, c_c, c_sigma, c_1, c_mu, damping, expected;

  Rates(double n, std::size_t points) : weights(static_cast<Eigen::Index>(points / 2)) {
    const double half = 0.5 * (static_cast<double>(points) + 1);
    for (Eigen::Index k = 0; k < weights.size(); ++k) weights[k] = math::log(half) - math::log(static_cast<double>(k + 1));
    weights /= weights.sum();
    effective = 1 / weights.squaredNorm();
    c_c = (4 + effective / n) / (n + 4 + 2 * effective / n);
    c_sigma = (effective + 2) / (n + effective + 5);
    c_1 = 2 / ((n + 1.3) * (n + 1.3) + effective);
    c_mu = std::min(1 - c_1, 2 * (effective - 2 + 1 / effective) / ((n + 2) * (n + 2) + effective));
    damping = 1 + 2 * std::max(0.0, std::sqrt((effective - 1) / (n + 1)) - 1) + c_sigma;
    expected = std::sqrt(n) * (1 - 1 / (4 * n) + 1 / (21 * n * n));  // expected length of a normal vector
  }
};

class CmaGp final : public Evolution {
 public:
  explicit CmaGp(const EvolutionSettings& s)
      : rated_(*s.rated),
        seed_(s.seed),
        population_(s.points.size()),
        n_(static_cast<Eigen::Index>(s.low.size())),
        rates_(static_cast<double>(n_), population_),
        mean_(Eigen::Map<const Eigen::VectorXd>(s.points.front().data(), n_)),
        covariance_(Eigen::MatrixXd::Identity(n_, n_)),
        path_(Eigen::VectorXd::Zero(n_)),
        sigma_path_(Eigen::VectorXd::Zero(n_)),
        sigma_(s.sigma) {
    decompose();
  }

  std::vector<Vector> ask() override {
    const std::size_t count = rated_.size() < kFewestRated || !have_models(rated_) ? population_ : kOffspring * population_;
    std::vector<Vector> drawn;
    for (std::size_t k = 0; k < count; ++k) drawn.push_back(offspring(k));
    asked_ = count == population_ ? drawn : preselected(drawn);
    return asked_;
  }

  void tell(const std::vector<Vector>& values) override {
    std::vector<std::size_t> order(values.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {}, [&](std::size_t k) { return values[k][0]; });
    const Eigen::MatrixXd steps = (matrix_of(asked_).rowwise() - mean_.transpose()) / sigma_;
    Eigen::MatrixXd best(rates_.weights.size(), n_);
    for (Eigen::Index k = 0; k < best.rows(); ++k)
      best.row(k) = steps.row(static_cast<Eigen::Index>(order[static_cast<std::size_t>(k)]));
    move(best);
    ++generation_;
    decompose();
  }

 private:
  [[nodiscard]] std::uint64_t stream(CmaDraw draw) const {
    return math::hash64({static_cast<std::uint64_t>(draw), seed_, generation_});
  }

  [[nodiscard]] Vector offspring(std::uint64_t number) const {
    Eigen::VectorXd normal(n_);
    for (Eigen::Index c = 0; c < n_; ++c)
      normal[c] = math::normal({stream(CmaDraw::offspring), number, static_cast<std::uint64_t>(c)});
    const Eigen::VectorXd point = mean_ + sigma_ * (axes_ * lengths_.cwiseProduct(normal));
    return {point.begin(), point.end()};
  }

  /// The generation, chosen from `drawn`.
  [[nodiscard]] std::vector<Vector> preselected(const std::vector<Vector>& drawn) const {
    std::vector<Vector> inside;
    for (const Vector& point : drawn) inside.push_back(within_box(point));
    const Vector centre = within_box({mean_.begin(), mean_.end()});
    const PointModels models(rated_, centre);
    const Eigen::MatrixXd at = matrix_of(inside);
    std::vector<std::size_t> order = PointModels::order(models.objective().mean(at), models.violation().mean(at));
    const std::size_t best = population_ - population_ / 4;
    for (std::size_t k = best; k < population_; ++k) {  // Fisher and Yates
      const double among = static_cast<double>(order.size() - k);
      std::swap(order[k], order[k + static_cast<std::size_t>(math::uniform({stream(CmaDraw::rest), k}) * among)]);
    }
    std::vector<Vector> chosen;
    for (std::size_t k = 0; k < population_; ++k) chosen.push_back(drawn[order[k]]);
    return chosen;
  }

  /// Updates mean, covariance and step size from the steps of the best points, in multiples of the step size.
  void move(const Eigen::MatrixXd& best) {
    const Rates& r = rates_;
    const Eigen::VectorXd step = best.transpose() * r.weights;
    mean_ += sigma_ * step;
    const Eigen::VectorXd white = axes_ * (axes_.transpose() * step).cwiseQuotient(lengths_);
    sigma_path_ = (1 - r.c_sigma) * sigma_path_ + std::sqrt(r.c_sigma * (2 - r.c_sigma) * r.effective) * white;
    const auto n = static_cast<double>(n_);
    const double since = 1 - math::pow(1 - r.c_sigma, 2 * static_cast<double>(generation_ + 1));
    const bool grows = sigma_path_.norm() / std::sqrt(since) < (1.4 + 2 / (n + 1)) * r.expected;
    path_ = (1 - r.c_c) * path_ + (grows ? std::sqrt(r.c_c * (2 - r.c_c) * r.effective) : 0.0) * step;
    const double stalled = grows ? 0 : r.c_c * (2 - r.c_c);
    covariance_ = (1 - r.c_1 - r.c_mu + r.c_1 * stalled) * covariance_ + r.c_1 * path_ * path_.transpose() +
                  r.c_mu * best.transpose() * r.weights.asDiagonal() * best;
    sigma_ = std::min(kMostSigma, sigma_ * math::exp(r.c_sigma / r.damping * (sigma_path_.norm() / r.expected - 1)));
  }

  void decompose() {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(covariance_);
    axes_ = solver.eigenvectors();
    lengths_ = solver.eigenvalues().cwiseMax(1e-20).cwiseSqrt();
  }

  const std::vector<Rated>& rated_;
  std::uint64_t seed_, generation_ = 0;
  std::size_t population_;
  Eigen::Index n_;
  Rates rates_;
  Eigen::VectorXd mean_;
  Eigen::MatrixXd covariance_;
  Eigen::VectorXd path_, sigma_path_;
  double sigma_;
  Eigen::MatrixXd axes_;     ///< unit vectors of the covariance's axes, as columns
  Eigen::VectorXd lengths_;  ///< deviation along each axis
  std::vector<Vector> asked_;
};

}  // namespace

std::unique_ptr<Evolution> cma_gp(const EvolutionSettings& settings) { return std::make_unique<CmaGp>(settings); }

}  // namespace gaitlab::studies
