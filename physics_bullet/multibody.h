// The robot as ONE btMultiBody with compound point and sphere shapes. Inside physics_bullet only: no Bullet type leaves the
// room.
#pragma once
#include <BulletCollision/CollisionShapes/btCompoundShape.h>
#include <BulletCollision/CollisionShapes/btSphereShape.h>
#include <BulletDynamics/Featherstone/btMultiBody.h>
#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>

#include <memory>
#include <vector>

#include "core/simulation/integrator.h"
#include "core/simulation/plant.h"

namespace gaitlab::bullet {

inline btVector3 bt(const Vec3& v) { return {v.x(), v.y(), v.z()}; }
inline btQuaternion bt(const Quat& q) { return {q.x(), q.y(), q.z(), q.w()}; }
inline Vec3 vec(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

/// Generalised accelerations come from Bullet's articulated-body algorithm; positions and velocities are ours to integrate, and
/// rotations come from our sine and cosine, not libm's. Every knob of btMultiBody that would act is set in the constructor.
class MultiBody {
 public:
  MultiBody(const Robot& robot, Base base, const std::vector<ContactElement>& elements);

  /// Poses and velocities into Bullet; forces cleared.
  void set(const RobotState& state, const Kinematics& kinematics);
  /// Forces for the next accelerate: world axes; joints N m.
  void add_force(std::size_t link, const Vec3& arm_from_com, const Vec3& force, const Vec3& torque = Vec3::Zero());
  void add_weight(const Vec3& gravity);
  void add_torque(std::size_t joint, double torque) { body_.addJointTorque(index_of_joint_[joint], torque); }
  void accelerate(const RobotState& state, Acceleration& out);
  /// y = M^-1 f at the state of the last accelerate (generalised vectors as in stability.h).
  void inverse_mass(In force, Out acceleration);

  /// Calls visit(element index, link, world centre, radius) for every child of every compound shape.
  template <class Visit>
  void for_each_element(const Kinematics& k, Visit&& visit) const {
    for (const Compound& compound : compounds_) {
      const Mat3 R = k.R[compound.link] * principal_[compound.link];
      const Vec3 com = k.point(compound.link, robot_.links[compound.link].com);
      for (int child = 0; child < compound.shape->getNumChildShapes(); ++child) {
        const auto* sphere = static_cast<const btSphereShape*>(compound.shape->getChildShape(child));
        visit(static_cast<std::size_t>(sphere->getUserIndex()), compound.link,
              Vec3(R * vec(compound.shape->getChildTransform(child).getOrigin()) + com), sphere->getRadius());
      }
    }
  }

 private:
  struct Compound {
    std::size_t link;
    std::unique_ptr<btCompoundShape> shape;
    std::unique_ptr<btMultiBodyLinkCollider> collider;
  };

  void set_up_root();
  void set_up_link(std::size_t link);
  void set_up_shapes(const std::vector<ContactElement>& elements);
  [[nodiscard]] int index_of(std::size_t link) const { return static_cast<int>(link) + (base_ == Base::planar ? 2 : -1); }

  const Robot& robot_;
  Base base_;
  std::vector<Mat3> principal_;  ///< axes of Bullet's link frame (principal, at the COM) in the link frame
  std::vector<Vec3> moments_;    ///< principal moments
  std::vector<Quat> at_zero_;    ///< parent's principal frame -> own, at joint angle 0, transposed as Bullet wants it
  std::vector<int> index_of_joint_;
  btMultiBody body_;
  std::vector<std::unique_ptr<btSphereShape>> spheres_;
  std::vector<Compound> compounds_;
  btAlignedObjectArray<btScalar> scratch_r_, delta_r_;
  btAlignedObjectArray<btVector3> scratch_v_, delta_v_;
  btAlignedObjectArray<btMatrix3x3> scratch_m_;
  std::vector<btScalar> force_, output_;
  Vec3 base_com_ = Vec3::Zero();  ///< base frame's origin -> COM of link 0, world axes, at the last set
};

}  // namespace gaitlab::bullet
