// One joint's soft, limited row in Bullet's constraint solver: the motor, or a hinge stop. Inside physics_bullet only.
#pragma once
#include <BulletDynamics/Featherstone/btMultiBodyConstraint.h>

namespace gaitlab::bullet {

/// Torque = slope * (target - v+), v+ the joint's speed at the END of the step, within [least, most]: a damper that pulls
/// towards a speed. As an impulse p = h * torque this is the row
///     A p + p / (h slope) = target - v        least h <= p <= most h
/// (A: the joint's response to a unit impulse), a constraint with cfm = 1 / (h slope): implicit, so that no slope is too steep
/// for any step. Bullet's own joint motor is hard up to its limit and would have to be fitted with gains instead.
class JointRow final : public btMultiBodyConstraint {
 public:
  JointRow(btMultiBody& body, int link);

  /// N m s/rad (0: no row in this step), rad/s, N m, N m.
  void set(double slope, double target, double least, double most);
  /// Torque in the last step, N m.
  [[nodiscard]] double torque(double h) { return slope_ > 0 ? getAppliedImpulse(0) / h : 0; }

  void createConstraintRows(btMultiBodyConstraintArray& rows, btMultiBodyJacobianData& data,
                            const btContactSolverInfo& info) override;
  void finalizeMultiDof() override { allocateJacobiansMultiDof(); }
  [[nodiscard]] int getIslandIdA() const override { return -1; }  // the world does not split islands
  [[nodiscard]] int getIslandIdB() const override { return -1; }
  void debugDraw(btIDebugDraw*) override {}

 private:
  int dof_;
  double slope_ = 0, target_ = 0, least_ = 0, most_ = 0;
};

}  // namespace gaitlab::bullet
