#include "studies/plan/points.h"

#include <fmt/format.h>

#include <cmath>

#include "core/math/functions.h"
#include "core/math/random.h"
#include "core/settings/wording.h"
#include "studies/plan/designs.h"
#include "studies/plan/draws.h"
#include "studies/study/number.h"

namespace gaitlab::studies {

namespace {

// Purpose of a draw, which is the first word of every hash.
enum class PointDraw : std::uint64_t { point = 1, seed, variation };  // kSearchDraw and kEstimateDraw continue this list

std::uint64_t word(PointDraw draw) { return static_cast<std::uint64_t>(draw); }

/// Value of a list at a share in [0, 1) of its length.
const std::string& pick(const std::vector<std::string>& values, double share) {
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size()))];
}

std::string rounded(double value) { return number_text(number_of(fmt::format("{:.12g}", value))); }

double draw_between(const Variation& v, std::uint64_t seed, std::uint64_t replicate, std::uint64_t number) {
  const auto uniform_between = [&] {
    return v.a + (v.b - v.a) * math::uniform({word(PointDraw::variation), seed, replicate, number});
  };
  if (v.law == Variation::Law::uniform) return uniform_between();
  constexpr std::uint64_t kPatience = 1000;  // number of draws after which the limits count as too narrow
  double value = v.a;
  for (std::uint64_t k = 0; k < kPatience; ++k) {
    value = v.a + v.b * math::normal({word(PointDraw::variation), seed, replicate, number, k});
    if (value >= v.low.value_or(value) && value <= v.high.value_or(value)) return value;
  }
  return std::min(std::max(value, v.low.value_or(value)), v.high.value_or(value));
}

std::vector<double> shares(const Study& study, std::uint64_t point) {
  const std::size_t n = study.parameters.size();
  if (study.method == Method::morris) return morris_shares(static_cast<std::uint64_t>(study.seed), n, point);
  if (study.method == Method::sobol_indices) return saltelli_shares(n, point);
  if (study.method == Method::sobol) return sobol_point(n, point);
  std::vector<double> shares(n);
  for (std::size_t k = 0; k < n; ++k)
    shares[k] = math::uniform({word(PointDraw::point), static_cast<std::uint64_t>(study.seed), point, k});
  return shares;
}

}  // namespace

double between(const Parameter& p, double share) {
  if (share <= 0) return p.low;
  if (share >= 1) return p.high;
  const double value =
      p.log ? math::exp(math::log(p.low) + share * (math::log(p.high) - math::log(p.low))) : p.low + share * (p.high - p.low);
  return std::min(std::max(number_of(fmt::format("{:.12g}", value)), p.low), p.high);
}

double share_at(const Parameter& p, double value) {
  if (p.log) return math::log(value / p.low) / math::log(p.high / p.low);
  return (value - p.low) / (p.high - p.low);
}

std::uint64_t Points::points() const {
  const std::uint64_t n = study_.parameters.size();
  if (study_.method == Method::morris) return static_cast<std::uint64_t>(study_.trajectories) * (n + 1);
  if (study_.method == Method::sobol_indices) return static_cast<std::uint64_t>(study_.samples) * (n + 2);
  if (study_.method != Method::grid) return static_cast<std::uint64_t>(study_.runs) / runs_of_point();
  std::uint64_t points = 1;
  for (const Parameter& p : study_.parameters)
    points *= p.values.empty() ? static_cast<std::uint64_t>(p.count) : p.values.size();
  return points;
}

std::vector<std::string> Points::values(std::uint64_t point) const {
  if (point < chosen_.size()) return chosen_[point];
  const std::vector<Parameter>& parameters = study_.parameters;
  std::vector<std::string> values(parameters.size());
  if (study_.method == Method::grid) {
    for (std::size_t k = parameters.size(); k-- > 0;) {
      const Parameter& p = parameters[k];
      const std::uint64_t count = p.values.empty() ? static_cast<std::uint64_t>(p.count) : p.values.size();
      const std::uint64_t at = point % count;
      point /= count;
      values[k] =
          p.values.empty() ? number_text(between(p, static_cast<double>(at) / static_cast<double>(count - 1))) : p.values[at];
    }
    return values;
  }
  const std::vector<double> drawn = shares(study_, point);
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    const Parameter& p = parameters[k];
    values[k] = p.values.empty() ? number_text(between(p, drawn[k])) : pick(p.values, drawn[k]);
  }
  return values;
}

std::vector<std::string> Points::drawn(std::uint64_t replicate, const std::map<std::string, double>& nominal) const {
  std::vector<std::string> values;
  const auto seed_word = static_cast<std::uint64_t>(study_.seed);
  for (std::size_t k = 0; k < study_.replicates.vary.size(); ++k) {
    const Variation& v = study_.replicates.vary[k];
    const double by = v.times ? nominal.at(v.key) : 1;
    if (v.law == Variation::Law::values) {
      const std::string& value = pick(v.values, math::uniform({word(PointDraw::variation), seed_word, replicate, k}));
      values.push_back(v.times ? rounded(by * number_of(value)) : value);
    } else {
      values.push_back(rounded(by * draw_between(v, seed_word, replicate, k)));
    }
  }
  return values;
}

std::int64_t Points::seed(std::uint64_t replicate) const {
  return static_cast<std::int64_t>(math::hash64({word(PointDraw::seed), static_cast<std::uint64_t>(study_.seed), replicate}) >>
                                   11U);
}

}  // namespace gaitlab::studies
