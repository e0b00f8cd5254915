// Robot as ONE btMultiBody with compound point and sphere shapes, inside physics_bullet only, because no other room may use
// types of Bullet.
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

/// Computes generalised accelerations by the articulated-body algorithm of Bullet. gaitlab integrates positions and velocities.
/// Rotations are computed with the sine and cosine of gaitlab, not of libm. The constructor sets every option of btMultiBody
/// that would have an effect.
class MultiBody {
 public:
  MultiBody(const Robot& robot, Base base, const std::vector<ContactElement>& elements);

  /// Sets poses and velocities in Bullet; clears forces.
  void set(const RobotState& state, const Kinematics& kinematics);
  /// Adds forces for the next accelerate(), in world axes. Joint torques are in N m.
  void add_force(std::size_t link, const Vec3& arm_from_com, const Vec3& force, const Vec3& torque = Vec3::Zero());
  void add_weight(const Vec3& gravity);
  void add_torque(std::size_t joint, double torque) { body_.addJointTorque(index_of_joint_[joint], torque); }
  /// Calls set() and adds all forces of a Plant::accelerate.
  void load(const RobotState& state, const Kinematics& kinematics, const Vec3& gravity, In torque,
            std::span<const BodyWrench> wrenches);
  void accelerate(const RobotState& state, Acceleration& out);
  /// Reads the velocities of Bullet into s, h seconds after set(s). The rest of s is unchanged since set(s).
  void read_velocities(RobotState& s, double h) const;
  /// Computes y = M^-1 f at the state of the last accelerate() (generalised vectors as in stability.h).
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

  /// Shapes of one link, with child shapes in the link frame of Bullet.
  struct Compound {
    std::size_t link;
    std::unique_ptr<btCompoundShape> shape;
    std::unique_ptr<btMultiBodyLinkCollider> collider;
  };
  /// Shapes of the contact elements: spheres whose user index is the index of the element. The radius of a point is 0.
  [[nodiscard]] const std::vector<Compound>& compounds() const { return compounds_; }
  /// Link frame of Bullet (principal axes at the COM) in the link frame of gaitlab, and in the world.
  [[nodiscard]] Pose frame(std::size_t link) const { return {principal_[link], robot_.links[link].com}; }
  [[nodiscard]] Pose frame(std::size_t link, const Kinematics& k) const {
    return {k.R[link] * principal_[link], k.point(link, robot_.links[link].com)};
  }
  [[nodiscard]] btMultiBody& bullet() { return body_; }
  [[nodiscard]] int index_of(std::size_t link) const { return static_cast<int>(link) + (base_ == Base::planar ? 2 : -1); }
  [[nodiscard]] int index_of_joint(std::size_t joint) const { return index_of_joint_[joint]; }

 private:
  void set_up_root();
  void set_up_link(std::size_t link);
  void set_up_shapes(const std::vector<ContactElement>& elements);

  const Robot& robot_;
  Base base_;
  std::vector<Mat3> principal_;  ///< axes of the link frame of Bullet (principal, at the COM) in the link frame
  std::vector<Vec3> moments_;    ///< principal moments
  std::vector<Quat>
      at_zero_;  ///< rotation from the principal frame of the parent to that of the link at angle 0, transposed for Bullet
  std::vector<int> index_of_joint_;
  btMultiBody body_;
  std::vector<std::unique_ptr<btSphereShape>> spheres_;
  std::vector<Compound> compounds_;
  btAlignedObjectArray<btScalar> scratch_r_, delta_r_;
  btAlignedObjectArray<btVector3> scratch_v_, delta_v_;
  btAlignedObjectArray<btMatrix3x3> scratch_m_;
  std::vector<btScalar> force_, output_;
  Vec3 base_com_ = Vec3::Zero();  ///< from the origin of the base frame to the COM of link 0, world axes, at the last set()
};

}  // namespace gaitlab::bullet
