#include "identify/identify.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "core/errors.h"
#include "core/math/functions.h"
#include "core/math/random.h"

namespace gaitlab::identify {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kWorth = 0.05;        // the number
constexpr double kAgreement = 0.02;    // chosen
constexpr std::size_t kMostFolds = 4;  // chosen: each fold is a fit

std::vector<std::size_t> fitted_logs(const std::vector<BenchLog>& logs) {
  std::vector<std::size_t> fitted;
  for (std::size_t i = 0; i < logs.size(); ++i) {
    if (!logs[i].held_out) fitted.push_back(i);
  }
  return fitted;
}

/// Fold of each fitted log: logs of a group are in the same fold. If there is only one group, each log counts as a group.
std::vector<std::size_t> folds_of(const std::vector<BenchLog>& logs, const std::vector<std::size_t>& fitted) {
  std::map<std::string, std::size_t> groups;
  std::vector<std::size_t> folds;
  for (const std::size_t i : fitted) folds.push_back(groups.try_emplace(logs[i].group, groups.size()).first->second);
  if (groups.size() == 1) std::iota(folds.begin(), folds.end(), std::size_t{0});
  for (std::size_t& fold : folds) fold %= kMostFolds;
  return folds;
}

Point start(const ErrorModels& models, std::size_t number, std::int64_t seed) {
  Point point;
  point.values.resize(static_cast<Index>(models.keys().size()));
  for (std::size_t k = 0; k < models.keys().size(); ++k) {
    const Key& key = models.keys()[k];
    const double drawn = math::uniform({static_cast<std::uint64_t>(seed), number, k});
    double value = key.start;
    if (number > 0) value = key.start > 0 ? key.start * math::exp((2 * drawn - 1) * math::log(2.0)) : models.scale(k) * drawn;
    point.keys.push_back(k);
    point.values[static_cast<Index>(k)] = std::clamp(value, key.low, key.high);
  }
  return point;
}

Point without(const Point& point, std::size_t position) {
  Point less;
  less.values.resize(point.values.size() - 1);
  for (std::size_t k = 0, to = 0; k < point.keys.size(); ++k) {
    if (k == position) continue;
    less.keys.push_back(point.keys[k]);
    less.values[static_cast<Index>(to++)] = point.values[static_cast<Index>(k)];
  }
  return less;
}

/// Mean ErrorModel::mae of the fitted logs, each by the fit without its fold. Every fit starts at `start`.
double left_out_error(ErrorModels& models, const Point& start) {
  const std::vector<std::size_t> fitted = fitted_logs(models.logs());
  const std::vector<std::size_t> folds = folds_of(models.logs(), fitted);
  std::vector<Fit> fits(*std::ranges::max_element(folds) + 1, Fit{start});
  for (std::size_t i = 0; i < fitted.size(); ++i) {
    for (std::size_t fold = 0; fold < fits.size(); ++fold) {
      if (folds[i] != fold) fits[fold].logs.push_back(fitted[i]);
    }
  }
  solve(fits, models);
  std::vector<Question> questions;
  for (std::size_t i = 0; i < fitted.size(); ++i) questions.push_back({fitted[i], fits[folds[i]].at});
  double sum = 0;
  for (const ErrorModel& one : models(questions)) sum += one.whole ? one.mae : std::numeric_limits<double>::infinity();
  return sum / static_cast<double>(fitted.size());
}

/// Position of the key whose return to the bench's value costs least by the models at the fit, among those not yet `kept`.
std::optional<std::size_t> cheapest(const Fit& fit, const ErrorModels& models, const std::vector<std::size_t>& kept) {
  MatrixXd curvature = MatrixXd::Zero(fit.at.values.size(), fit.at.values.size());
  for (const ErrorModel& model : fit.models) curvature += model.local;
  curvature.diagonal().array() += 1e-9 * curvature.trace();
  const MatrixXd inverse = curvature.inverse();
  std::optional<std::size_t> best;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < fit.at.keys.size(); ++k) {
    const std::size_t key = fit.at.keys[k];
    if (std::ranges::find(kept, key) != kept.end()) continue;
    const auto at = static_cast<Index>(k);
    const double back = (fit.at.values[at] - models.keys()[key].bench) / models.scale(key);
    const double cost = back * back / inverse(at, at);
    if (cost < least) {
      least = cost;
      best = k;
    }
  }
  return best;
}

/// A value whose last digit is at most a tenth of `half`.
double rounded(double value, double half) {
  if (!(half > 0) || !std::isfinite(half)) return value;
  const int digits = static_cast<int>(std::ceil(-std::log10(half / 10)));
  if (digits <= 0) return std::round(value);
  constexpr int kMost = 15;
  return std::stod(fmt::format("{:.{}f}", value, std::min(digits, kMost))) + 0.0;  // + 0.0: no -0
}

/// Change of a key, the others held, that raises the cost by a thousandth; infinite if it has no effect.
double harmless(const Fit& fit, const ErrorModels& models, Index key) {
  double curvature = 0;
  for (const ErrorModel& model : fit.models) curvature += model.local(key, key);
  curvature /= static_cast<double>(fit.models.size());
  constexpr double kPart = 1e-3;
  return std::sqrt(kPart * fit.cost / curvature) * models.scale(fit.at.keys[static_cast<std::size_t>(key)]);
}

/// Intervals by leaving out one log each (jackknife), on the second-order models: the change of the fit without log l is d_l,
/// and the variance (n - 1) / n sum (d_l - mean)^2; B. Efron, C. Stein, The jackknife estimate of variance, 1981. Student's t
/// has n - 1 degrees of freedom.
MatrixXd covariance(const Fit& fit, const ErrorModels& models) {
  const std::size_t n = fit.models.size();
  MatrixXd changes(fit.at.values.size(), static_cast<Index>(n));
  for (std::size_t l = 0; l < n; ++l) {
    std::vector<ErrorModel> others = fit.models;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(l));
    for (ErrorModel& model : others) model.curvature = model.local;
    changes.col(static_cast<Index>(l)) = model_step(fit, others, models, 0);
  }
  changes.colwise() -= changes.rowwise().mean().eval();
  return changes * changes.transpose() * (static_cast<double>(n - 1) / static_cast<double>(n));
}

MatrixXd correlation_of(const MatrixXd& covariance) {
  MatrixXd made = covariance;
  for (Index i = 0; i < made.rows(); ++i) {
    for (Index j = 0; j < made.cols(); ++j) {
      const double size = std::sqrt(covariance(i, i) * covariance(j, j));
      made(i, j) = size > 0 ? covariance(i, j) / size : 0;
    }
  }
  return made;
}

/// Half width of the interval of 95 % of a jackknife over logs, in standard deviations.
double student_quantile(std::size_t logs) {
  // Without long double, whose start of the library fails under valgrind.
  using Policy = boost::math::policies::policy<boost::math::policies::promote_double<false>>;
  return boost::math::quantile(boost::math::students_t_distribution<double, Policy>(static_cast<double>(logs - 1)), 0.975);
}

/// Fits all keys from the values of the bench and from drawn ones.
void fit_starts(Identified& made, ErrorModels& models, const IdentifySettings& settings) {
  std::vector<Fit> fits;
  for (std::size_t s = 0; s <= settings.drawn; ++s)
    fits.push_back({start(models, s, settings.seed), fitted_logs(models.logs())});
  solve(fits, models);
  std::ranges::stable_sort(fits, {}, &Fit::cost);
  made.best = fits[0];
  made.starts = fits.size();
  const double most = (1 + kAgreement) * std::sqrt(made.best.cost);
  made.agreed =
      static_cast<std::size_t>(std::ranges::count_if(fits, [&](const Fit& fit) { return std::sqrt(fit.cost) <= most; }));
}

/// Returns keys to the bench's values, the cheapest first, as long as that costs less than kWorth of the error of left-out
/// logs. `worth` receives this share for each key that was tried.
void choose_keys(Fit& best, std::vector<double>& worth, ErrorModels& models, const IdentifySettings& settings) {
  settings.told("left-out logs with all keys");
  std::vector<std::size_t> kept;  // keys that have earned their place
  double error = left_out_error(models, best.at);
  while (const auto position = cheapest(best, models, kept)) {
    if (best.at.keys.size() == 1) return;
    const std::size_t key = best.at.keys[*position];
    settings.told("left-out logs without " + models.keys()[key].name);
    const Point less = without(best.at, *position);
    const double other = left_out_error(models, less);
    worth[key] = other / error - 1;
    if (!(other < (1 + kWorth) * error)) {
      kept.push_back(key);
      continue;
    }
    error = std::min(error, other);
    Fit again{less, best.logs};
    solve({&again, 1}, models);
    best = std::move(again);
  }
}

}  // namespace

Identified identify(ErrorModels& models, const IdentifySettings& settings) {
  const std::vector<Key>& keys = models.keys();
  Identified made;
  made.kinds = models.kinds();
  // A key that cannot be set is an error of the user; later, such a scenario is a point that no servo has.
  static_cast<void>(models.logs()[0].with->with(sets_of(start(models, 0, settings.seed), keys)));
  settings.told("starts");
  fit_starts(made, models, settings);
  std::vector<double> worth(keys.size(), std::numeric_limits<double>::quiet_NaN());
  if (settings.choose) choose_keys(made.best, worth, models, settings);
  const MatrixXd spread = covariance(made.best, models);
  const double quantile = student_quantile(made.best.logs.size());
  for (std::size_t k = 0; k < keys.size(); ++k) {
    IdentifiedKey& one = made.keys.emplace_back(IdentifiedKey{k, false, false, keys[k].bench, 0, 0, worth[k]});
    const auto at = std::ranges::find(made.best.at.keys, k) - made.best.at.keys.begin();
    if (static_cast<std::size_t>(at) == made.best.at.keys.size()) continue;
    one.fitted = true;
    double& value = made.best.at.values[at];
    one.at_bound = at_bound(keys[k], value);
    const double half = quantile * std::sqrt(spread(at, at)) * models.scale(k);
    value = one.value =
        std::clamp(rounded(value, std::min(half, 10 * harmless(made.best, models, at))), keys[k].low, keys[k].high);
    one.low = std::max(rounded(value - half, half), keys[k].low);
    one.high = std::min(rounded(value + half, half), keys[k].high);
  }
  // The jackknife of so few logs has only correlations of 1.
  if (made.best.logs.size() > made.best.at.keys.size()) made.correlation = correlation_of(spread);

  settings.told("all logs");
  made.before = models.compared(Point{});
  made.after = models.compared(made.best.at);
  for (std::size_t l = 0; l < made.after.size(); ++l) {
    if (!made.after[l].errors)
      throw RunError(fmt::format("log {}: its run with the fitted values does not reach its end", models.logs()[l].name));
  }
  made.runs = models.runs();
  return made;
}

}  // namespace gaitlab::identify
