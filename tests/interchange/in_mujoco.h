// An exported robot in MuJoCo, in the states of gaitlab.
#pragma once
#include "bench/mujoco_model.h"
#include "core/dynamics/mass_matrix.h"
#include "interchange/mjcf.h"

namespace gaitlab::test {

/// Robot of a scenario in MuJoCo, at the keyframe `start` of the exported file.
class InMujoco {
 public:
  explicit InMujoco(const Scenario& s, interchange::MjcfModel model = interchange::MjcfModel::strict)
      : scenario_(s), model_(load_mjcf(interchange::to_mjcf(s, model))), data_(mj_makeData(model_.get())) {
    mj_resetDataKeyframe(model_.get(), data_.get(), 0);
  }

  [[nodiscard]] const mjModel& model() const { return *model_; }
  [[nodiscard]] mjData& data() { return *data_; }
  [[nodiscard]] int id(const std::string& joint) const { return mj_name2id(model_.get(), mjOBJ_JOINT, joint.c_str()); }
  double& q(std::size_t joint) { return data_->qpos[model_->jnt_qposadr[id(scenario_.robot->joints[joint].name)]]; }
  [[nodiscard]] int dof(std::size_t joint) const { return model_->jnt_dofadr[id(scenario_.robot->joints[joint].name)]; }

  /// Sets the state in MuJoCo to the state of gaitlab. The pose of a planar base is given by x, z and its rotation from the
  /// start.
  void set(const RobotState& s, double x, double z, double turn) {
    const Vec3 w = s.orientation.conjugate() * s.angular_velocity;
    if (scenario_.base == Base::floating) {
      const Quat& r = s.orientation;
      const std::array<double, 7> pose{s.position.x(), s.position.y(), s.position.z(), r.w(), r.x(), r.y(), r.z()};
      const std::array<double, 6> twist{s.velocity.x(), s.velocity.y(), s.velocity.z(), w.x(), w.y(), w.z()};
      std::copy(pose.begin(), pose.end(), data_->qpos);
      std::copy(twist.begin(), twist.end(), data_->qvel);
    } else if (scenario_.base == Base::planar) {
      const std::array<double, 3> pose{x, z, turn};
      const std::array<double, 3> twist{s.velocity.x(), s.velocity.z(), s.angular_velocity.y()};
      std::copy(pose.begin(), pose.end(), data_->qpos);
      std::copy(twist.begin(), twist.end(), data_->qvel);
    }
    for (std::size_t j = 0; j < s.q.size(); ++j) {
      q(j) = s.q[j];
      data_->qvel[dof(j)] = s.qd[j];
    }
    mj_forward(model_.get(), data_.get());
  }

  /// Matrix from the generalised velocity of gaitlab to the generalised velocity of MuJoCo. In MuJoCo the angular velocity of a
  /// free joint is in body axes, and joints are in depth-first order.
  [[nodiscard]] Eigen::MatrixXd from_ours(const RobotState& s) const {
    const auto base = static_cast<Eigen::Index>(base_entries(scenario_.base).size());
    Eigen::MatrixXd T = Eigen::MatrixXd::Zero(model_->nv, model_->nv);
    T.topLeftCorner(base, base).setIdentity();
    if (base == 6) T.block<3, 3>(3, 3) = s.orientation.toRotationMatrix().transpose();
    for (std::size_t j = 0; j < s.q.size(); ++j) T(dof(j), base + static_cast<Eigen::Index>(j)) = 1;
    return T;
  }

  /// Mass matrix, computed column by column as M e_i, because the arguments of the function for the whole matrix differ between
  /// versions of MuJoCo.
  Eigen::MatrixXd mass() {
    const Eigen::MatrixXd units = Eigen::MatrixXd::Identity(model_->nv, model_->nv);
    Eigen::MatrixXd M(model_->nv, model_->nv);
    for (Eigen::Index i = 0; i < M.cols(); ++i) mj_mulM(model_.get(), data_.get(), M.col(i).data(), units.col(i).data());
    return M;
  }
  Eigen::VectorXd bias() { return Eigen::Map<const Eigen::VectorXd>(data_->qfrc_bias, model_->nv); }

 private:
  const Scenario& scenario_;
  MujocoModel model_;
  MujocoData data_;
};

}  // namespace gaitlab::test
