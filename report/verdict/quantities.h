// Summary numbers under their names in studies: `speed`, `torque.peak` (the largest of all joints), `torque.peak[m3/active]`.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "report/verdict/numbers.h"

namespace gaitlab::report {

/// A number of a run for calculations.
struct Quantity {
  enum class Of { run, largest, joint };  ///< the whole run, the largest of all joints, or one joint
  std::string name;
  const SummaryNumber* number = nullptr;
  Of of = Of::run;
  std::size_t joint = 0;

  /// NaN: not known. A flag is 1 or 0.
  [[nodiscard]] double value(const RunData& run) const;
  /// The definition, with the joint.
  [[nodiscard]] std::string meaning() const;
};

/// Quantities of every run, in the order of summary.json: numbers of the whole run, and the largest over the joints of numbers
/// per joint, except names that the whole run also has (`energy.electrical`).
const std::vector<Quantity>& quantities();

/// Whether a quantity is known during the run: paths, joint statistics so far, and `fell`.
bool known_so_far(const Quantity& quantity);

/// Value of such a quantity in an incomplete recording (Simulation::watch).
double value_so_far(const Quantity& quantity, const Scenario& scenario, const Recording& so_far);

/// `torque.peak` of `per_joint.J.torque.peak`.
std::string short_name(const SummaryNumber& number);

/// `torque.peak` of one joint; nothing: unknown number per joint.
std::optional<Quantity> joint_quantity(const std::string& name, const Robot& robot, std::size_t joint);

}  // namespace gaitlab::report
