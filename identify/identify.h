// Identification of a servo from logs: starts, choice of the keys, intervals and held-out error.
#pragma once
#include <Eigen/Dense>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "identify/fit.h"

namespace gaitlab::identify {

/// A key, as the logs identify it.
struct IdentifiedKey {
  std::size_t key = 0;
  bool fitted = false;    ///< false if the key earns too little and keeps the bench's value
  bool at_bound = false;  ///< true at a bound of its range: the interval then means nothing
  double value = 0;
  double low = 0, high = 0;  ///< interval of 95 %
  double worth = 0;          ///< share by which the error of logs that are left out grows without the key; NaN if not tried
};

struct Identified {
  Fit best;                            ///< values rounded to their intervals
  std::size_t starts = 0, agreed = 0;  ///< starts, and those that ended within 2 % of the best error
  std::vector<IdentifiedKey> keys;     ///< all keys
  Eigen::MatrixXd correlation;  ///< of the fitted keys, in the order of Fit::at; empty without more fitted logs than keys
  std::vector<Compared> before, after;  ///< every log by the bench, and by the fit
  std::vector<Logged> kinds;            ///< the compared quantities
  std::size_t runs = 0;
};

struct IdentifySettings {
  std::int64_t seed = 1;
  bool choose = true;     ///< false to keep all keys
  std::size_t drawn = 4;  ///< drawn starts, besides the values of the bench
  std::function<void(const std::string& stage)> told = [](const std::string&) {};
};

/// Fits all keys from several starts, drops each key that earns less than 5 % of the error of left-out logs, and fits the rest
/// again. Held-out logs are used only for their numbers at the end. Throws InputError for a key that the bench does not let
/// set, and RunError if a run with the fitted values does not
/// reach its end.
Identified identify(ErrorModels& models, const IdentifySettings& settings);

}  // namespace gaitlab::identify
