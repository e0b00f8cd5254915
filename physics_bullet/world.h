// Collision world and contact solver of Bullet around one robot (contact.law bullet), used inside physics_bullet only.
#pragma once
#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>
#include <BulletCollision/CollisionDispatch/btDefaultCollisionConfiguration.h>
#include <BulletCollision/CollisionShapes/btStaticPlaneShape.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>
#include <BulletDynamics/Featherstone/btMultiBodyConstraintSolver.h>
#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>

#include <memory>
#include <vector>

#include "physics_bullet/joint_row.h"
#include "physics_bullet/multibody.h"
#include "physics_bullet/shapes.h"

namespace gaitlab::bullet {

/// A btMultiBodyDynamicsWorld that solves everything as one island. (The option of Bullet not to split islands passes the wrong
/// number of multibody constraints to the solver, usually none. Splitting islands would need a collider for every link.) The
/// friction coefficient of a contact with the robot is the coefficient of the touched object, not the product of both
/// coefficients as in Bullet. The coefficient between two other objects is the smaller coefficient.
class OneIslandWorld final : public btMultiBodyDynamicsWorld {
 public:
  using btMultiBodyDynamicsWorld::btMultiBodyDynamicsWorld;
  void solveConstraints(btContactSolverInfo& info) override;
};

/// One point of a contact after a step.
struct WorldTouch {
  struct Side {
    int link = -1;     ///< link of the robot, or -1
    int element = -1;  ///< contact element, or -1
    int body = -1;     ///< body whose outline touches, or -1
    Vec3 point = Vec3::Zero();
  };
  Side a, b;
  Vec3 normal = Vec3::Zero();    ///< unit vector from b to a
  double push = 0;               ///< impulse on a along the normal, N s
  Vec3 friction = Vec3::Zero();  ///< impulse on a tangential to the surface, N s
  double distance = 0;           ///< m; negative if there is penetration
};

/// World of Bullet around one robot, with these contacts:
/// - The contact elements (points and spheres, as selected by `contact.on`) touch the plane z = 0, as with the penalty law.
/// - The outlines of the bodies touch the boxes of the ground. They touch one another if at least three joints are between
/// them, because docked bodies and bodies of one module overlap at their hinges by construction.
/// - Boxes that have a mass move, and touch one another, fixed boxes and the plane. They exist only in Bullet.
/// The caller owns position and velocity of the robot. step() reads them from the MultiBody, and leaves the new velocities
/// there.
class BulletWorld {
 public:
  BulletWorld(const PlantSettings& settings, MultiBody& body);
  ~BulletWorld();
  BulletWorld(const BulletWorld&) = delete;
  BulletWorld& operator=(const BulletWorld&) = delete;

  [[nodiscard]] JointRow& motor(std::size_t joint) { return *motors_[joint]; }
  [[nodiscard]] JointRow& stop(std::size_t joint) { return *stops_[joint]; }
  [[nodiscard]] JointRow& friction(std::size_t joint) { return *frictions_[joint]; }
  /// Advances by h seconds from the state of the MultiBody. `kinematics` must belong to that state.
  void step(const Kinematics& kinematics, double h);
  /// Motion of the boxes that have a mass.
  void boxes(std::span<BoxMotion> out) const;
  /// Calls visit(const WorldTouch&) for every contact of the last step.
  template <class Visit>
  void for_each_touch(Visit&& visit) const {
    for (int m = 0; m < dispatcher_.getNumManifolds(); ++m) {
      const btPersistentManifold& manifold = *dispatcher_.getManifoldByIndexInternal(m);
      for (int p = 0; p < manifold.getNumContacts(); ++p) visit(touch(manifold, manifold.getContactPoint(p)));
    }
  }

 private:
  /// Filter that excludes pairs of robot bodies with too few joints between them.
  class Neighbours final : public btOverlapFilterCallback {
   public:
    explicit Neighbours(const Robot& robot);
    bool needBroadphaseCollision(btBroadphaseProxy* a, btBroadphaseProxy* b) const override;

   private:
    [[nodiscard]] bool near(int i, int j) const;
    std::vector<int> parents_;  ///< parent of each link; -1 for the root
  };

  void add_robot(const Robot& robot, double friction);
  void add_ground(const Ground& ground);
  btRigidBody& add_body(double mass, btCollisionShape& shape, const Pose& pose, double friction, int group, int mask);
  static WorldTouch touch(const btPersistentManifold& manifold, const btManifoldPoint& point);

  MultiBody& body_;
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_;
  Neighbours neighbours_;
  btDbvtBroadphase broadphase_;
  btMultiBodyConstraintSolver solver_;
  std::vector<std::unique_ptr<btConvexInternalShape>> shapes_;
  std::vector<MultiBody::Compound> outlines_;
  btStaticPlaneShape plane_;
  std::vector<std::unique_ptr<btRigidBody>> ground_;
  std::vector<std::pair<std::size_t, const btRigidBody*>> moving_;  ///< moving boxes with their indices in Ground::boxes
  OneIslandWorld world_;
  std::vector<std::unique_ptr<JointRow>> motors_, stops_, frictions_;
};

}  // namespace gaitlab::bullet
