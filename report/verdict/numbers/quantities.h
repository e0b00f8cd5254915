// Summary numbers with the names that studies use: `speed`, `torque.peak` (the largest of all joints),
// `torque.peak[m3/active]`.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "report/verdict/numbers/numbers.h"

namespace gaitlab::report {

/// A summary number as a quantity of a study.
struct SummaryQuantity {
  enum class Of { run, largest, joint };  ///< number of the whole run, largest of all joints, or number of one joint
  std::string name;
  const SummaryNumber* number = nullptr;
  Of of = Of::run;
  std::size_t joint = 0;

  /// Value of the quantity in a run. A flag is 1 or 0. NaN if not known.
  [[nodiscard]] double value(const RunData& run) const;
  /// Definition of the summary number, with the joints that it refers to.
  [[nodiscard]] std::string meaning() const;
};

/// Quantities of every run, in the order of summary.json: numbers of the whole run, and for numbers per joint the largest of
/// all joints. A number per joint is left out if a number of the whole run has the same name (`energy.electrical`).
const std::vector<SummaryQuantity>& quantities();

/// True if the quantity can be computed before the run has ended: paths, joint statistics and `fell`.
bool known_so_far(const SummaryQuantity& quantity);

/// Value of a quantity for which known_so_far is true, from an incomplete recording (Simulation::watch).
double value_so_far(const SummaryQuantity& quantity, const Scenario& scenario, const Recording& so_far);

/// Name of a number per joint without its prefix: `torque.peak` for the key `per_joint.J.torque.peak`.
std::string short_name(const SummaryNumber& number);

/// Quantity of one joint, by its short name: `torque.peak`. Nothing if no number per joint has this name.
std::optional<SummaryQuantity> joint_quantity(const std::string& name, const Robot& robot, std::size_t joint);

}  // namespace gaitlab::report
