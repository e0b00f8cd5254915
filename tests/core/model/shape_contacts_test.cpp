// Contact elements of shapes: the points of every kind, hidden ones left out, wheels.
#include "core/model/shape_contacts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

namespace gaitlab {
namespace {

constexpr double kSame = 1e-12;

ModuleType one_body(std::vector<Shape> shapes) {
  ModuleType type;
  type.bodies = {{"b"}};
  type.bodies[0].shapes = std::move(shapes);
  return type;
}

std::size_t count_at(const std::vector<ContactType>& found, const Vec3& place) {
  std::size_t n = 0;
  for (const ContactType& one : found) n += (one.centre - place).norm() < kSame ? 1 : 0;
  return n;
}

TEST(ShapeContacts, OfABoxAreItsVertices) {
  const auto found = shape_contacts(one_body({{Shape::Kind::box, {Mat3::Identity(), {1, 0, 0}}, {2, 4, 6}}}));
  ASSERT_EQ(found.size(), 8U);
  for (const double x : {0.0, 2.0}) {
    for (const double y : {-2.0, 2.0}) {
      for (const double z : {-3.0, 3.0}) EXPECT_EQ(count_at(found, {x, y, z}), 1U) << x << y << z;
    }
  }
  for (const ContactType& one : found) EXPECT_EQ(one.radius, 0);
}

TEST(ShapeContacts, OfASphereIsItself) {
  const auto found = shape_contacts(one_body({{Shape::Kind::sphere, {Mat3::Identity(), {1, 2, 3}}, {0.5, 0, 0}}}));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].radius, 0.5);
  EXPECT_EQ(found[0].centre, Vec3(1, 2, 3));
}

TEST(ShapeContacts, OfACylinderAreEightPointsARim) {
  const auto found = shape_contacts(one_body({{Shape::Kind::cylinder, {}, {1, 4, 0}}}));
  ASSERT_EQ(found.size(), 16U);
  const double half = std::numbers::sqrt2 / 2;
  for (const double y : {-2.0, 2.0}) {
    for (const Vec3& p : {Vec3(1, y, 0), Vec3(-1, y, 0), Vec3(0, y, 1), Vec3(half, y, -half), Vec3(-half, y, half)})
      EXPECT_EQ(count_at(found, p), 1U) << p;
  }
}

TEST(ShapeContacts, OfAHalfCylinderAreEdgesAndArcs) {
  const auto found = shape_contacts(one_body({{Shape::Kind::half_cylinder, {}, {1, 4, 0}}}));
  ASSERT_EQ(found.size(), 10U);
  const double half = std::numbers::sqrt2 / 2;
  for (const double y : {-2.0, 2.0}) {
    for (const Vec3& p : {Vec3(0, y, 1), Vec3(0, y, -1), Vec3(1, y, 0), Vec3(half, y, half), Vec3(half, y, -half)})
      EXPECT_EQ(count_at(found, p), 1U) << p;
  }
}

TEST(ShapeContacts, LeaveOutWhatIsHidden) {
  const Shape box{Shape::Kind::box, {Mat3::Identity(), {-1, 0, 0}}, {2, 2, 2}};
  // The half cylinder touches the box. Its four edge ends coincide with vertices of the box and occur only once.
  const auto block = shape_contacts(one_body({box, {Shape::Kind::half_cylinder, {}, {1, 2, 0}}}));
  EXPECT_EQ(block.size(), 8U + 6U);
  EXPECT_EQ(count_at(block, {0, 1, 1}), 1U);
  // A box that is half inside another box has four vertices outside.
  const auto boxes = shape_contacts(one_body({box, {Shape::Kind::box, {}, {1, 1, 1}}}));
  EXPECT_EQ(boxes.size(), 12U);
  EXPECT_EQ(count_at(boxes, {-0.5, 0.5, 0.5}), 0U);
  EXPECT_EQ(shape_contacts(one_body({box, box})).size(), 8U);
  // A capsule stands on its spheres, because the rims of the cylinder lie on them.
  const Shape rod{Shape::Kind::cylinder, {}, {1, 4, 0}};
  const Shape top{Shape::Kind::sphere, {Mat3::Identity(), {0, 2, 0}}, {1, 0, 0}};
  const Shape bottom{Shape::Kind::sphere, {Mat3::Identity(), {0, -2, 0}}, {1, 0, 0}};
  const auto capsule = shape_contacts(one_body({rod, top, bottom}));
  ASSERT_EQ(capsule.size(), 2U);
  EXPECT_EQ(capsule[0].radius, 1);
  // A sphere within a box touches nothing.
  EXPECT_EQ(shape_contacts(one_body({box, {Shape::Kind::sphere, {Mat3::Identity(), {-1, 0, 0}}, {0.9, 0, 0}}})).size(), 8U);
}

/// A chassis with a wheel, whose cylinder is at `offset` from a hinge along y.
ModuleType cart(const Vec3& offset, double hi) {
  ModuleType type;
  type.bodies = {{"chassis"}, {"wheel"}};
  type.bodies[0].shapes = {{Shape::Kind::box, {}, {1, 1, 1}}};
  type.bodies[1].shapes = {{Shape::Kind::cylinder, {Mat3::Identity(), offset}, {0.5, 0.2, 0}}};
  type.hinges = {{"axle", 0, 1, {Mat3::Identity(), {0, 1, 0}}, Vec3::UnitY(), -hi, hi, {}}};
  return type;
}

/// A box with a half cylinder on its face has the four common edge ends once, for any number of digits of pi in the frame.
TEST(ShapeContacts, OfOneEdgeInTwoShapesAreOnce) {
  for (const double half_turn : {std::numbers::pi, 3.141592653, 3.1415927, 3.1415926, 3.14159, 3.1416, 3.142, 3.14}) {
    const Mat3 turned = Eigen::AngleAxisd(half_turn, Vec3::UnitZ()).toRotationMatrix();
    const auto found = shape_contacts(one_body({{Shape::Kind::box, {Mat3::Identity(), {0.021, 0, 0}}, {0.042, 0.084, 0.084}},
                                                {Shape::Kind::half_cylinder, {turned, Vec3::Zero()}, {0.042, 0.084, 0}}}));
    EXPECT_EQ(found.size(), 14U) << half_turn;
    for (const double side : {-1.0, 1.0}) {
      const auto on_side = [&](const ContactType& one) { return one.centre.y() * side > 0; };
      EXPECT_EQ(std::count_if(found.begin(), found.end(), on_side), 7) << half_turn;
    }
  }
}

TEST(ShapeContacts, OfAWheelAreASphere) {
  const auto wheel = shape_contacts(cart({0, 0.3, 0}, kNoStop));
  ASSERT_EQ(wheel.size(), 9U);
  EXPECT_EQ(wheel[8].radius, 0.5);
  EXPECT_EQ(wheel[8].body, 1U);
  EXPECT_EQ(wheel[8].centre, Vec3(0, 0.3, 0));
  EXPECT_EQ(shape_contacts(cart({0, 0.3, 0}, 1.5)).size(), 8U + 16U) << "the hinge has a stop";
  EXPECT_EQ(shape_contacts(cart({0.1, 0, 0}, kNoStop)).size(), 8U + 16U) << "beside the axis";
  ModuleType turned = cart({0, 0, 0}, kNoStop);
  turned.hinges[0].axis = Vec3::UnitX();
  EXPECT_EQ(shape_contacts(turned).size(), 8U + 16U) << "across the axis";
}

/// A module may dock by its wheel, which then is the parent of the hinge.
TEST(ShapeContacts, OfAWheelThatIsTheRoot) {
  ModuleType type = cart({0, 0, 0}, kNoStop);
  std::swap(type.bodies[0].shapes, type.bodies[1].shapes);
  type.bodies[0].shapes[0].in_body.p = {0, 0.9, 0};
  EXPECT_EQ(shape_contacts(type).size(), 9U);
  type.bodies.push_back({"tool"});
  type.hinges.push_back({"second", 0, 2, {}, Vec3::UnitX(), -1, 1, {}});
  EXPECT_EQ(shape_contacts(type).size(), 16U + 8U) << "a body with further hinges is no wheel";
}

}  // namespace
}  // namespace gaitlab
