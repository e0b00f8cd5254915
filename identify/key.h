// Settings of a servo that logs can identify.
#pragma once
#include <string>
#include <vector>

#include "core/scenario/scenario.h"

namespace gaitlab::identify {

/// A number of the scenario that is fitted, in its unit: of one joint, or the same for all.
struct Key {
  std::string name;  ///< as in --set, such as `actuator.dry_friction`
  std::string unit;
  double bench = 0;  ///< its value in the bench
  double start = 0;  ///< the same, within the range
  double low = 0, high = 0;
  double least = 0;  ///< least difference of two values with different runs; 0 for any
};

/// Keys of the bench to fit: those that `asked` names (NAME or NAME.JOINT, and =LOW:HIGH), or else the usual ones of its
/// actuator and controller. A key without a range has from a 20th of its value to 20 times its value, within the range of the
/// setting. Throws InputError for an unknown name, a key without a joint that differs between joints, a bad range, and a start
/// of 0 without a range.
std::vector<Key> fitted_keys(const Scenario& bench, const std::vector<std::string>& asked);

}  // namespace gaitlab::identify
