// Collision shapes of Bullet for the outline of a body, used inside physics_bullet only.
#pragma once
#include <BulletCollision/CollisionShapes/btConvexInternalShape.h>

#include <memory>

#include "core/model/module_type.h"

namespace gaitlab::bullet {

/// Half cylinder about y that bulges towards +x; Bullet does not have such a shape. It is exact except for its edges, which are
/// rounded by the margin, inside the outline. It is convex, so that any collision algorithm for convex shapes accepts it.
class HalfCylinderShape final : public btConvexInternalShape {
 public:
  HalfCylinderShape(double radius, double length);
  btVector3 localGetSupportingVertexWithoutMargin(const btVector3& direction) const override;
  void batchedUnitVectorGetSupportingVertexWithoutMargin(const btVector3* directions, btVector3* vertices,
                                                         int count) const override;
  void calculateLocalInertia(btScalar mass, btVector3& inertia) const override;
  const char* getName() const override { return "HalfCylinder"; }

 private:
  double radius_, half_length_;  ///< reduced by the margin, m
};

/// Box with edges of length `size`, m, along its own axes.
std::unique_ptr<btConvexInternalShape> make_box(const Vec3& size);
/// Collision shape for `shape`, with the axes of Shape. y is the axis of cylinders, as in Bullet.
std::unique_ptr<btConvexInternalShape> make_shape(const Shape& shape);

}  // namespace gaitlab::bullet
