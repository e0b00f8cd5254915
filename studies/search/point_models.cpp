#include "studies/search/point_models.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/math/functions.h"

namespace gaitlab::studies {

namespace {

constexpr std::size_t kMostPoints = 200;
constexpr double kAllBroken = 10;    // violation of a failed point
constexpr double kSmall = 0.01;      // added to a violation before its logarithm is taken
constexpr double kAcceptable = 1.7;  // kSmall + violation up to this multiple of kSmall counts as no violation

double log_violation(double violation) {
  return math::log(kSmall + (std::isnan(violation) ? kAllBroken : std::min(violation, kAllBroken)));
}

double distance(const Vector& a, const Vector& b) {
  double most = 0;
  for (std::size_t c = 0; c < a.size(); ++c) most = std::max(most, std::abs(a[c] - b[c]));
  return most;
}

std::vector<const Rated*> nearest(std::span<const Rated> points, const Vector& centre) {
  std::vector<const Rated*> all;
  for (const Rated& one : points) all.push_back(&one);
  std::ranges::stable_sort(all, {}, [&](const Rated* one) { return distance(one->point, centre); });
  all.resize(std::min(all.size(), kMostPoints));
  return all;
}

/// Objectives clipped to the range from best - d to median + 2 d, with d = median - best. Smaller is better; `best` is the best
/// kept objective or the limit of the best tenth, whichever is smaller.
Eigen::VectorXd clipped_objectives(const std::vector<const Rated*>& points) {
  std::vector<double> sorted;
  double best = std::numeric_limits<double>::infinity();
  for (const Rated* one : points) {
    sorted.push_back(one->rating.objective);
    if (one->rating.kept()) best = std::min(best, one->rating.objective);
  }
  std::ranges::sort(sorted);
  const double median = sorted[sorted.size() / 2];
  best = std::min(best, sorted[sorted.size() / 10]);
  const double reach = median - best;
  Eigen::VectorXd values(static_cast<Eigen::Index>(points.size()));
  for (Eigen::Index k = 0; k < values.size(); ++k) {
    const double value = points[static_cast<std::size_t>(k)]->rating.objective;
    values[k] = reach > 0 ? std::clamp(value, best - reach, median + 2 * reach) : value;
  }
  return values;
}

Eigen::MatrixXd rows_of(const std::vector<const Rated*>& points) {
  std::vector<Vector> rows;
  for (const Rated* one : points) rows.push_back(one->point);
  return matrix_of(rows);
}

}  // namespace

Eigen::MatrixXd matrix_of(std::span<const Vector> points) {
  Eigen::MatrixXd rows(static_cast<Eigen::Index>(points.size()), static_cast<Eigen::Index>(points.front().size()));
  for (std::size_t k = 0; k < points.size(); ++k)
    rows.row(static_cast<Eigen::Index>(k)) = Eigen::Map<const Eigen::VectorXd>(points[k].data(), rows.cols()).transpose();
  return rows;
}

bool have_models(std::span<const Rated> points) {
  return std::ranges::count_if(points, [](const Rated& one) { return std::isfinite(one.rating.objective); }) > 1;
}

struct PointModels::Data {
  Eigen::MatrixXd known, all;  ///< points with a known objective, and all points
  Eigen::VectorXd objective, violation;

  Data(std::span<const Rated> points, const Vector& centre) {
    const std::vector<const Rated*> near = nearest(points, centre);
    all = rows_of(near);
    violation.resize(all.rows());
    for (Eigen::Index k = 0; k < all.rows(); ++k)
      violation[k] = log_violation(near[static_cast<std::size_t>(k)]->rating.violation);
    std::vector<const Rated*> with;
    std::ranges::copy_if(near, std::back_inserter(with), [](const Rated* one) { return std::isfinite(one->rating.objective); });
    if (with.empty()) {  // all of the nearest points have failed
      for (const Rated& one : points) {
        if (std::isfinite(one.rating.objective) && with.size() < kMostPoints) with.push_back(&one);
      }
    }
    known = rows_of(with);
    objective = clipped_objectives(with);
  }
};

PointModels::PointModels(std::span<const Rated> points, const Vector& centre) : PointModels(Data(points, centre)) {}

PointModels::PointModels(const Data& data) : objective_(data.known, data.objective), violation_(data.all, data.violation) {}

std::vector<std::size_t> PointModels::order(const Eigen::VectorXd& objective, const Eigen::VectorXd& violation) {
  const double acceptable = math::log(kSmall * kAcceptable);
  std::vector<std::size_t> order(static_cast<std::size_t>(objective.size()));
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto key = [&](std::size_t k) {
    const auto at = static_cast<Eigen::Index>(k);
    return violation[at] <= acceptable ? std::pair(0, objective[at]) : std::pair(1, violation[at]);
  };
  std::ranges::stable_sort(order, {}, key);
  return order;
}

}  // namespace gaitlab::studies
