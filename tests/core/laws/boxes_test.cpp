// Grid of cells for the boxes of a ground. The grid finds all boxes near a point, and a query has the same bits as a query that
// examines every box.
#include "core/laws/boxes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <random>

#include "core/laws/ground.h"
#include "tests/labels.h"

namespace gaitlab {
namespace {

const test::Label kLongBoxes("Boxes.AQueryHasTheBitsOfALookAtEveryBox", "long");

class Draw {
 public:
  explicit Draw(unsigned seed) : engine_(seed) {}
  double operator()(double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(engine_); }
  Vec3 vector(double lo, double hi) { return {(*this)(lo, hi), (*this)(lo, hi), (*this)(lo, hi)}; }

 private:
  std::mt19937 engine_;
};

Box drawn_box(Draw& draw, double extent, double smallest, double largest) {
  Box box;
  box.center = {draw(-extent, extent), draw(-extent, extent), draw(0, 0.3)};
  const double size = smallest * std::pow(largest / smallest, draw(0, 1));
  box.size = size * draw.vector(0.3, 1);
  if (draw(0, 1) < 0.5) box.rpy = draw.vector(-3, 3);
  box.R = rpy(box.rpy);
  box.friction = draw(0.1, 1);
  return box;
}

/// Random list of few or many boxes in a square or along a line. All are small and side by side, or some of them are large.
std::vector<Box> drawn_boxes(Draw& draw) {
  const auto count = static_cast<std::size_t>(std::pow(10, draw(1, 2.3)));
  const double extent = 0.05 * std::sqrt(static_cast<double>(count)) * std::pow(10, draw(-0.5, 1));
  const bool varied = draw(0, 1) < 0.5;
  const bool line = draw(0, 1) < 0.2;
  std::vector<Box> made;
  for (std::size_t i = 0; i < count; ++i) {
    made.push_back(drawn_box(draw, extent, varied ? 0.01 : 0.1, varied && draw(0, 1) < 0.02 ? extent : 0.2));
    if (line) made.back().center.y() *= 0.01;
  }
  return made;
}

std::vector<std::uint64_t> bits(const Ground::Touch& touch) {
  std::vector<std::uint64_t> all;
  for (const double value : {touch.penetration, touch.normal.x(), touch.normal.y(), touch.normal.z(), touch.point.x(),
                             touch.point.y(), touch.point.z(), touch.friction})
    all.push_back(std::bit_cast<std::uint64_t>(value));
  return all;
}

Ground ground_of(std::vector<Box> boxes) {
  Ground ground;
  ground.shape = Boxes(std::move(boxes));
  return ground;
}

TEST(Boxes, NearAreAllWithinADistanceInTheirOrder) {
  Draw draw(1);
  for (int i = 0; i < 200; ++i) {
    const std::vector<Box> list = drawn_boxes(draw);
    const Boxes boxes(list);
    for (int k = 0; k < 1000; ++k) {
      const double distance = std::pow(10, draw(-4, 1.5));
      const Box& one = list[static_cast<std::size_t>(k) % list.size()];
      const double angle = draw(-3.15, 3.15);
      // The place is at a random distance, or at the largest distance at which the box must be found.
      const double far = k % 2 == 0 ? draw(0, 20) : (1 - 1e-6) * (0.5 * one.size.norm() + distance);
      const Vec3 place = one.center + far * Vec3(std::cos(angle), std::sin(angle), 0);
      const std::span<const std::uint32_t> near = boxes.near(place, distance);
      ASSERT_TRUE(std::ranges::is_sorted(near, std::ranges::less_equal())) << i;
      for (std::uint32_t b = 0; b < list.size(); ++b) {
        if ((place - list[b].center).norm() > 0.5 * list[b].size.norm() + distance) continue;
        ASSERT_TRUE(std::ranges::binary_search(near, b)) << "case " << i << ", box " << b << ", distance " << distance;
      }
    }
  }
}

// A query has the same bits as a query that examines every box. The reference uses huge boxes far away: the edge of a cell is
// the size of the median box, so that all random boxes share one cell and are examined in order. As many boxes deep below the
// others make the limits of the searches equal.
TEST(Boxes, AQueryHasTheBitsOfALookAtEveryBox) {
  Draw draw(2);
  int touched = 0;
  int inside = 0;
  for (int i = 0; i < 100; ++i) {
    const std::vector<Box> list = drawn_boxes(draw);
    std::vector<Box> and_deep = list;
    std::vector<Box> and_far = list;
    for (std::size_t k = 0; k <= list.size(); ++k) {
      and_deep.push_back(list[k % list.size()]);
      and_deep.back().center.z() -= 1000;
      and_far.push_back({Vec3(5e5, 0, 0), Vec3(1e5, 1e5, 1e5)});
    }
    const Ground ground = ground_of(and_deep);
    const Ground every = ground_of(and_far);
    ASSERT_GE(every.boxes().near(Vec3::Zero(), 0).size(), list.size());
    for (int k = 0; k < 100; ++k) {
      Vec3 place = list[static_cast<std::size_t>(draw(0, static_cast<double>(list.size())))].center;
      if (k % 4 != 0) place += std::pow(10, draw(-3, 1)) * draw.vector(-1, 1);  // beside the box, above it, far away
      if (k % 8 == 1) place.z() = draw(-0.01, 0.5);
      const double radius = k % 2 == 0 ? 0 : draw(0.001, 0.3);
      const Ground::Touch touch = ground.query(place, radius);
      ASSERT_EQ(bits(touch), bits(every.query(place, radius))) << "case " << i << ", place " << place.transpose();
      touched += touch.penetration > 0 && touch.normal.z() != 1 ? 1 : 0;
      inside += touch.penetration > radius && touch.normal.z() != 1 ? 1 : 0;
      ASSERT_EQ(ground.surface_below(place, 0.01), every.surface_below(place, 0.01)) << "case " << i;
    }
  }
  EXPECT_GT(touched, 1000);
  EXPECT_GT(inside, 500);
}

TEST(Boxes, OfAPlaceThatIsNoNumberAreNone) {
  Draw draw(3);
  const Ground ground = ground_of([&] {
    std::vector<Box> list;
    for (int i = 0; i < 100; ++i) list.push_back(drawn_box(draw, 1, 0.1, 0.2));
    return list;
  }());
  for (const double wrong : {std::nan(""), std::numeric_limits<double>::infinity(), -1e300}) {
    EXPECT_TRUE(ground.boxes().near(Vec3(wrong, 0, 0), 0.01).empty());
    EXPECT_TRUE(ground.boxes().near(Vec3(0, wrong, 0), 0.01).empty());
    EXPECT_EQ(ground.surface_below(Vec3(wrong, 0, 1), 0), 0);
  }
  EXPECT_EQ(ground.boxes().near(Vec3::Zero(), std::nan("")).size(), 100U);
}

// A query examines only few of ten thousand tiles, of steps along a line, and of boxes above one floor.
TEST(Boxes, NearAreFewOfMany) {
  const auto most = [](const std::vector<Box>& list) {
    const Boxes boxes(list);
    std::size_t found = 0;
    for (const Box& box : list) found = std::max(found, boxes.near(box.center, 0.02).size());
    return found;
  };
  std::vector<Box> tiles;
  for (int x = 0; x < 100; ++x) {
    for (int y = 0; y < 100; ++y) tiles.push_back({Vec3(0.1 * x, 0.1 * y, 0), Vec3(0.1, 0.1, 0.02)});
  }
  EXPECT_LE(most(tiles), 40U);
  tiles.push_back({Vec3(5, 5, -0.1), Vec3(200, 200, 0.1)});
  EXPECT_LE(most(tiles), 40U * 4U);
  std::vector<Box> stairs;
  for (int x = 0; x < 10000; ++x) stairs.push_back({Vec3(0.3 * x, 0, 0.05 * x), Vec3(0.3, 1, 0.1)});
  EXPECT_LE(most(stairs), 16U);
}

}  // namespace
}  // namespace gaitlab
