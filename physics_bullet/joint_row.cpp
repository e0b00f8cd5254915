#include "physics_bullet/joint_row.h"

#include <BulletDynamics/Featherstone/btMultiBody.h>

#include <initializer_list>

namespace gaitlab::bullet {

JointRow::JointRow(btMultiBody& body, int link)
    : btMultiBodyConstraint(&body, nullptr, link, -1, 1, false, MULTIBODY_CONSTRAINT_1DOF_JOINT_MOTOR),
      dof_(6 + body.getLink(link).m_dofOffset) {
  finalizeMultiDof();
}

void JointRow::set(double slope, double target, double least, double most) {
  slope_ = slope;
  target_ = target;
  least_ = least;
  most_ = most;
}

void JointRow::createConstraintRows(btMultiBodyConstraintArray& rows, btMultiBodyJacobianData& data,
                                    const btContactSolverInfo& info) {
  if (!(slope_ > 0)) return;
  const int dofs = m_bodyA->getNumDofs() + 6;
  btMultiBodySolverConstraint& row = rows.expandNonInitializing();
  row = btMultiBodySolverConstraint();
  // Index of the change of velocity of this body in the array of the solver. All rows of a step share this index.
  row.m_deltaVelAindex = m_bodyA->getCompanionId();
  if (row.m_deltaVelAindex < 0) {
    row.m_deltaVelAindex = data.m_deltaVelocities.size();
    m_bodyA->setCompanionId(row.m_deltaVelAindex);
    data.m_deltaVelocities.resize(row.m_deltaVelAindex + dofs, 0);
  }
  row.m_jacAindex = data.m_jacobians.size();
  data.m_jacobians.resize(row.m_jacAindex + dofs, 0);
  data.m_deltaVelocitiesUnitImpulse.resize(row.m_jacAindex + dofs, 0);
  btScalar* jacobian = &data.m_jacobians[row.m_jacAindex];
  for (int i = 0; i < dofs; ++i) jacobian[i] = i == dof_ ? 1 : 0;
  btScalar* response = &data.m_deltaVelocitiesUnitImpulse[row.m_jacAindex];
  m_bodyA->calcAccelerationDeltasMultiDof(jacobian, response, data.scratch_r, data.scratch_v);

  const btScalar softness = 1 / (info.m_timeStep * slope_);
  const btScalar effective = 1 / (response[dof_] + softness);
  row.m_jacDiagABInv = effective;
  row.m_cfm = softness * effective;
  row.m_rhs = (target_ - m_bodyA->getVelocityVector()[dof_]) * effective;
  row.m_lowerLimit = least_ * info.m_timeStep;
  row.m_upperLimit = most_ * info.m_timeStep;

  row.m_multiBodyA = m_bodyA;
  row.m_linkA = m_linkA;
  row.m_orgConstraint = this;
  row.m_orgDofIndex = 0;
  row.m_deltaVelBindex = row.m_jacBindex = -1;
  row.m_appliedImpulse = row.m_appliedPushImpulse = 0;
  row.m_friction = row.m_rhsPenetration = 0;
  row.m_originalContactPoint = nullptr;
  row.m_overrideNumSolverIterations = row.m_frictionIndex = -1;
  // These vectors are needed only for joint feedback of Bullet, which is not used.
  for (btVector3* none : {&row.m_relpos1CrossNormal, &row.m_contactNormal1, &row.m_relpos2CrossNormal, &row.m_contactNormal2,
                          &row.m_angularComponentA, &row.m_angularComponentB}) {
    none->setZero();
  }
}

}  // namespace gaitlab::bullet
