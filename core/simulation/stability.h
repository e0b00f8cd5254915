// The largest damping rate of a robot: what limits an explicit step.
#pragma once
#include <vector>

#include "core/simulation/plant.h"

namespace gaitlab {

/// Generalised vectors: velocity of the base frame's origin 3, angular velocity 3 (world axes), joint speeds.
/// Accelerations that unit impulses cause: y = M^-1 f; base entries stay 0 where the base cannot move.
class InverseMass {
 public:
  virtual void apply(In force, Out acceleration) = 0;

 protected:
  ~InverseMass() = default;
};

/// Slope of one contact force against the velocity of its point: G = tangential T + normal n n^T, N s/m; `across` limits the
/// tangential part to the direction at right angles to the slip (sliding).
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

/// Slopes of a robot that stands: its weight in equal parts on its support (support.h), at the penetration that carries it.
/// Replaces `out`; empty where there is no ground.
void stand(const LaneSettings& settings, const Kinematics& kinematics, std::vector<ContactSlope>& out);

/// Power iteration on A = M^-1 (B + sum J^T G J), Rayleigh quotient in the norm of (B + sum J^T G J): from below, and right to
/// second order in the vector's error. Cold start, fixed number of iterations: the same state gives the same answer.
class RateMonitor {
 public:
  explicit RateMonitor(const Robot& robot);

  /// Fill before each call; sized by the joints, and cleared of contacts.
  std::vector<double> motor, stop;     ///< damping slopes, N m s/rad
  std::vector<ContactSlope> contacts;  ///< capacity is reserved by the caller

  [[nodiscard]] Stability largest(const Robot& robot, const Kinematics& kinematics, InverseMass& inverse_mass, int iterations);

 private:
  void damp(const Robot& robot, const Kinematics& k, In velocity, Out force);
  [[nodiscard]] Vec3 velocity_at(const Kinematics& k, const ContactSlope& c) const;
  [[nodiscard]] Stability attribute(const Kinematics& k, In velocity, double rate) const;

  std::vector<double> x_, kx_, y_;
  std::vector<Vec3> v_, omega_, force_, moment_;  ///< per link, about its origin
};

}  // namespace gaitlab
