#include "core/dynamics/rotor_inertia.h"

#include <algorithm>

namespace gaitlab {

bool has_rotors(const Actuator* actuator) {
  const In inertia = actuator == nullptr ? In() : actuator->reflected_inertia();
  return std::ranges::any_of(inertia, [](double value) { return value > 0; });
}

std::vector<double> rotors_beside(const Robot& robot, const Actuator* actuator, std::size_t lane, std::size_t lanes) {
  const In inertia = actuator == nullptr ? In() : actuator->reflected_inertia();
  std::vector<double> all;
  for (const std::size_t j : joints_with_play(robot)) all.push_back(inertia.empty() ? 0 : inertia[j * lanes + lane]);
  return all;
}

RotorInertia::RotorInertia(const Robot& robot, Base base, In inertia)
    : base_(base_entries(base)),
      mass_(robot, base),
      inertia_(inertia.begin(), inertia.end()),
      sum_(mass_.matrix()),
      factor_(sum_.rows()),
      vector_(sum_.rows()) {
  for (const std::size_t j : joints_with_play(robot)) inertia_[j] = 0;
}

void RotorInertia::update(const Kinematics& kinematics) {
  mass_.update(kinematics);
  sum_ = mass_.matrix();
  const auto first = static_cast<Eigen::Index>(base_.size());
  for (std::size_t j = 0; j < inertia_.size(); ++j) {
    const Eigen::Index i = first + static_cast<Eigen::Index>(j);
    sum_(i, i) += inertia_[j];
  }
  factor_.compute(sum_);
}

void RotorInertia::add_to(Acceleration& a) {
  const auto first = static_cast<Eigen::Index>(base_.size());
  vector_.setZero();
  for (std::size_t j = 0; j < inertia_.size(); ++j) vector_[first + static_cast<Eigen::Index>(j)] = inertia_[j] * a.joints[j];
  factor_.solveInPlace(vector_);
  for (std::size_t i = 0; i < base_.size(); ++i) {
    const auto entry = static_cast<Eigen::Index>(base_[i]);
    (entry < 3 ? a.linear[entry] : a.angular[entry - 3]) -= vector_[static_cast<Eigen::Index>(i)];
  }
  for (std::size_t j = 0; j < inertia_.size(); ++j) a.joints[j] -= vector_[first + static_cast<Eigen::Index>(j)];
}

void RotorInertia::inverse_mass(In f, Out y) {
  const auto first = static_cast<Eigen::Index>(base_.size());
  for (std::size_t i = 0; i < base_.size(); ++i) vector_[static_cast<Eigen::Index>(i)] = f[base_[i]];
  for (std::size_t j = 0; j < inertia_.size(); ++j) vector_[first + static_cast<Eigen::Index>(j)] = f[6 + j];
  factor_.solveInPlace(vector_);
  std::fill(y.begin(), y.end(), 0.0);
  for (std::size_t i = 0; i < base_.size(); ++i) y[base_[i]] = vector_[static_cast<Eigen::Index>(i)];
  for (std::size_t j = 0; j < inertia_.size(); ++j) y[6 + j] = vector_[first + static_cast<Eigen::Index>(j)];
}

}  // namespace gaitlab
