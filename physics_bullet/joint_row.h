// Soft, limited row of one joint in the constraint solver of Bullet, for a motor or a hinge stop; used inside physics_bullet
// only.
#pragma once
#include <BulletDynamics/Featherstone/btMultiBodyConstraint.h>

namespace gaitlab::bullet {

/// Damper that pulls towards a speed: torque = slope * (target - v+) within [least, most], where v+ is the joint speed at the
/// END of the step. For the impulse p = h * torque this is the row
///     A p + p / (h slope) = target - v        least h <= p <= most h
/// where A is the response of the joint to a unit impulse. The row is a constraint with cfm = 1 / (h slope). It is implicit, so
/// that no slope is too steep for any step. The joint motor of Bullet is hard up to its limit, and would need fitted gains
/// instead.
class JointRow final : public btMultiBodyConstraint {
 public:
  JointRow(btMultiBody& body, int link);

  /// Sets `slope` in N m s/rad (0: no row in this step), `target` in rad/s, `least` and `most` in N m.
  void set(double slope, double target, double least, double most);
  /// Torque in the last step, N m.
  [[nodiscard]] double torque(double h) { return slope_ > 0 ? getAppliedImpulse(0) / h : 0; }

  void createConstraintRows(btMultiBodyConstraintArray& rows, btMultiBodyJacobianData& data,
                            const btContactSolverInfo& info) override;
  void finalizeMultiDof() override { allocateJacobiansMultiDof(); }
  [[nodiscard]] int getIslandIdA() const override { return -1; }  // not used, because the world does not split islands
  [[nodiscard]] int getIslandIdB() const override { return -1; }
  void debugDraw(btIDebugDraw*) override {}

 private:
  int dof_;
  double slope_ = 0, target_ = 0, least_ = 0, most_ = 0;
};

}  // namespace gaitlab::bullet
