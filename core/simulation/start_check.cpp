#include "core/simulation/start_check.h"

#include <fmt/format.h>

#include <Eigen/Core>

#include "core/dynamics/mass_matrix.h"

namespace gaitlab {

namespace {

// Of a joint's inertia with all others locked, what is left with those beyond it free. Where nothing is left it comes out as
// rounding, 1e-16 times the sizes along the chain; robots keep more than 1e-6 (a chain of 60 modules).
constexpr double kNothing = 1e-12;

}  // namespace

void check_inertia(const Scenario& scenario, const Kinematics& kinematics, In rotors, std::size_t lanes, std::size_t lane,
                   const SourceLocation& place) {
  const Robot& robot = *scenario.robot;
  MassMatrix mass(robot, scenario.base);
  mass.update(kinematics);
  Eigen::MatrixXd left = mass.matrix();
  const Eigen::Index first = left.rows() - static_cast<Eigen::Index>(robot.joints.size());
  for (std::size_t j = 0; j * lanes < rotors.size(); ++j) {
    left.diagonal()[first + static_cast<Eigen::Index>(j)] += rotors[j * lanes + lane];
  }
  const Eigen::VectorXd locked = left.diagonal();
  // Eliminates from the tips inwards: links stand parents first, each with the joint that moves it.
  for (std::size_t i = robot.links.size() - 1; i > 0; --i) {
    const Link& link = robot.links[i];
    const Eigen::Index j = first + link.joint;
    const double pivot = left(j, j);
    if (!(pivot > kNothing * locked[j])) {
      const Joint& joint = robot.joints[static_cast<std::size_t>(link.joint)];
      throw InputError(place, fmt::format("joint '{}' moves no inertia: the next joint turns about the same axis "
                                          "(gimbal lock). Give the body between the two hinges mass, or start at other angles",
                                          joint.name));
    }
    const Eigen::VectorXd column = left.col(j);
    left.noalias() -= column * (column.transpose() / pivot);
    left.row(j).setZero();
    left.col(j).setZero();
  }
}

}  // namespace gaitlab
