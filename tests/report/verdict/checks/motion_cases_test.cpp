// Tests of checks of the robot's motion and its bodies, for cases that check_table_test.cpp does not contain.
#include <array>
#include <cmath>
#include <limits>

#include "tests/report/verdict/checks/check_changes.h"

namespace gaitlab::test {
namespace {

CheckStatus motion_status(const char* id, const Change& change) { return changed(id, change).status; }

/// Without a required progress, the check warns if the robot moves less than a hundredth of its size and turns less than 0.01
/// rad per period.
TEST(CheckMotion, ProgressIsAWayOrATurn) {
  const auto status = [](double extents, double turn) {
    return motion_status("progress", [=](Case& made) {
      goes(extents)(made);
      made.scenario.limits.progress = 0;
      const Judged judged = summarise(made.scenario, made.record, 0).judged;
      const double rate = turn * static_cast<double>(judged.periods) / (judged.to - judged.from);
      for (std::size_t row = 0; row < made.record.poses.rows(); ++row) {
        made.pose("base.qw", row) = std::cos(rate * made.pose("t", row) / 2);
        made.pose("base.qz", row) = std::sin(rate * made.pose("t", row) / 2);
        made.pose("base.qx", row) = made.pose("base.qy", row) = 0;
      }
    });
  };
  EXPECT_EQ(status(0.0101, 0), CheckStatus::pass);
  EXPECT_EQ(status(0.0099, 0), CheckStatus::warn);
  EXPECT_EQ(changed("progress", goes(1, true)).status, CheckStatus::fail) << "before the window";
  EXPECT_EQ(status(0, 0.0103), CheckStatus::pass) << "the window begins at a tick";
  EXPECT_EQ(status(0, -0.0103), CheckStatus::pass);
  EXPECT_EQ(status(0, 0.0097), CheckStatus::warn);
  // Without periods the limits are ten times as large and apply to the whole window.
  const auto without = [](double extents) {
    return motion_status("progress", [=](Case& made) {
      const double speed = extents * extent_of_gait() / (12 - left_out_start(12));
      for (std::size_t row = 0; row < made.record.poses.rows(); ++row) {
        made.pose("com.x", row) = speed * made.pose("t", row);
        made.pose("com.y", row) = 0;
        for (const char* column : {"base.qw", "base.qx", "base.qy", "base.qz"}) made.pose(column, row) = made.pose(column, 0);
      }
      made.also = [](Summary& summary, Overlaps&) {
        summary.judged.periods = 0;
        summary.judged.from = left_out_start(12);
      };
    });
  };
  EXPECT_EQ(without(0.102), CheckStatus::pass);
  EXPECT_EQ(without(0.098), CheckStatus::warn);
}

/// Sets gravity so that it does `work` on a robot that travels `way` forward on a plane.
void slope(Case& made, double work, double way) { made.scenario.physics.gravity.x() = work / made.scenario.robot->mass / way; }

/// A robot slides downhill, which is not progress, if gravity supplies more energy than the motors along the ground and the
/// second half of the judged time is more than 1.2 times as fast as the first half.
TEST(CheckMotion, ProgressIsNoSlide) {
  const Judged judged = summarise(rated_gait().scenario, rated_gait().record, 0).judged;
  const double period = (judged.to - judged.from) / static_cast<double>(judged.periods);
  const auto slides_down = [&](double faster, double height, std::size_t periods = 2, double lacks = 0, bool drops = false) {
    return changed("progress", [=](Case& made) {
      // The window has two whole periods up to the end. With an odd number of periods, the middle period is in both halves.
      made.also = [=](Summary& summary, Overlaps&) {
        summary.judged.periods = periods;
        summary.judged.from = judged.to - 2 * period;
        if (periods == 1) summary.judged.from = judged.to - judged.to / (2 - lacks);
      };
      const double half = judged.to - period;
      double driven = 0;
      for (const JointStatistics& one : made.record.joints) driven += one.shaft;
      const double weight = made.scenario.robot->mass * made.scenario.physics.gravity.norm();
      const double work = height * std::max(driven, 1e-3 * weight);
      if (!drops) slope(made, work, (1 + faster) * period);
      for (std::size_t row = 0; row < made.record.poses.rows(); ++row) {
        const double t = made.pose("t", row);
        made.pose("com.x", row) = t < half ? t : half + faster * (t - half);
        made.pose("com.y", row) = 0;
        made.pose("com.z", row) = drops ? -work / weight * (t - half + period) / (2 * period) : 0;
      }
    });
  };
  const Check slide = slides_down(1.22, 1.05);
  EXPECT_EQ(slide.status, CheckStatus::fail) << slide.text;
  EXPECT_NEAR(slide.value, 1.22, 0.01);
  EXPECT_EQ(slide.limit, 1.2);
  EXPECT_LT(slide.margin, 0);
  EXPECT_EQ(slides_down(1.18, 1.05).status, CheckStatus::pass);
  EXPECT_EQ(slides_down(1.22, 0.95).status, CheckStatus::pass);
  EXPECT_EQ(slides_down(0.8, 1.05).status, CheckStatus::pass);
  EXPECT_EQ(slides_down(1.22, 10, 2, 0, true).status, CheckStatus::pass) << "it comes down onto the plane, and not along it";
  // A single period is compared with the period before it, of which up to a thousandth may be missing.
  EXPECT_EQ(slides_down(2, 1.7, 1, 0.9e-3).status, CheckStatus::fail);
  EXPECT_EQ(slides_down(2, 1.7, 1, 1.2e-3).status, CheckStatus::pass);
}

/// The halves consist of whole periods of the window. A single period is compared with the period before it, and of three
/// periods the middle is in both halves.
TEST(CheckMotion, SlidesByWholePeriods) {
  const auto faster = [](std::size_t periods, double from, const std::array<double, 3>& speeds) {
    return changed("progress", [=](Case& made) {
      made.also = [=](Summary& summary, Overlaps&) {
        summary.judged.periods = periods;
        summary.judged.from = from;
      };
      double x = 0;
      made.scenario.physics.gravity.x() = 9.81;  // supplies far more energy than the motors
      for (std::size_t row = 0; row < made.record.poses.rows(); ++row) {
        const double t = made.pose("t", row);
        if (row > 0)
          x += speeds[std::min<std::size_t>(static_cast<std::size_t>((t - 1e-6) / 4), 2)] * (t - made.pose("t", row - 1));
        made.pose("com.x", row) = x;
        made.pose("com.y", row) = 0;
        made.pose("com.z", row) = 0;
      }
    });
  };
  EXPECT_EQ(faster(1, 8, {1, 1, 1.18}).status, CheckStatus::pass);
  EXPECT_EQ(faster(1, 8, {1, 1, 1.22}).status, CheckStatus::fail) << faster(1, 8, {1, 1, 1.22}).text;
  EXPECT_NEAR(faster(1, 8, {1, 1, 1.22}).value, 1.22, 0.01);
  EXPECT_EQ(faster(1, 8, {0.1, 1, 1}).status, CheckStatus::pass) << "before both";
  EXPECT_NEAR(faster(3, 0, {1, 1, 1.6}).value, 2.6 / 2, 0.01);
  EXPECT_NEAR(faster(3, 0, {1, 3, 2}).value, 5.0 / 4, 0.01);
  EXPECT_NEAR(faster(2, 4, {5, 1, 2}).value, 2, 0.02);
}

/// A tick of the window counts as airborne if the load on the feet is less than 5 % of the weight.
TEST(CheckMotion, AirborneIsATickWithoutLoad) {
  const auto with = [](double share, bool early = false) {
    return changed("airborne", [=](Case& made) {
      const double weight = made.scenario.robot->mass * made.scenario.physics.gravity.norm();
      const std::size_t rows = made.record.poses.rows();
      for (std::size_t row = 0; row < rows; ++row) made.pose("load", row) = weight;
      made.pose("load", early ? 1 : rows - 1) = share * weight;
    });
  };
  EXPECT_EQ(with(0.0499).status, CheckStatus::warn);
  EXPECT_LT(with(0.0499).margin, 0);
  EXPECT_EQ(with(0.0501).status, CheckStatus::pass);
  EXPECT_EQ(with(0, true).status, CheckStatus::pass) << "before the window";
}

TEST(CheckMotion, StabilityIsOfTheWindow) {
  const auto least = [](std::size_t row) {
    return changed("stability",
                   [=](Case& made) {
                     for (std::size_t k = 0; k < made.record.loads.rows(); ++k)
                       made.load("stability", k) = k == row ? -0.03 : 0.02;
                   })
        .value;
  };
  EXPECT_EQ(least(1), 0.02);
  EXPECT_EQ(least(rated_gait().last_tick()), -0.03);
}

/// The edge of a heightfield belongs to it. The time of the check is the first tick at which the robot is outside.
TEST(CheckMotion, FieldEndsAtItsEdge) {
  const auto with = [](const char* column, double at) {
    return changed("field", [=](Case& made) {
      made.scenario.ground.shape = Heightfield{Vec3(-1, -2, 0), 1, 3, std::vector<double>(15, 0.0)};  // ends at x = 1, y = 2
      for (std::size_t row = 0; row < made.record.poses.rows(); ++row) made.pose("com.x", row) = made.pose("com.y", row) = 0;
      made.pose(column, 1) = at;
      made.pose(column, 2) = at;
    });
  };
  for (const auto& [column, edge] : {std::pair{"com.x", 1.0}, {"com.x", -1.0}, {"com.y", 2.0}, {"com.y", -2.0}}) {
    EXPECT_EQ(with(column, edge).status, CheckStatus::pass) << column;
    EXPECT_EQ(with(column, 1.001 * edge).status, CheckStatus::warn) << column;
    EXPECT_EQ(with(column, 1.001 * edge).first, rated_gait().time(1)) << column;
  }
}

/// Bodies collide if their depth of overlap exceeds limits.touch, for any hinge angles.
TEST(CheckMotion, CollisionsAreDeeperThanATouch) {
  Scenario s = scenario(
      "gaitlab: 1\nrobot: {modules: mtran, docks: [[1, 1, 4, 0, 0], [1, 2, 4, 1, 0], [1, 3, 4, 2, 0]], position: [0, 0, 1]}\n"
      "duration: 0.001\nphysics: {engine: articulated}\nactuator: {type: none}\nground: {type: none}\n");
  const Recording record = run(s);
  const double usual = s.limits.touch;
  const auto depth = [&](double angle, double touch) {
    Recording bent = record;
    for (std::size_t row = 0; row < bent.poses.rows(); ++row) {
      for (std::size_t j = 0; j < s.robot->joints.size(); ++j)
        bent.poses.values[row * bent.poses.columns.size() + 8 + j] = angle;
    }
    s.limits.touch = touch;
    const Overlaps found = overlaps(s, bent);
    return found.collision ? found.collision->depth : 0;
  };
  double apart = 0.6;
  double deep = 1.2;
  while (deep - apart > 1e-6) {
    const double middle = (apart + deep) / 2;
    (depth(middle, 1e-6) > 5e-4 ? deep : apart) = middle;
  }
  const double angle = (apart + deep) / 2;
  EXPECT_NEAR(depth(angle, 1e-6), 5e-4, 1e-5);
  EXPECT_EQ(depth(angle - 1e-4, usual), 0);
  EXPECT_GT(depth(angle + 1e-4, usual), 5e-4);
  EXPECT_LT(depth(angle + 1e-4, 1e-6), 6.5e-4) << "else a limit a third larger is not noticed";
  s.limits.collision = 4e-4;
  EXPECT_GT(depth(angle, usual), 4e-4) << "of a record, whose limits.touch is above limits.collision";
  // An overlap of 1e-9 m counts as a rounding error, also if limits.touch is 0.
  for (apart = 0.6, deep = angle; deep - apart > 1e-14;) {
    const double middle = (apart + deep) / 2;
    if (middle == apart || middle == deep) break;
    (depth(middle, 0) > 0 ? deep : apart) = middle;
  }
  EXPECT_NEAR(depth(deep, 0), 1e-9, 1e-12) << "the rounding of shapes of 0.1 m, and room";
}

/// If several pairs of bodies first collide at the same tick, the pair with the largest overlap is reported as the first.
TEST(CheckMotion, TheFirstOfSeveralPairs) {
  Scenario s = scenario(
      "gaitlab: 1\nrobot: {modules: mtran, docks: [[1, 1, 4, 0, 0], [1, 2, 4, 1, 0], [1, 3, 4, 2, 0]], position: [0, 0, 1]}\n"
      "duration: 0.001\nphysics: {engine: articulated}\nactuator: {type: none}\nground: {type: none}\n");
  Recording bent = run(s);
  for (std::size_t row = 0; row < bent.poses.rows(); ++row) {
    for (std::size_t j = 0; j < s.robot->joints.size(); ++j)
      bent.poses.values[row * bent.poses.columns.size() + 8 + j] = 1.3 + 0.05 * static_cast<double>(j);
  }
  const std::optional<Collision> found = overlaps(s, bent).collision;
  ASSERT_TRUE(found);
  EXPECT_GE(found->pairs, 2U);
  EXPECT_EQ(found->time, 0);
  EXPECT_NE(found->first, found->second);
  EXPECT_EQ(std::pair(found->first, found->second), std::pair(found->deepest_first, found->deepest_second));
}

/// If limits.touch exceeds limits.collision in a recording, limits.collision applies.
TEST(CheckMotion, CollisionsOfARecord) {
  const auto status = [](double depth) {
    return motion_status("collision", [=](Case& made) {
      made.scenario.limits.touch = 0.02;
      made.scenario.limits.collision = 0.01;
      made.also = [=](Summary&, Overlaps& there) { there.collision = {.depth = depth, .deepest_second = 5, .pairs = 1}; };
    });
  };
  EXPECT_EQ(status(0.0099), CheckStatus::pass);
  EXPECT_EQ(status(0.0101), CheckStatus::fail);
}

/// Slip is judged only if the robot travels at least 10 mm.
TEST(CheckMotion, SlipIsOfAWay) {
  const auto status = [](double way) {
    return motion_status("slip", [=](Case& made) {
      slides(0.1)(made);
      made.load("path", made.record.loads.rows() - 1) = way;
    });
  };
  EXPECT_EQ(status(0.0099), CheckStatus::not_judged);
  EXPECT_NE(status(0.0101), CheckStatus::not_judged);
}

}  // namespace
}  // namespace gaitlab::test
