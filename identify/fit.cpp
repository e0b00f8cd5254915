#include "identify/fit.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gaitlab::identify {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kGain = 1e-3;     // part of the cost; chosen: differences of runs are rough below it
constexpr int kSmall = 2;          // steps in a row that gain less; chosen: a rough step may be followed by a good one
constexpr int kMostRounds = 40;    // chosen; drawn benches need 5 to 15
constexpr double kDamping = 1e-3;  // More's usual start
constexpr double kLeastDamping = 1e-4,
                 kMostDamping = 1e2;         // chosen: below a step is Newton's, above it moves a hundredth of it
constexpr double kEasier = 5, kHarder = 20;  // chosen

double mean_cost(std::span<const ErrorModel> models) {
  double sum = 0;
  for (const ErrorModel& model : models) {
    if (!model.whole) return std::numeric_limits<double>::infinity();
    sum += model.cost;
  }
  return sum / static_cast<double>(models.size());
}

/// A fit in progress.
struct Descent {
  Fit& fit;
  double damping = kDamping;
  bool ended = false;
  int small = 0;  ///< accepted steps in a row that gained little

  /// The point to try next.
  [[nodiscard]] Point trial(const ErrorModels& of) const {
    Point point = fit.at;
    if (fit.models.empty()) return point;
    const VectorXd d = model_step(fit, fit.models, of, damping);
    for (std::size_t k = 0; k < point.keys.size(); ++k) {
      const Key& key = of.keys()[point.keys[k]];
      double& value = point.values[static_cast<Index>(k)];
      value = std::clamp(value + d[static_cast<Index>(k)] * of.scale(point.keys[k]), key.low, key.high);
    }
    return point;
  }

  void take(Point point, std::vector<ErrorModel> models) {
    const bool first = fit.models.empty();
    const double cost = mean_cost(models);
    ++fit.rounds;
    if (first && !std::isfinite(cost)) {
      fit.cost = std::numeric_limits<double>::infinity();
      ended = true;
      return;
    }
    if (first || cost < fit.cost) {
      const bool gains = first || fit.cost - cost >= kGain * fit.cost;
      fit.at = std::move(point);
      fit.models = std::move(models);
      fit.cost = cost;
      damping = std::max(damping / kEasier, kLeastDamping);
      small = gains ? 0 : small + 1;
    } else {
      damping *= kHarder;
    }
    ended = small >= kSmall || damping > kMostDamping || fit.rounds >= kMostRounds || fit.cost == 0;
  }
};

}  // namespace

bool at_bound(const Key& key, double value) { return value <= key.low || value >= key.high; }

VectorXd model_step(const Fit& fit, std::span<const ErrorModel> models, const ErrorModels& of, double damping) {
  const auto size = static_cast<Index>(fit.at.keys.size());
  VectorXd gradient = VectorXd::Zero(size);
  MatrixXd curvature = MatrixXd::Zero(size, size);
  for (const ErrorModel& model : models) {
    gradient += model.gradient;
    curvature += model.curvature;
  }
  const double least = 1e-12 * (curvature.trace() + std::numeric_limits<double>::min());  // a key without any effect
  for (Index k = 0; k < size; ++k) {
    const Key& key = of.keys()[fit.at.keys[static_cast<std::size_t>(k)]];
    const double value = fit.at.values[k];
    if ((value <= key.low && gradient[k] > 0) || (value >= key.high && gradient[k] < 0)) {
      curvature.row(k).setZero();
      curvature.col(k).setZero();
      curvature(k, k) = 1;
      gradient[k] = 0;
    }
    curvature(k, k) = std::max(curvature(k, k), least) * (1 + damping);
  }
  return curvature.ldlt().solve(-gradient);
}

void solve(std::span<Fit> fits, ErrorModels& models) {
  std::vector<Descent> descents;
  for (Fit& fit : fits) descents.push_back({fit});
  for (;;) {
    std::vector<Question> questions;
    std::vector<Point> trials;
    std::vector<Descent*> open;
    for (Descent& descent : descents) {
      if (descent.ended) continue;
      open.push_back(&descent);
      trials.push_back(descent.trial(models));
      for (const std::size_t log : descent.fit.logs) questions.push_back({log, trials.back()});
    }
    if (open.empty()) return;
    const std::vector<ErrorModel> answers = models(questions);
    auto from = answers.begin();
    for (std::size_t i = 0; i < open.size(); ++i) {
      const auto to = from + static_cast<std::ptrdiff_t>(open[i]->fit.logs.size());
      open[i]->take(std::move(trials[i]), {from, to});
      from = to;
    }
  }
}

}  // namespace gaitlab::identify
