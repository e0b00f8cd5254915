// Parts of the MJCF by which the robot stands and walks in MuJoCo: contacts, stops and motors with their controller.
#pragma once
#include "interchange/mjcf_laws.h"

namespace gaitlab::interchange {

class MjcfWalking {
 public:
  MjcfWalking(const Scenario& scenario, const RobotState& start, const std::vector<MotorLimits>& limits, double step);

  /// Sets the friction cone and the integrator, which is implicit, because motors damp their joints within a step.
  void write_options(Xml& option) const;
  void write_ground(Xml& geom, double friction) const;
  /// Makes the sphere of a contact element collide. The sphere of a point has its bottom at the point, at the start.
  void write_element(Xml& geom, const ContactElement& element) const;
  /// Writes the stop of a hinge.
  void write_hinge(Xml& joint, std::size_t index) const;
  /// Writes the motors: controls are set points with controller `pid`, otherwise the motor's commands.
  void write_motors(Xml& root) const;
  /// Adds the controls that hold the pose at the start.
  void write_controls(Xml& key) const;
  /// Sentences on the parts that the file contains and lacks.
  [[nodiscard]] std::string comment() const;

 private:
  [[nodiscard]] bool touches() const { return s_.ground.exists() && s_.contact.on != ContactSet::none; }
  [[nodiscard]] bool penalty() const { return touches() && s_.contact.model().penalty_settings; }
  [[nodiscard]] double touch_radius() const;
  [[nodiscard]] std::string contact_comment() const;
  [[nodiscard]] std::string motor_comment() const;
  void write_direct(Xml& element, const char* reference, const char* impedance, const DirectReference& r) const;

  const Scenario& s_;
  const std::vector<MotorLimits>& limits_;
  double step_;
  std::vector<double> angles_;  ///< initial joint angles, rad
  Kinematics at_start_;
  InverseWeights weights_;
  ContactLine line_;
  Drives drives_;
};

}  // namespace gaitlab::interchange
