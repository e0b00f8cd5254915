// Ground queries agree with closed forms and with the nearest of sampled points.
#include "core/laws/ground.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace gaitlab {
namespace {

Box box(const Vec3& center, const Vec3& size, const Vec3& turn = Vec3::Zero(), double friction = 0.8) {
  return {center, size, turn, friction, 0, rpy(turn)};
}

Ground boxes(std::vector<Box> list) {
  Ground ground;
  ground.shape = Boxes(std::move(list));
  return ground;
}

/// Centre and size of a box in the air, far above the plane, m.
const Vec3 kMiddle(0.2, -0.1, 5);
const Vec3 kSize(0.4, 0.2, 0.1);

constexpr double kGroundRounding = 1e-12;  // m; more than the rounding errors of some sums of numbers up to 5

void expect_touch(const Ground::Touch& touch, double penetration, const Vec3& normal) {
  EXPECT_NEAR(touch.penetration, penetration, kGroundRounding);
  EXPECT_LT((touch.normal - normal).norm(), kGroundRounding / 1e-3) << touch.normal.transpose();  // divided by least distance
}

TEST(GroundBox, IsANearestPointOutside) {
  const Ground ground = boxes({box(kMiddle, kSize)});
  const Vec3 top = kMiddle + Vec3(0.1, 0.05, 0.05);
  expect_touch(ground.query(top + Vec3(0, 0, 0.01), 0.03), 0.02, Vec3::UnitZ());  // contact with a face
  expect_touch(ground.query(top + Vec3(0, 0, 0.04), 0.03), -0.01, Vec3::UnitZ());
  const Vec3 edge = kMiddle + Vec3(0.2, 0.05, 0.05);
  expect_touch(ground.query(edge + Vec3(0.003, 0, 0.004), 0.03), 0.025, Vec3(0.6, 0, 0.8));  // contact with an edge
  const Vec3 corner = kMiddle + Vec3(-0.2, 0.1, -0.05);
  expect_touch(ground.query(corner + Vec3(-0.001, 0.002, -0.002), 0.01), 0.007, Vec3(-1, 2, -2) / 3);  // contact with a corner
  const Ground::Touch touch = ground.query(edge + Vec3(0.003, 0, 0.004), 0.03);
  EXPECT_LT((touch.point - (edge + Vec3(0.003, 0, 0.004) - 0.03 * touch.normal)).norm(), kGroundRounding);
}

TEST(GroundBox, IsTheFaceOfLeastDepthInside) {
  const Ground ground = boxes({box(kMiddle, kSize, Vec3::Zero(), 0.3)});
  expect_touch(ground.query(kMiddle + Vec3(0.1, 0.05, 0.049), 0), 0.001, Vec3::UnitZ());
  expect_touch(ground.query(kMiddle + Vec3(-0.199, 0.05, 0.04), 0), 0.001, -Vec3::UnitX());
  expect_touch(ground.query(kMiddle + Vec3(0.1, 0.098, 0.04), 0.01), 0.012, Vec3::UnitY());
  EXPECT_EQ(ground.query(kMiddle + Vec3(0.1, 0.05, 0.049), 0).friction, 0.3);
}

/// Distance to the nearest of many points on the surface of a box, n by n per face. The error is at most size / n.
double sampled_distance(const Box& b, const Vec3& place, int n) {
  double least = 1e9;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {-0.5, 0.5}) {
      for (int i = 0; i <= n; ++i) {
        for (int j = 0; j <= n; ++j) {
          Vec3 local;
          local[axis] = sign * b.size[axis];
          local[(axis + 1) % 3] = (static_cast<double>(i) / n - 0.5) * b.size[(axis + 1) % 3];
          local[(axis + 2) % 3] = (static_cast<double>(j) / n - 0.5) * b.size[(axis + 2) % 3];
          least = std::min(least, (b.R * local + b.center - place).norm());
        }
      }
    }
  }
  return least;
}

TEST(GroundBox, TurnedAgreesWithSampledSurfaces) {
  std::mt19937 engine(5);
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto vector = [&](double size) { return Vec3(size * unit(engine), size * unit(engine), size * unit(engine)); };
  int inside = 0;
  for (int i = 0; i < 100; ++i) {
    const Box b = box(Vec3(0, 0, 5) + vector(0.1), Vec3(0.25, 0.25, 0.25) + vector(0.15), vector(3));
    const Vec3 place = b.center + vector(0.2);
    const double found = boxes({b}).query(place, 0).penetration;
    const double sampled = sampled_distance(b, place, 60);
    const bool in = ((b.R.transpose() * (place - b.center)).cwiseAbs() - 0.5 * b.size).maxCoeff() < 0;
    inside += in ? 1 : 0;
    EXPECT_EQ(found > 0, in);
    EXPECT_LE(std::abs(found), sampled + kGroundRounding);
    EXPECT_GE(std::abs(found), sampled - 0.4 / 60);  // the error is at most half a diagonal of the grid, 0.7 * 0.4 / 60
  }
  EXPECT_GT(inside, 10);
  EXPECT_LT(inside, 90);
}

// A common motion of point and box changes neither the distance nor the normal in the frame of the box.
TEST(GroundBox, TurnsAndMovesWithItsBox) {
  const Box still = box({0, 0, 5}, kSize);
  const Vec3 turn(0.3, -1.1, 2.0);
  const Box moved = box({3, -2, 7}, kSize, turn);
  for (const Vec3& place : {Vec3(0.1, 0.02, 0.049), Vec3(0.21, 0.03, 0.01), Vec3(0.22, -0.12, 0.06), Vec3(-0.199, 0, 0)}) {
    for (const double radius : {0.0, 0.03}) {
      const Ground::Touch a = boxes({still}).query(still.center + place, radius);
      const Ground::Touch b = boxes({moved}).query(moved.center + moved.R * place, radius);
      expect_touch(b, a.penetration, moved.R * a.normal);
    }
  }
}

TEST(GroundBoxes, StandOnThePlane) {
  const Ground ground = boxes({box({0, 0, 0.005}, {0.1, 0.1, 0.01})});
  expect_touch(ground.query(Vec3(1, 1, -0.002), 0), 0.002, Vec3::UnitZ());
  expect_touch(ground.query(Vec3(1, 1, 0.5), 0.1), -0.4, Vec3::UnitZ());
  expect_touch(ground.query(Vec3(0.02, 0.01, 0.0098), 0), 0.0002, Vec3::UnitZ());
  // The element is closer to the lower face of the box, but the way through this face leads into the ground.
  expect_touch(ground.query(Vec3(0.02, 0.01, 0.001), 0), 0.009, Vec3::UnitZ());
  expect_touch(boxes({box({0, 0, 0.0001}, {0.1, 0.1, 0.0002})}).query(Vec3(0, 0, 0.00005), 0), 0.00015, Vec3::UnitZ());
}

// Tiles of equal height are a plane for a sliding foot, at all positions of seams, with or without overlap of the tiles.
TEST(GroundBoxes, HaveNoSeamsWhereTheyStandFlush) {
  for (const double overlap : {0.0, 0.002}) {
    std::vector<Box> tiles;
    for (int i = 0; i < 4; ++i) {
      for (int j = 0; j < 2; ++j) {
        tiles.push_back(box({0.1 * i, 0.1 * j, 0.01}, {0.1 + overlap, 0.1 + overlap, 0.02}));
      }
    }
    const Ground ground = boxes(tiles);
    for (const double radius : {0.0, 0.03}) {
      for (int i = 0; i <= 3000; ++i) {
        const Vec3 deepest(0.0001 * i, 0.05 + 1e-5 * (i - 1500), 0.0197);
        const Ground::Touch touch = ground.query(deepest + radius * Vec3::UnitZ(), radius);
        expect_touch(touch, 0.0003, Vec3::UnitZ());
      }
    }
  }
}

// The contact force of a floor and a wall is the vector sum of both springs.
TEST(GroundBoxes, AddWhatAnElementTouches) {
  const Ground ground = boxes({box({0.05, 0, 0.05}, {0.1, 0.1, 0.1})});
  expect_touch(ground.query(Vec3(0.0003, 0, -0.0004), 0), 0.0005, Vec3(-0.6, 0, 0.8));
  expect_touch(ground.query(Vec3(-0.01 + 0.0003, 0, 0.01 - 0.0004), 0.01), 0.0005, Vec3(-0.6, 0, 0.8));
  // Two coinciding surfaces carry like one surface.
  expect_touch(boxes({box({0, 0, -0.1}, {1, 1, 0.2})}).query(Vec3(0.1, 0.1, -0.0003), 0), 0.0003, Vec3::UnitZ());
  Ground slippery = boxes({box({0.05, 0, 0.05}, {0.1, 0.1, 0.1}, Vec3::Zero(), 0.1)});
  slippery.friction = 0.5;
  EXPECT_NEAR(slippery.query(Vec3(0.0003, 0, -0.0004), 0).friction, (3 * 0.1 + 4 * 0.5) / 7, kGroundRounding);
}

// The force of a linear spring, proportional to penetration * normal, is continuous. The only exception is inside a box, at
// points with two equally short ways out.
TEST(GroundBoxes, PushContinuously) {
  const Ground ground =
      boxes({box({0.05, 0, 0.02}, {0.1, 0.4, 0.04}), box({-0.15, 0, 0.01}, {0.2, 0.2, 0.05}, {0.1, 0.3, 0.2})});
  const auto push = [&](const Vec3& centre) -> Vec3 {
    const Ground::Touch touch = ground.query(centre, 0.02);
    return std::max(0.0, touch.penetration) * touch.normal;
  };
  const double step = 1e-5;
  double most = 0;
  int several = 0;
  for (int level = 0; level < 23; ++level) {
    const double height = 0.0195 + 0.0031 * level;
    for (int i = 0; i < 50000; ++i) {
      const Vec3 a(-0.35 + i * step, 0.01, height);
      const Vec3 b = a + Vec3(step, 0, 0);
      if (ground.query(a, 0.02).penetration > 0.01) continue;  // near the centre of a box the normal turns arbitrarily fast
      most = std::max(most, (push(b) - push(a)).norm() / step);
      const Vec3 normal = ground.query(a, 0.02).normal;
      several += ground.query(a, 0.02).penetration > 0 && normal.z() > 0.05 && normal.z() < 0.95 ? 1 : 0;
    }
  }
  EXPECT_GT(several, 1000);  // edges, corners and two boxes at once are touched
  EXPECT_GT(most, 0.5);
  EXPECT_LT(most,
            10);  // one box changes the force by the length of the step, two boxes at 60 degrees by four times this
}

Ground field(std::size_t columns, std::vector<double> values, double spacing = 0.1) {
  Ground ground;
  ground.shape = Heightfield{{-0.2, 0.1, 0.05}, spacing, columns, std::move(values)};
  return ground;
}

TEST(GroundField, OfAPlaneIsThePlane) {
  const Vec3 normal = Vec3(-0.2, 0.3, 1).normalized();
  std::vector<double> values;
  for (int i = 0; i < 5; ++i) {
    for (int j = 0; j < 4; ++j) values.push_back(0.2 * 0.1 * j - 0.3 * 0.1 * i);
  }
  const Ground ground = field(4, values);
  for (const double x : {-0.2, -0.15, -0.003, 0.05, 0.1}) {
    for (const double y : {0.1, 0.13, 0.3, 0.45, 0.5}) {
      const Vec3 on(x, y, 0.05 + 0.2 * (x + 0.2) - 0.3 * (y - 0.1));
      if (x < -0.19 || y < 0.11 || x > 0.09 || y > 0.49) {
        EXPECT_NEAR(ground.relief()->at(x, y).z, on.z(),
                    kGroundRounding);  // near the edge of the field the normal differs
        continue;
      }
      expect_touch(ground.query(on - 0.001 * normal, 0), 0.001, normal);
      if (y < 0.4) expect_touch(ground.query(on + 0.025 * normal, 0.03), 0.005, normal);
    }
  }
}

TEST(GroundField, PassesThroughItsHeightsAndGoesOnOutside) {
  const Heightfield f = *field(3, {0, 1, 2, 5, 3, 1, 0, 0, 2}).relief();
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      EXPECT_NEAR(f.at(-0.2 + 0.1 * static_cast<double>(j), 0.1 + 0.1 * static_cast<double>(i)).z, 0.05 + f.values[3 * i + j],
                  kGroundRounding);
    }
  }
  EXPECT_NEAR(f.at(-7, 0.2).z, 5.05, kGroundRounding);
  EXPECT_NEAR(f.at(-7, 0.2).normal.x(), 0, kGroundRounding);
  EXPECT_NEAR(f.at(3, 9).z, 2.05, kGroundRounding);
}

// The normal of a contact is the normal of the heightfield's surface, and is continuous across the edges of cells.
TEST(GroundField, NormalIsTheSlopeOfTheSurface) {
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> unit(-0.02, 0.02);
  std::vector<double> values(36);
  for (double& v : values) v = unit(engine);
  const Heightfield f = *field(6, values).relief();
  const double e = 1e-6;  // m; errors of a central difference are e^2 z''' = 1e-12 * 100 and 1e-17 / e
  for (int i = 0; i < 400; ++i) {
    const double x = -0.2 + e + 0.4999 * (i % 20) / 20;
    const int row = i / 20;
    const double y = 0.1 + e + 0.4999 * row / 20;
    const Vec3 slope(-(f.at(x + e, y).z - f.at(x - e, y).z) / (2 * e), -(f.at(x, y + e).z - f.at(x, y - e).z) / (2 * e), 1);
    EXPECT_LT((f.at(x, y).normal - slope.normalized()).norm(), 1e-8);
  }
  for (int cell = 1; cell < 5; ++cell) {
    const double x = -0.2 + 0.1 * cell;
    EXPECT_LT((f.at(x - 1e-9, 0.27).normal - f.at(x + 1e-9, 0.27).normal).norm(), 1e-7);  // more than z'' (10/m) times 2e-9 m
  }
}

// A query at NaN finds no contact and does not crash. In a run that diverges, such queries precede the error at the end of the
// step.
TEST(GroundField, StandsPlacesThatAreNone) {
  const double none = std::nan("");
  EXPECT_FALSE(field(2, {0, 1, 2, 3}).query(Vec3(none, none, none), 0.1).penetration > 0);
  EXPECT_FALSE(boxes({box(kMiddle, kSize)}).query(Vec3(none, none, none), 0.1).penetration > 0);
  EXPECT_NEAR(field(2, {0, 0, 0, 0}).query(Vec3(1e300, -1e300, 0.05), 0.1).penetration, 0.1, kGroundRounding);
}

// Contact of a sphere with a curved heightfield, a ball of radius R with z = -(x^2 + y^2) / 2 R near the top. The cubic cells
// represent this curvature exactly.
TEST(GroundField, FindsTheNearestPointOfACurvedSurface) {
  const double R = 0.5;
  const double spacing = 0.01;
  std::vector<double> values;
  for (int i = -20; i <= 20; ++i) {
    for (int j = -20; j <= 20; ++j) values.push_back(std::sqrt(R * R - spacing * spacing * (i * i + j * j)) - R);
  }
  Ground ground = field(41, values, spacing);
  std::get<Heightfield>(ground.shape).origin = {-0.2, -0.2, 0};
  for (const double angle : {0.0, 0.05, 0.15, 0.25}) {
    const Vec3 normal(std::sin(angle), 0, std::cos(angle));
    const Vec3 centre = Vec3(0, 0, -R) + (R + 0.03) * normal;
    const Ground::Touch touch = ground.query(centre, 0.0325);
    // The interpolation error in z is spacing^3 z''' / 20 = 1e-6 * 6 / 20. The error of three iterations for the nearest point
    // is (0.03 / 0.5)^4 of its distance of 7 mm.
    EXPECT_NEAR(touch.penetration, 0.0025, 1e-6) << angle;
    EXPECT_LT((touch.normal - normal).norm(), 2e-3) << angle;
  }
}

// If more boxes are near than a query can combine, the nearest box counts, at any position in the list.
TEST(GroundOfBoxes, GapIsThatToTheNearestOfMany) {
  Ground ground;
  std::vector<Box> list;
  double highest = 0;
  for (const double top : {0.01, 0.02, 0.03, 0.025}) {
    list.push_back({Vec3(0, 0, top / 2), Vec3(0.2, 0.2, top)});
    ground.shape = Boxes(list);
    highest = std::max(highest, top);
    EXPECT_NEAR(ground.query(Vec3(0, 0, 0.05), 0).penetration, highest - 0.05, 1e-15) << "rounding of 0.05";
  }
}

/// Height of the highest point in a box on a vertical line, found from above in steps of `step`; 0 without a box.
double sampled_top(const std::vector<Box>& list, const Vec3& point, double step) {
  double z = 2;
  while (z > 0) {
    z -= step;
    for (const Box& b : list) {
      const Vec3 local = b.R.transpose() * (Vec3(point.x(), point.y(), z) - b.center);
      if ((local.cwiseAbs() - 0.5 * b.size).maxCoeff() < 0) return z;
    }
  }
  return 0;
}

TEST(GroundSurfaceBelow, OfTurnedBoxesAgreesWithSampledVerticals) {
  std::mt19937 engine(7);
  std::uniform_real_distribution<double> unit(-1, 1);
  constexpr double kStep = 2e-4;
  int found = 0;
  for (int i = 0; i < 200; ++i) {
    std::vector<Box> list;
    for (int k = 0; k < 3; ++k) {
      list.push_back(box(Vec3(unit(engine), unit(engine), 1 + 0.3 * unit(engine)), Vec3(0.7, 0.5, 0.3),
                         3 * Vec3(unit(engine), unit(engine), unit(engine))));
    }
    const Vec3 above(unit(engine), unit(engine), 3);
    const double top = boxes(list).surface_below(above, 0);
    found += top > 0 ? 1 : 0;
    EXPECT_NEAR(top, sampled_top(list, above, kStep), 2 * kStep) << i;  // sampling misses corners thinner than a step
  }
  EXPECT_GT(found, 30);
}

TEST(GroundSurfaceBelow, IsNotAWallOrARoof) {
  const Ground ground = boxes({box({0, 0, 0.05}, {1, 1, 0.1}), box({0, 0, 0.5}, {1, 1, 0.2})});
  for (const auto& [z, surface] : {std::pair{1.0, 0.6}, {0.6, 0.6}, {0.599, 0.6}, {0.59, 0.1}, {0.3, 0.1}, {0.05, 0.0}})
    EXPECT_NEAR(ground.surface_below({0.1, 0.1, z}, 0.005), surface, kGroundRounding) << z;
  EXPECT_EQ(ground.surface_below({0.51, 0, 1}, 0), 0) << "beside them";
  EXPECT_EQ(ground.surface_below({0.51, 0, -1}, 0), 0) << "below the plane";
}

TEST(GroundSurfaceBelow, OfAFieldIsItsHeight) {
  const Ground slope = field(2, {0, 0.1, 0, 0.1}, 1);
  for (const double z : {-1.0, 0.0, 1.0}) EXPECT_NEAR(slope.surface_below({0.3, 0.6, z}, 0), 0.1, kGroundRounding) << z;
  EXPECT_EQ(Ground{}.surface_below({3, 4, 5}, 0), 0);
}

TEST(GroundTypes, AnswerTheirQueries) {
  struct Row {
    Ground::Shape shape;
    const char* name;
    bool exists, is_plane, has_plane, has_border;
  };
  const std::vector<Row> rows{{NoGround{}, "none", false, false, false, false},
                              {Plane{}, "plane", true, true, true, false},
                              {Boxes{box(kMiddle, kSize)}, "boxes", true, false, true, false},
                              {field(2, {0, 0, 0, 0}).shape, "heightfield", true, false, false, true}};
  ASSERT_EQ(rows.size(), kGroundTypes.size());
  for (const Row& row : rows) {
    const Ground ground{.shape = row.shape};
    EXPECT_STREQ(ground.type().name, row.name);
    EXPECT_EQ(ground.exists(), row.exists) << row.name;
    EXPECT_EQ(ground.is_plane(), row.is_plane) << row.name;
    EXPECT_EQ(ground.has_plane(), row.has_plane) << row.name;
    EXPECT_EQ(ground.has_border(), row.has_border) << row.name;
    EXPECT_EQ(ground.relief() != nullptr, row.has_border) << row.name;
    EXPECT_EQ(ground.boxes().size(), row.name == std::string("boxes") ? 1U : 0U) << row.name;
  }
  EXPECT_EQ(plane_and_box_types(), "none, plane or boxes");
}

TEST(GroundTypes, AFieldEndsAtItsBorder) {
  const Ground ground = field(3, {0, 0, 0, 0, 0, 0});  // x from -0.2 to 0, y from 0.1 to 0.2
  EXPECT_FALSE(ground.beyond_border(-0.1, 0.15));
  EXPECT_TRUE(ground.beyond_border(0.01, 0.15));
  EXPECT_TRUE(ground.beyond_border(-0.1, 0.21));
  EXPECT_FALSE(Ground{}.beyond_border(1e6, 1e6)) << "a plane has none";
}

TEST(GroundTypes, WithoutMovingBoxesTheFixedOnesStay) {
  Box loose = box(kMiddle, kSize);
  loose.mass = 0.2;
  const Ground ground{.shape = Boxes{box({0, 0, 0.05}, {0.1, 0.1, 0.1}), loose}};
  ASSERT_EQ(ground.without_moving_boxes().boxes().size(), 1U);
  EXPECT_EQ(ground.without_moving_boxes().highest(), boxes({box({0, 0, 0.05}, {0.1, 0.1, 0.1})}).highest());
}

}  // namespace
}  // namespace gaitlab
