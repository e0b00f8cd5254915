// The summary numbers as studies name them: `speed`, `torque.peak` (the largest of all joints), `torque.peak[m3/active]`.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "report/verdict/numbers.h"

namespace gaitlab::report {

/// A number of a run that can be calculated with.
struct Quantity {
  enum class Of { run, largest, joint };  ///< the whole run, the largest of all joints, or one joint
  std::string name;
  const SummaryNumber* number = nullptr;
  Of of = Of::run;
  std::size_t joint = 0;

  /// NaN: not known. What is found or not is 1 or 0.
  [[nodiscard]] double value(const RunData& run) const;
  /// The definition, and of which joint.
  [[nodiscard]] std::string meaning() const;
};

/// Of every run, in the order of summary.json: those of the whole run, and the largest over the joints of those that are per
/// joint, but for names that the whole run has, too (`energy.electrical`).
const std::vector<Quantity>& quantities();

/// Whether a quantity is known while the run goes on: of ways, of joints in the time so far, and `fell`.
bool known_so_far(const Quantity& quantity);

/// The value of such a quantity of what a simulation has recorded so far (Simulation::watch).
double value_so_far(const Quantity& quantity, const Scenario& scenario, const Recording& so_far);

/// `torque.peak` of `per_joint.J.torque.peak`.
std::string short_name(const SummaryNumber& number);

/// `torque.peak` of one joint; nothing: there is no such number per joint.
std::optional<Quantity> joint_quantity(const std::string& name, const Robot& robot, std::size_t joint);

}  // namespace gaitlab::report
