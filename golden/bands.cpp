#include "golden/bands.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string>

namespace gaitlab::golden {

namespace {

constexpr double kOfTheLargest = 1e-3;  // share of the largest range among columns of one unit
// Least scale in the unit of the column: 1 um, urad, uN m or uA is without significance in the model.
constexpr double kOfTheUnit = 1e-6;
constexpr double kLeastOfRange = 1e-6;  // share of the range; above the rounding of other compilers, as it grows over a run

struct Extent {
  std::string unit;
  double size = 0;
};

std::vector<double> scales_of(const std::vector<Extent>& extents) {
  std::map<std::string, double> largest;
  for (const Extent& extent : extents) largest[extent.unit] = std::max(largest[extent.unit], extent.size);
  std::vector<double> found;
  found.reserve(extents.size());
  for (const Extent& extent : extents)
    found.push_back(std::max({extent.size, kOfTheLargest * largest[extent.unit], kOfTheUnit}));
  return found;
}

double range_of(const Trace& trace, std::size_t column) {
  double low = INFINITY;
  double high = -INFINITY;
  for (std::size_t k = 0; k < trace.rows(); ++k) {
    low = std::min(low, trace.at(k, column));
    high = std::max(high, trace.at(k, column));
  }
  return trace.rows() == 0 ? 0 : high - low;
}

/// kStandardErrors of the difference of two means over kStarts runs, whose numbers have the given deviation.
double band_of_means(double deviation) { return kStandardErrors * deviation * std::sqrt(2.0 / kStarts); }

/// Band of a column that has the differences of `band` relative to `scale`, in the column's unit.
Band column_band(Band band, double scale, double range, double natural) {
  band.floor = kLeastOfRange;
  const bool varies = range >= kConstantRange * natural;
  if (varies && !(band.width() > kWidestColumn && band.width() * scale <= kNarrowBand * natural)) return band;
  return {band.ensemble * scale / natural, band.halving * scale / natural, kConstantBand, natural};
}

const GoldenNumber& number(const GoldenRun& run, const std::string& name) {
  const auto named = [&](const GoldenNumber& n) { return n.name == name; };
  const auto found = std::find_if(run.numbers.begin(), run.numbers.end(), named);
  if (found == run.numbers.end()) throw std::invalid_argument("a run to calibrate with has no number " + name);
  return *found;
}

}  // namespace

std::vector<double> scales(const Trace& trace) {
  std::vector<Extent> extents;
  for (std::size_t i = 0; i < trace.columns.size(); ++i) extents.push_back({trace.columns[i].unit, range_of(trace, i)});
  return scales_of(extents);
}

std::vector<double> scales(const Trace& trace, const std::vector<Band>& bands) {
  std::vector<double> found = scales(trace);
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (bands[i].constant > 0) found[i] = bands[i].constant;
  }
  return found;
}

std::vector<double> scales(const std::vector<GoldenNumber>& numbers) {
  std::vector<Extent> extents;
  extents.reserve(numbers.size());
  for (const GoldenNumber& number : numbers) extents.push_back({number.unit, std::abs(number.value)});
  return scales_of(extents);
}

double mean_square(const Trace& a, const Trace& b, std::size_t column) {
  double sum = 0;
  for (std::size_t k = 0; k < a.rows(); ++k) {
    const double d = b.at(k, column) - a.at(k, column);
    sum += d * d;
  }
  return a.rows() == 0 ? 0 : sum / static_cast<double>(a.rows());
}

std::vector<double> mean_squares(const Trace& a, const Trace& b) {
  std::vector<double> squares(a.columns.size());
  for (std::size_t i = 0; i < squares.size(); ++i) squares[i] = mean_square(a, b, i);
  return squares;
}

Bands calibrate(const GoldenRun& base, std::span<const GoldenRun> ensemble, const GoldenRun& halved) {
  Bands bands;
  bands.columns.resize(1);
  const std::vector<double> scale = scales(base.trace);
  for (std::size_t i = 1; i < base.trace.columns.size(); ++i) {
    Band band;
    for (const GoldenRun& run : ensemble)
      band.ensemble = std::max(band.ensemble, kEnsembleFactor * std::sqrt(mean_square(base.trace, run.trace, i)) / scale[i]);
    band.halving = kHalvingFactor * std::sqrt(mean_square(base.trace, halved.trace, i)) / scale[i];
    const double natural = base.natural.empty() ? 0 : base.natural[i];
    bands.columns.push_back(column_band(band, scale[i], range_of(base.trace, i), natural));
  }
  const std::vector<double> size = scales(base.numbers);
  for (std::size_t i = 0; i < base.numbers.size(); ++i) {
    const auto change = [&](const GoldenRun& run) {
      return std::abs(number(run, base.numbers[i].name).value - base.numbers[i].value) / size[i];
    };
    Band band;
    for (const GoldenRun& run : ensemble) band.ensemble = std::max(band.ensemble, kEnsembleFactor * change(run));
    if (base.numbers[i].deviation) band.ensemble = band_of_means(*base.numbers[i].deviation) / size[i];
    band.halving = kHalvingFactor * change(halved);
    band.floor = kLeastOfRange;
    bands.numbers.push_back(band);
  }
  return bands;
}

}  // namespace gaitlab::golden
