// The largest damping rate of a robot, which limits an explicit step.
#pragma once
#include <vector>

#include "core/simulation/plant.h"

namespace gaitlab {

/// Computes accelerations caused by unit impulses: y = M^-1 f. Generalised vectors: velocity of the base frame's origin 3,
/// angular velocity 3 (world axes), joint speeds; base entries stay 0 if the base cannot move.
class InverseMass {
 public:
  virtual void apply(In force, Out acceleration) = 0;

 protected:
  ~InverseMass() = default;
};

/// Slope of one contact force against the velocity of its point: G = tangential T + normal n n^T, N s/m. If `slip` is not 0
/// (sliding), the tangential part acts only at right angles to it.
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

/// Contact slopes of a standing robot: its weight in equal parts on its support (support.h), at the penetration that carries
/// it. Replaces `out`; empty if there is no ground.
void static_contact_slopes(const LaneSettings& settings, const Kinematics& kinematics, std::vector<ContactSlope>& out);

/// Power iteration on A = M^-1 (B + sum J^T G J) with the Rayleigh quotient in the norm of (B + sum J^T G J): a lower bound,
/// with an error of second order in the vector's error. Cold start and a fixed number of iterations: the same state gives the
/// same result.
class RateMonitor {
 public:
  explicit RateMonitor(const Robot& robot);

  /// Inputs, to be filled before each call: sized by the joints, and without contacts.
  std::vector<double> motor, stop;     ///< damping slopes, N m s/rad
  std::vector<double> hinge;           ///< N m s/rad: damping slopes of passive hinges, and stiffness times the step
  std::vector<ContactSlope> contacts;  ///< capacity reserved by the caller

  /// The rate that limits the step. The caller has filled `motor`; for a standing robot with the slopes at rest, because at
  /// speed the motors may be saturated, with slope 0. `touching` fills `contacts` at the present state; a standing robot has
  /// the contacts that carry it, whichever touch at the start. A spring of stiffness K counts as a damper of step K, which
  /// keeps step^2 K / inertia below 1 also.
  template <class Touching>
  [[nodiscard]] Stability rule(const LaneSettings& lane, Base base, const Kinematics& kinematics, const RobotState& state,
                               bool standing, double step, InverseMass& inverse_mass, Touching touching) {
    stop_at(*lane.robot, state);
    hinge_at(*lane.robot, state, standing, step);
    contacts.clear();
    if (standing && base != Base::fixed) {
      static_contact_slopes(lane, kinematics, contacts);
    } else {
      touching();
    }
    return largest(*lane.robot, kinematics, inverse_mass, standing ? kStartIterations : kMonitorIterations);
  }
  [[nodiscard]] Stability largest(const Robot& robot, const Kinematics& kinematics, InverseMass& inverse_mass, int iterations);

  /// 20 iterations give 1 % and better: the rate's error is of second order in the vector's error.
  static constexpr int kMonitorIterations = 20;
  static constexpr int kStartIterations = 200;  ///< once, before the run

 private:
  void stop_at(const Robot& robot, const RobotState& state);
  void hinge_at(const Robot& robot, const RobotState& state, bool standing, double step);
  void damp(const Robot& robot, const Kinematics& k, In velocity, Out force);
  [[nodiscard]] Vec3 velocity_at(const Kinematics& k, const ContactSlope& c) const;
  [[nodiscard]] Stability attribute(const Kinematics& k, In velocity, double rate) const;

  std::vector<double> x_, kx_, y_;
  std::vector<Vec3> v_, omega_, force_, moment_;  ///< per link, about its origin
};

}  // namespace gaitlab
