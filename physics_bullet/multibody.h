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

/// Computes generalised accelerations by Bullet's articulated-body algorithm; positions and velocities are integrated by
/// gaitlab, and rotations come from gaitlab's sine and cosine, not libm's. The constructor sets every option of btMultiBody
/// that would have an effect.
class MultiBody {
 public:
  MultiBody(const Robot& robot, Base base, const std::vector<ContactElement>& elements);

  /// Sets poses and velocities in Bullet; clears forces.
  void set(const RobotState& state, const Kinematics& kinematics);
  /// Adds forces for the next accelerate: world axes; joints N m.
  void add_force(std::size_t link, const Vec3& arm_from_com, const Vec3& force, const Vec3& torque = Vec3::Zero());
  void add_weight(const Vec3& gravity);
  void add_torque(std::size_t joint, double torque) { body_.addJointTorque(index_of_joint_[joint], torque); }
  /// Calls set and adds all forces of a Plant::accelerate.
  void load(const RobotState& state, const Kinematics& kinematics, const Vec3& gravity, In torque,
            std::span<const BodyWrench> wrenches);
  void accelerate(const RobotState& state, Acceleration& out);
  /// Reads Bullet's velocities h seconds after set(s); the rest of s still holds the earlier state.
  void read_velocities(RobotState& s, double h) const;
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

  /// Shapes of one link: children in Bullet's link frame.
  struct Compound {
    std::size_t link;
    std::unique_ptr<btCompoundShape> shape;
    std::unique_ptr<btMultiBodyLinkCollider> collider;
  };
  /// Shapes of the contact elements: spheres (radius 0: points) whose user index is the element's.
  [[nodiscard]] const std::vector<Compound>& compounds() const { return compounds_; }
  /// Bullet's link frame (principal axes at the COM) in the link frame, and in the world.
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
  std::vector<Mat3> principal_;  ///< axes of Bullet's link frame (principal, at the COM) in the link frame
  std::vector<Vec3> moments_;    ///< principal moments
  std::vector<Quat>
      at_zero_;  ///< rotation from the parent's principal frame to the link's, at joint angle 0, transposed as Bullet takes it
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
