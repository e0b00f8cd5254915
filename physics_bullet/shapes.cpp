#include "physics_bullet/shapes.h"

#include <BulletCollision/CollisionShapes/btBoxShape.h>
#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletCollision/CollisionShapes/btCylinderShape.h>
#include <BulletCollision/CollisionShapes/btSphereShape.h>
#include <LinearMath/btConvexHullComputer.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace gaitlab::bullet {

namespace {

// Margin of a shape, m. Bullet rounds a shape by this radius around a core that is smaller by it, so that the rounded shape
// does not exceed the outline. The default of Bullet, 40 mm, is meant for crates.
double margin_of(double half_size) { return std::min(1e-3, 0.1 * half_size); }

/// Hull whose faces are moved inwards by the margin.
std::unique_ptr<btConvexInternalShape> make_hull(const Hull& hull) {
  const auto nearest = std::ranges::min_element(hull.faces, {}, &Hull::Face::offset);
  const double margin = margin_of(nearest->offset);
  std::vector<btVector3> corners;
  for (const Vec3& corner : hull.corners) corners.emplace_back(corner.x(), corner.y(), corner.z());
  btConvexHullComputer core;
  core.compute(&corners.front().x(), sizeof(btVector3), static_cast<int>(corners.size()), margin, 0);
  auto made = std::make_unique<btConvexHullShape>();
  for (int i = 0; i < core.vertices.size(); ++i) made->addPoint(core.vertices[i], false);
  made->recalcLocalAabb();
  made->setMargin(margin);
  return made;
}

}  // namespace

HalfCylinderShape::HalfCylinderShape(double radius, double length) {
  const double margin = margin_of(std::min(radius, length) / 2);
  m_shapeType = CUSTOM_CONVEX_SHAPE_TYPE;
  setMargin(margin);
  radius_ = radius - margin;
  half_length_ = length / 2 - margin;
}

btVector3 HalfCylinderShape::localGetSupportingVertexWithoutMargin(const btVector3& d) const {
  const double flat = getMargin();  // x of the flat side of the core, so that its rounding ends at x = 0
  const double y = d.y() < 0 ? -half_length_ : half_length_;
  const double size = std::sqrt(d.x() * d.x() + d.z() * d.z());
  // The round side is the arc of radius_ with x >= flat. Beyond the ends of the arc, the corners are farthest.
  const double corner = std::sqrt(radius_ * radius_ - flat * flat);
  if (size > 0 && d.x() * radius_ >= flat * size) return {radius_ * d.x() / size, y, radius_ * d.z() / size};
  return {flat, y, d.z() < 0 ? -corner : corner};
}

void HalfCylinderShape::batchedUnitVectorGetSupportingVertexWithoutMargin(const btVector3* directions, btVector3* vertices,
                                                                          int count) const {
  for (int i = 0; i < count; ++i) vertices[i] = localGetSupportingVertexWithoutMargin(directions[i]);
}

/// The inertia of a shape is not used, because links have a separate inertia.
void HalfCylinderShape::calculateLocalInertia(btScalar /*mass*/, btVector3& inertia) const { inertia.setZero(); }

std::unique_ptr<btConvexInternalShape> make_box(const Vec3& size) {
  auto box = std::make_unique<btBoxShape>(btVector3(size.x() / 2, size.y() / 2, size.z() / 2));
  box->setMargin(margin_of(size.minCoeff() / 2));
  return box;
}

std::unique_ptr<btConvexInternalShape> make_shape(const Shape& shape) {
  const Vec3& size = shape.size;
  switch (shape.kind) {
    case Shape::Kind::box:
      return make_box(size);
    case Shape::Kind::cylinder: {
      auto cylinder = std::make_unique<btCylinderShape>(btVector3(size.x(), size.y() / 2, size.x()));
      cylinder->setMargin(margin_of(std::min(size.x(), size.y() / 2)));
      return cylinder;
    }
    case Shape::Kind::half_cylinder:
      return std::make_unique<HalfCylinderShape>(size.x(), size.y());
    case Shape::Kind::hull:
      return make_hull(*shape.hull);
    case Shape::Kind::sphere:
      break;
  }
  return std::make_unique<btSphereShape>(size.x());
}

}  // namespace gaitlab::bullet
