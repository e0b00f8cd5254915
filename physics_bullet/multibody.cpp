#include "physics_bullet/multibody.h"

#include "core/model/principal_axes.h"

namespace gaitlab::bullet {

namespace {

int links_of(const Robot& robot, Base base) { return static_cast<int>(robot.links.size()) + (base == Base::planar ? 2 : -1); }

}  // namespace

MultiBody::MultiBody(const Robot& robot, Base base, const std::vector<ContactElement>& elements)
    : robot_(robot),
      base_(base),
      principal_(robot.links.size()),
      moments_(robot.links.size()),
      at_zero_(robot.links.size(), Quat::Identity()),
      index_of_joint_(robot.joints.size()),
      body_(links_of(robot, base), base == Base::floating ? robot.links[0].mass : 0.0,
            // Replaced below by the principal moments, which are computed after the constructor of body_.
            btVector3(0, 0, 0), base != Base::floating, /*canSleep=*/false),
      force_(6 + static_cast<std::size_t>(links_of(robot, base))),
      output_(force_.size()) {
  // The links of Bullet move about their COM with a diagonal inertia, that is, in the principal frame.
  for (std::size_t i = 0; i < robot.links.size(); ++i) principal_[i] = principal_axes(robot.links[i].inertia, moments_[i]);
  set_up_root();
  for (std::size_t i = 1; i < robot.links.size(); ++i) set_up_link(i);
  body_.finalizeMultiDof();
  body_.setLinearDamping(0);  // default 0.04: loses 8-10 % of the momentum per second
  body_.setAngularDamping(0);
  body_.setMaxCoordinateVelocity(1e30);  // default 100: clamps every generalised velocity
  body_.setMaxAppliedImpulse(1e30);
  body_.setUseGyroTerm(true);
  body_.setCanSleep(false);
  body_.setHasSelfCollision(false);
  body_.useRK4Integration(false);  // the RK4 of Bullet has order 1 for a floating base
  body_.useGlobalVelocities(false);
  set_up_shapes(elements);
}

void MultiBody::set_up_root() {
  if (base_ != Base::planar) {
    body_.setBaseInertia(bt(moments_[0]));
    return;
  }
  // A planar base is a chain of links for x, z and the rotation about y. The last of these is the root link.
  const btVector3 none(0, 0, 0);
  body_.setBaseInertia(none);
  body_.setupPrismatic(0, 0, none, -1, btQuaternion::getIdentity(), btVector3(1, 0, 0), none, none, true);
  body_.setupPrismatic(1, 0, none, 0, btQuaternion::getIdentity(), btVector3(0, 0, 1), none, none, true);
  body_.setupRevolute(2, robot_.links[0].mass, bt(moments_[0]), 1, btQuaternion::getIdentity(), btVector3(0, 1, 0), none,
                      bt(principal_[0].transpose() * robot_.links[0].com), true);
}

void MultiBody::set_up_link(std::size_t i) {
  const Link& link = robot_.links[i];
  const auto parent = static_cast<std::size_t>(link.parent);
  index_of_joint_[static_cast<std::size_t>(link.joint)] = index_of(i);
  const Mat3 to_parent = principal_[parent].transpose() * link.in_parent.R * principal_[i];
  at_zero_[i] = Quat(Mat3(to_parent.transpose()));
  body_.setupRevolute(index_of(i), link.mass, bt(moments_[i]), index_of(parent), bt(at_zero_[i]),
                      bt(principal_[i].transpose() * link.axis),
                      bt(principal_[parent].transpose() * (link.in_parent.p - robot_.links[parent].com)),
                      bt(principal_[i].transpose() * link.com), true);
}

void MultiBody::set_up_shapes(const std::vector<ContactElement>& elements) {
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const ContactElement& element = elements[i];
    if (compounds_.empty() || compounds_.back().link != element.link) {
      const auto known =
          std::find_if(compounds_.begin(), compounds_.end(), [&](const Compound& c) { return c.link == element.link; });
      if (known == compounds_.end()) {
        compounds_.push_back({element.link, std::make_unique<btCompoundShape>(),
                              std::make_unique<btMultiBodyLinkCollider>(&body_, index_of(element.link))});
      } else {
        std::rotate(known, known + 1, compounds_.end());
      }
    }
    spheres_.push_back(std::make_unique<btSphereShape>(element.radius));
    spheres_.back()->setUserIndex(static_cast<int>(i));
    const Vec3 centre = principal_[element.link].transpose() * (element.centre - robot_.links[element.link].com);
    compounds_.back().shape->addChildShape(btTransform(btQuaternion::getIdentity(), bt(centre)), spheres_.back().get());
  }
  for (const Compound& compound : compounds_) {
    compound.collider->setCollisionShape(compound.shape.get());
    const int index = index_of(compound.link);
    if (index < 0) {
      body_.setBaseCollider(compound.collider.get());
    } else {
      body_.getLink(index).m_collider = compound.collider.get();
    }
  }
}

void MultiBody::set(const RobotState& s, const Kinematics& k) {
  base_com_ = k.R[0] * robot_.links[0].com;
  const Quat to_world = s.orientation * Quat(principal_[0]);
  const Quat to_base = to_world.conjugate();
  if (base_ == Base::planar) {
    const Vec3 axis = to_base * Vec3::UnitY();
    btMultibodyLink& root = body_.getLink(2);
    root.setAxisTop(0, bt(axis));
    root.setAxisBottom(0, bt(axis).cross(root.m_dVector));
    root.m_cachedRotParentToThis = bt(to_base);
    root.m_cachedRVector = root.m_dVector;
    body_.setBasePos(btVector3(0, s.position.y(), 0));
    for (const auto& [index, position, velocity] :
         {std::tuple(0, s.position.x(), s.velocity.x()), std::tuple(1, s.position.z(), s.velocity.z())}) {
      btMultibodyLink& slide = body_.getLink(index);
      slide.m_jointPos[0] = position;
      slide.m_cachedRVector = position * slide.getAxisBottom(0);
      body_.setJointVel(index, velocity);
    }
    body_.setJointVel(2, s.angular_velocity.y());
  } else {
    body_.setBasePos(bt(s.position + base_com_));
    body_.setWorldToBaseRot(bt(to_base));
    body_.setBaseOmega(bt(s.angular_velocity));
    body_.setBaseVel(bt(s.velocity + s.angular_velocity.cross(base_com_)));
  }
  for (std::size_t i = 1; i < robot_.links.size(); ++i) {
    const auto joint = static_cast<std::size_t>(robot_.links[i].joint);
    btMultibodyLink& link = body_.getLink(index_of(i));
    // The same as updateCacheMultiDof, except that the rotation is taken from Kinematics, with the sine and cosine of gaitlab.
    const Quat& t = k.turns[i];
    const Vec3 v = principal_[i].transpose() * t.vec();
    link.m_jointPos[0] = s.q[joint];
    link.m_cachedRotParentToThis = bt(Quat(t.w(), -v.x(), -v.y(), -v.z()) * at_zero_[i]);
    link.m_cachedRVector = link.m_dVector + quatRotate(link.m_cachedRotParentToThis, link.m_eVector);
    body_.setJointVel(index_of(i), s.qd[joint]);
  }
  body_.clearForcesAndTorques();
}

void MultiBody::add_force(std::size_t link, const Vec3& arm_from_com, const Vec3& force, const Vec3& torque) {
  const int index = index_of(link);
  const btVector3 moment = bt(arm_from_com.cross(force) + torque);
  if (index < 0) {
    body_.addBaseForce(bt(force));
    body_.addBaseTorque(moment);
  } else {
    body_.addLinkForce(index, bt(force));
    body_.addLinkTorque(index, moment);
  }
}

void MultiBody::add_weight(const Vec3& gravity) {
  for (std::size_t i = 0; i < robot_.links.size(); ++i) add_force(i, Vec3::Zero(), robot_.links[i].mass * gravity);
}

void MultiBody::load(const RobotState& s, const Kinematics& k, const Vec3& gravity, In torque,
                     std::span<const BodyWrench> wrenches) {
  set(s, k);
  add_weight(gravity);
  for (const BodyWrench& w : wrenches) {
    const std::size_t link = robot_.bodies[w.body].link;
    add_force(link, w.point - k.point(link, robot_.links[link].com), w.force, w.torque);
  }
  for (std::size_t j = 0; j < torque.size(); ++j) add_torque(j, torque[j]);
}

void MultiBody::read_velocities(RobotState& s, double h) const {
  if (base_ == Base::planar) {
    s.velocity = Vec3(body_.getJointVel(0), 0, body_.getJointVel(1));
    s.angular_velocity = Vec3(0, body_.getJointVel(2), 0);
  } else if (base_ == Base::floating) {
    // v + h v' of the origin of the base frame. Bullet computes v' of the COM, without the last term.
    const Vec3 before = s.angular_velocity;
    s.angular_velocity = vec(body_.getBaseOmega());
    s.velocity = vec(body_.getBaseVel()) - s.angular_velocity.cross(base_com_) - h * before.cross(before.cross(base_com_));
  }
  for (std::size_t j = 0; j < s.qd.size(); ++j) s.qd[j] = body_.getJointVel(index_of_joint_[j]);
}

void MultiBody::accelerate(const RobotState& s, Acceleration& out) {
  body_.computeAccelerationsArticulatedBodyAlgorithmMultiDof(0, scratch_r_, scratch_v_, scratch_m_, false, false, false);
  const btScalar* result = &scratch_r_[body_.getNumDofs()];  // base omega' and COM v' in world axes, then joints
  const int shift = base_ == Base::planar ? 3 : 0;
  if (base_ == Base::planar) {
    out.angular = Vec3(0, result[8], 0);
    out.linear = Vec3(result[6], 0, result[7]);
  } else if (base_ == Base::fixed) {
    out.angular = out.linear = Vec3::Zero();
  } else {
    const Vec3& w = s.angular_velocity;
    out.angular = Vec3(result[0], result[1], result[2]);
    out.linear = Vec3(result[3], result[4], result[5]) - out.angular.cross(base_com_) - w.cross(w.cross(base_com_));
  }
  for (std::size_t i = 1; i < robot_.links.size(); ++i) {
    out.joints[static_cast<std::size_t>(robot_.links[i].joint)] = result[6 + shift + static_cast<int>(i) - 1];
  }
}

void MultiBody::inverse_mass(In f, Out y) {
  const std::size_t shift = base_ == Base::planar ? 3 : 0;
  const Vec3 force(f[0], f[1], f[2]);
  const Vec3 moment(f[3], f[4], f[5]);
  std::fill(force_.begin(), force_.end(), 0.0);
  if (base_ == Base::planar) {
    force_[6] = force.x();
    force_[7] = force.z();
    force_[8] = moment.y();
  } else if (base_ == Base::floating) {
    const Vec3 about_com = moment - base_com_.cross(force);
    for (std::size_t a = 0; a < 3; ++a) {
      force_[a] = about_com[static_cast<Eigen::Index>(a)];
      force_[3 + a] = force[static_cast<Eigen::Index>(a)];
    }
  }
  for (std::size_t i = 1; i < robot_.links.size(); ++i) {
    force_[6 + shift + i - 1] = f[6 + static_cast<std::size_t>(robot_.links[i].joint)];
  }
  body_.calcAccelerationDeltasMultiDof(force_.data(), output_.data(), delta_r_, delta_v_);
  std::fill(y.begin(), y.begin() + 6, 0.0);
  if (base_ == Base::planar) {
    y[0] = output_[6];
    y[2] = output_[7];
    y[4] = output_[8];
  } else if (base_ == Base::floating) {
    const Vec3 angular(output_[0], output_[1], output_[2]);
    const Vec3 linear = Vec3(output_[3], output_[4], output_[5]) - angular.cross(base_com_);
    for (std::size_t a = 0; a < 3; ++a) {
      y[a] = linear[static_cast<Eigen::Index>(a)];
      y[3 + a] = angular[static_cast<Eigen::Index>(a)];
    }
  }
  for (std::size_t i = 1; i < robot_.links.size(); ++i) {
    y[6 + static_cast<std::size_t>(robot_.links[i].joint)] = output_[6 + shift + i - 1];
  }
}

}  // namespace gaitlab::bullet
