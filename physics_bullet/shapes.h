// A body's outline as Bullet's collision shapes. Inside physics_bullet only.
#pragma once
#include <BulletCollision/CollisionShapes/btConvexInternalShape.h>

#include <memory>

#include "core/model/module_type.h"

namespace gaitlab::bullet {

/// Half a cylinder about y, bulging towards +x, which Bullet lacks. Exact except for its edges, which are rounded by the
/// margin, inside the outline. Convex, so that any collision algorithm for convex shapes accepts it.
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

/// Box with edges in m, along its own axes.
std::unique_ptr<btConvexInternalShape> make_box(const Vec3& size);
/// Axes as in Shape: y is the axis of cylinders, as in Bullet.
std::unique_ptr<btConvexInternalShape> make_shape(const Shape& shape);

}  // namespace gaitlab::bullet
