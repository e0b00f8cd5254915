// Largest damping rate of a robot, which limits an explicit step.
#pragma once
#include <vector>

#include "core/laws/gear_play.h"
#include "core/laws/hinge_stop.h"
#include "core/simulation/plant.h"

namespace gaitlab {

/// Computes y = M^-1 f, the change of velocity y under an impulse f. The vectors contain the velocity of the origin of the base
/// frame (3 entries), the angular velocity of the base (3), both in world axes, and the joint speeds. The entries of the base
/// stay 0 if it cannot move.
class InverseMass {
 public:
  virtual void apply(In force, Out acceleration) = 0;

 protected:
  ~InverseMass() = default;
};

/// Slope of one contact force with respect to the velocity of its point, N s/m: G = tangential T + along_normal n n^T, where T
/// projects onto the tangential plane. If the contact slides (`slip` is not 0), the tangential part acts only at right angles
/// to `slip`.
struct ContactSlope {
  std::size_t element = 0, link = 0;
  Vec3 point = Vec3::Zero(), normal = Vec3::UnitZ(), slip = Vec3::Zero();  ///< slip: unit vector, 0 while sticking
  double tangential = 0, along_normal = 0;

  [[nodiscard]] Vec3 apply(const Vec3& v) const {
    const double vn = normal.dot(v);
    const Vec3 vt = v - vn * normal;
    return along_normal * vn * normal + tangential * (vt - slip.dot(vt) * slip);
  }
};

/// Replaces `out` by the contact slopes of a standing robot. Its weight rests in equal parts on its support (support.h), at the
/// penetration that carries the weight. `out` is empty without a ground.
void static_contact_slopes(const LaneSettings& settings, const Kinematics& kinematics, std::vector<ContactSlope>& out);

/// Estimates the largest eigenvalue of A = M^-1 (B + sum J^T G J) by power iteration, with the Rayleigh quotient in the norm of
/// (B + sum J^T G J). The estimate is a lower bound, with an error of second order in the error of the vector. The start vector
/// and the number of iterations are fixed, so that the same state gives the same result.
class RateMonitor {
 public:
  /// `rotors`: reflected inertias of the motors of joints with play (joints_with_play), kg m^2.
  explicit RateMonitor(const Robot& robot, std::vector<double> rotors = {});

  /// Inputs of largest(), which the caller fills. The constructor sets one 0 or NaN per joint, and no contacts.
  std::vector<double> motor, stop;     ///< damping slopes, N m s/rad
  std::vector<double> hinge;           ///< damping slopes of passive hinges plus stiffness times step, N m s/rad
  std::vector<double> hold;            ///< angles of stuck hinges, rad; NaN for other hinges
  std::vector<ContactSlope> contacts;  ///< the caller reserves the capacity

  /// Rate that limits the step. The caller has filled `motor`. Its slopes are those at rest if the robot is standing, because
  /// motors that are saturated at speed have slope 0. `touching` fills `contacts` at the present state. The contacts of a
  /// standing robot are instead the elements that carry it, even if others touch at the start. A spring of stiffness K counts
  /// as a damper of step * K, which also keeps step^2 K / inertia below 1.
  template <class Touching>
  [[nodiscard]] Stability rule(const LaneSettings& lane, Base base, const Kinematics& kinematics, const RobotState& state,
                               bool standing, double step, InverseMass& inverse_mass, Touching touching) {
    stop_at(*lane.robot, state, step);
    for (const std::size_t j : lane.stuck) stop[j] = standing ? held(step) : stop[j];
    hinge_at(*lane.robot, state, standing, step);
    for (std::size_t k = 0; k < plays_.size(); ++k) {  // a motor meets a flank at any time
      const GearPlay own = law(lane.robot->joints[plays_[k]].play);
      flank_[k] = own.damping() + step * own.stiffness;
    }
    contacts.clear();
    if (standing && base != Base::fixed) {
      static_contact_slopes(lane, kinematics, contacts);
    } else {
      touching();
    }
    return largest(*lane.robot, kinematics, inverse_mass, standing ? kStartIterations : kMonitorIterations);
  }
  [[nodiscard]] Stability largest(const Robot& robot, const Kinematics& kinematics, InverseMass& inverse_mass, int iterations);

  /// 20 iterations give an error of at most 1 %, because the error of the rate is of second order in the error of the vector.
  static constexpr int kMonitorIterations = 20;
  static constexpr int kStartIterations = 200;  ///< used once, before the run

 private:
  void stop_at(const Robot& robot, const RobotState& state, double step);
  /// Damping slope of a stuck hinge plus its stiffness times step, N m s/rad.
  static double held(double step) { return HingeHold::kDamping + step * HingeHold::kStiffness; }
  void hinge_at(const Robot& robot, const RobotState& state, bool standing, double step);
  void damp(const Robot& robot, const Kinematics& k, In velocity, Out force);
  [[nodiscard]] Vec3 velocity_at(const Kinematics& k, const ContactSlope& c) const;
  [[nodiscard]] Stability attribute(const Kinematics& k, In velocity, double rate) const;

  std::vector<std::size_t> plays_;      ///< joints with play; their motors are entries of x_ behind those of the joints
  std::vector<double> rotors_, flank_;  ///< of these joints: kg m^2; damping of the flanks plus stiffness times step, N m s/rad
  std::vector<double> x_, kx_, y_;
  std::vector<Vec3> v_, omega_, force_, moment_;  ///< per link, at the origin of the link frame
};

}  // namespace gaitlab
