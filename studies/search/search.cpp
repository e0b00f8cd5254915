#include "studies/search/search.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "core/math/functions.h"
#include "core/math/random.h"
#include "studies/plan/designs.h"
#include "studies/plan/draws.h"
#include "studies/plan/points.h"
#include "studies/search/box.h"
#include "studies/search/cma_gp.h"
#include "studies/search/fitness.h"
#include "studies/search/scbo.h"
#include "studies/study/population.h"

namespace gaitlab::studies {

namespace {

constexpr double kConverged = 1e-4;

/// Indices sorted by the number of points that dominate each point. Points with equal numbers keep their order.
std::vector<std::size_t> best_first(const std::vector<Vector>& values) {
  std::vector<std::size_t> behind(values.size());
  for (std::size_t k = 0; k < values.size(); ++k) {
    const auto beats = [&](const Vector& other) { return dominates(other, values[k]); };
    behind[k] = static_cast<std::size_t>(std::ranges::count_if(values, beats));
  }
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t k) { return behind[k]; });
  return order;
}

std::unique_ptr<Evolution> evolution(const EvolutionSettings& settings) {
  if (settings.algorithm == Method::scbo) return scbo(settings);
  if (settings.algorithm == Method::cma_gp) return cma_gp(settings);
  return pagmo_evolution(settings);
}

}  // namespace

bool dominates(std::span<const double> a, std::span<const double> b) {
  bool better = false;
  for (std::size_t k = 0; k < a.size(); ++k) {
    if (a[k] > b[k]) return false;
    better = better || a[k] < b[k];
  }
  return better;
}

Search::Search(const SearchSettings& settings)
    : settings_(settings), population_(settings.population > 0 ? settings.population : usual_population(settings.dimensions)) {
  for (std::size_t k = 0; k < settings.dimensions; ++k)
    shift_.push_back(math::uniform({kSearchDraw, settings.seed, settings.number, k}));
  begin();
}

std::size_t Search::block() const { return std::max(first_block(population(), settings_.dimensions), settings_.starts.size()); }

void Search::begin() {
  evolution_.reset();
  front_.clear();
  idle_ = 0;
  since_ = rated_->size();
  raw_ = restart_ == 0 ? settings_.starts : std::vector<Vector>();
  while (raw_.size() < block()) {
    Vector point = sobol_point(settings_.dimensions, taken_++);
    for (std::size_t c = 0; c < point.size(); ++c) point[c] = std::fmod(point[c] + shift_[c], 1.0);
    raw_.push_back(std::move(point));
  }
}

void Search::start(const std::vector<Vector>& values) {
  EvolutionSettings s{.algorithm = settings_.algorithm,
                      .low = Vector(settings_.dimensions, 0.0),
                      .high = Vector(settings_.dimensions, 1.0),
                      .seed = static_cast<unsigned>(math::hash64({kSearchDraw, settings_.seed, settings_.number, restart_, 1})),
                      .sigma = settings_.sigma,
                      .points = {},
                      .values = {},
                      .rated = rated_.get(),
                      .since = since_};
  const std::vector<std::size_t> order = best_first(values);
  for (std::size_t k = 0; k < population(); ++k) {
    s.points.push_back(raw_[order[k]]);
    s.values.push_back(values[order[k]]);
  }
  evolution_ = evolution(s);
}

const std::vector<Vector>& Search::ask() {
  if (!asked_.empty() || ended_) return asked_;
  const auto finite = [](const Vector& point) { return std::ranges::all_of(point, [](double c) { return std::isfinite(c); }); };
  for (;;) {
    if (evolution_) raw_ = evolution_->ask();
    if (!raw_.empty() && std::ranges::all_of(raw_, finite)) break;
    if (restart_ == settings_.restarts) {
      ended_ = true;
      return asked_;
    }
    ++restart_;
    begin();
  }
  for (const Vector& point : raw_) asked_.push_back(within_box(point));
  return asked_;
}

void Search::tell(const std::vector<Rating>& ratings) {
  std::vector<Vector> values;
  for (std::size_t k = 0; k < asked_.size(); ++k) {
    rated_->push_back({asked_[k], ratings[k]});
    values.push_back(ratings[k].fitness);
  }
  asked_.clear();
  ++generation_;
  if (!evolution_) {
    (void)improved(values);
    return start(values);
  }
  evolution_->tell(values);
  if (!converged(values)) return;
  ended_ = restart_ == settings_.restarts;
  if (ended_) return;
  ++restart_;
  begin();
}

double Search::spread() const {
  double most = 0;
  const auto n = static_cast<double>(raw_.size());
  for (std::size_t c = 0; c < settings_.dimensions; ++c) {
    double mean = 0;
    double square = 0;
    for (const Vector& point : raw_) mean += point[c] / n;
    for (const Vector& point : raw_) square += (point[c] - mean) * (point[c] - mean) / n;
    most = std::max(most, std::sqrt(square));
  }
  return most;
}

bool Search::improved(const std::vector<Vector>& values) {
  if (settings_.objectives == 1) {
    const Vector& best = *std::ranges::min_element(values);
    const bool better = front_.empty() || fitness_gain(front_[0][0], best[0]) > kConverged;
    if (better) front_ = {best};
    return better;
  }
  bool any = false;
  for (const Vector& value : values) {
    const auto beats = [&](const Vector& other) { return other == value || dominates(other, value); };
    if (std::ranges::any_of(front_, beats)) continue;
    std::erase_if(front_, [&](const Vector& other) { return dominates(value, other); });
    front_.push_back(value);
    any = true;
  }
  return any;
}

bool Search::converged(const std::vector<Vector>& values) {
  if (raw_.size() > 1 && spread() < kConverged) return true;
  idle_ = improved(values) ? 0 : idle_ + 1;
  return idle_ >= 10 + 30 * settings_.dimensions / population();
}

}  // namespace gaitlab::studies
