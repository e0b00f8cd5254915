// The exported glTF file contains the poses of the trace for every body at every keyframe.
#include "interchange/gltf.h"

#include <cmath>
#include <set>

#include "report/figures/run/views.h"
#include "tests/interchange/glb_file.h"
#include "tests/messages.h"
#include "tests/program/random_scenario.h"

namespace gaitlab::test {

using namespace interchange;

namespace {

const GltfLook kLook{.generator = "a test",
                     .body = report::body_colour,
                     .ground = "#FFFFFF",
                     .tile = "#DDDDDD",
                     .box = "#999999",
                     .moving_box = "#009E73"};

GlbFile exported(const Scenario& scenario, const Recording* recording = nullptr) {
  return GlbFile(to_gltf(scenario, recording, kLook).bytes);
}

// Rounding errors of float32, half of the last bit. The error of a quaternion's largest component is 2^-25, that of all four
// 2^-24, which is half of an angle. The error of a coordinate is 2^-24.
constexpr double kTurned = 0x1p-23, kShifted = 0x1p-24;
constexpr double kDoubles = 1e-13;  // rounding errors of chains of up to 30 poses in double

Pose traced(const Recording& recording, const std::string& name, std::size_t row) {
  const auto value = [&](const char* part) {
    const Series series = recording.series(name + "." + part);
    if (series.empty()) throw std::out_of_range("no column " + name + "." + part);
    return series[row];
  };
  const Quat q(value("qw"), value("qx"), value("qy"), value("qz"));
  return {q.toRotationMatrix(), {value("x"), value("y"), value("z")}};
}

/// Number of the row whose time is closest to the time of a keyframe.
std::size_t row_at(const Recording& recording, double time) {
  const Series t = recording.series("t");
  std::size_t best = 0;
  for (std::size_t row = 0; row < t.size(); ++row) {
    if (std::abs(t[row] - time) < std::abs(t[best] - time)) best = row;
  }
  return best;
}

/// Angle between two rotations, for small angles, rad.
double angle(const Mat3& a, const Mat3& b) { return (a - b).norm() / std::sqrt(2.0); }

/// Largest difference between the poses of a body in the file and in the trace, at any frame, relative to the permitted
/// rounding error.
double worst_share(const Scenario& scenario, const Recording& recording) {
  const GlbFile file = exported(scenario, &recording);
  double worst = 0;
  const std::vector<double> times = file.times();
  for (std::size_t frame = 0; frame < times.size(); ++frame) {
    const std::size_t row = row_at(recording, times[frame]);
    for (const Body& body : scenario.robot->bodies) {
      const Pose ours = traced(recording, "body." + body.name, row);
      const Pose read = file.pose(body.name, frame);
      double turned = kDoubles;
      double shifted = kDoubles + kShifted * traced(recording, "base", row).p.norm();
      for (int l = static_cast<int>(body.link); l >= 0; l = scenario.robot->links[static_cast<std::size_t>(l)].parent) {
        const Link& link = scenario.robot->links[static_cast<std::size_t>(l)];
        const std::string node = l == 0 ? "base" : "joint " + scenario.robot->joints[static_cast<std::size_t>(link.joint)].name;
        turned += kTurned;
        shifted += kTurned * (ours.p - file.pose(node, frame).p).norm();
      }
      worst = std::max({worst, angle(ours.R, read.R) / turned, (ours.p - read.p).norm() / shifted});
    }
  }
  return worst;
}

TEST(Gltf, BodiesOfTheHexapodAreWhereTheTraceHasThem) {
  const Scenario s = shipped("hexapod.yaml", {"duration=1", "trace.columns=[joint.*, base.*, com.*, body.*]"});
  const double worst = worst_share(s, run(s));
  EXPECT_LE(worst, 1);
  EXPECT_GT(worst, 0.01) << "float32 is seen at all: the bound is not empty";
}

TEST(Gltf, BodiesOfRandomRobotsAreWhereTheTraceHasThem) {
  RandomRobots random(71);
  for (int i = 0; i < 30; ++i) {
    Scenario s = random_scenario(random, i % 3 == 0 ? Base::fixed : i % 3 == 1 ? Base::planar : Base::floating, 0.3);
    s.duration = 0.1;
    s.trace = {0.01, {"joint.*", "base.*", "com.*", "body.*"}};
    s.control_period = s.cpg_step = 0.01;
    const Recording recording = run(s);
    if (s.robot->joints.empty() && s.base == Base::fixed) continue;
    EXPECT_LE(worst_share(s, recording), 1) << i;
  }
}

TEST(Gltf, WorldTurnsZUpIntoYUp) {
  const GlbFile file = exported(shipped("caterpillar.yaml"));
  ASSERT_EQ(file.json()["scenes"][0]["nodes"].size(), 1U);
  const Pose world = file.in_parent(file.json()["scenes"][0]["nodes"][0], 0);
  EXPECT_LT((world * Vec3(1, 2, 3) - Vec3(1, 3, -2)).norm(), 1e-15);
}

/// Only the base has a translation channel. Joints only rotate, so that no interpolation between keyframes moves a body off its
/// hinge.
TEST(Gltf, OnlyTheBaseIsShifted) {
  const Scenario s = shipped("hexapod.yaml", {"duration=0.5"});
  const Recording recording = run(s);
  const GlbFile file = exported(s, &recording);
  std::map<std::string, int> channels;
  for (const auto& channel : file.json()["animations"][0]["channels"]) ++channels[channel["target"]["path"]];
  EXPECT_EQ(channels, (std::map<std::string, int>{{"rotation", 23}, {"translation", 1}}));
  EXPECT_FALSE(file.channel("base", "translation").empty());
}

TEST(Gltf, KeyframesAreRowsAtLeastASixtiethApartAndTheLastOne) {
  const auto times = [](const char* period, const char* duration) {
    const Scenario s =
        shipped("caterpillar.yaml", {std::string("trace.period=") + period, std::string("duration=") + duration});
    const Recording recording = run(s);
    std::vector<double> read = exported(s, &recording).times();
    EXPECT_EQ(read.size(), to_gltf(s, &recording, kLook).frames);
    return read;
  };
  const auto floats = [](std::initializer_list<double> numbers) {
    std::vector<double> rounded;
    for (const double x : numbers) rounded.push_back(static_cast<float>(x));
    return rounded;
  };
  EXPECT_EQ(times("0.005", "0.1"), floats({0, 0.02, 0.04, 0.06, 0.08, 0.1}));
  EXPECT_EQ(times("0.03", "0.09"), floats({0, 0.03, 0.06, 0.09}));
  EXPECT_EQ(times("0.005", "0.05"), floats({0, 0.02, 0.04, 0.05})) << "the last row, however near";
}

/// Times of keyframes increase strictly, as the specification requires, also after a day, when float32 cannot represent steps
/// of 1/60 s.
TEST(Gltf, TimesGrowAfterDays) {
  const Scenario s = shipped("caterpillar.yaml");
  Recording recording;
  recording.trace.columns = {{"t", "s", ""}};
  for (const char* part : {"x", "y", "z", "qw", "qx", "qy", "qz"})
    recording.trace.columns.push_back({std::string("base.") + part, "", ""});
  for (std::size_t j = 0; j < 16; ++j) recording.trace.columns.push_back({fmt::format("joint.{}.angle", j), "", ""});
  for (int row = 0; row < 200; ++row) {
    const double t = 1e6 + 0.02 * row;
    std::vector<double> values{t, 0.1 * row, 0, 0, 1, 0, 0, 0};
    values.resize(24, 0.01 * row);
    recording.trace.values.insert(recording.trace.values.end(), values.begin(), values.end());
  }
  std::vector<double> read = exported(s, &recording).times();
  EXPECT_GT(read.size(), 50U);
  for (std::size_t k = 1; k < read.size(); ++k) EXPECT_GT(read[k], read[k - 1]);
}

TEST(Gltf, SignsAreContinuousThroughWholeTurns) {
  const Scenario s = scenario(R"(
gaitlab: 1
robot: {modules: mtran}
ground: {type: none}
contact: {on: none}
actuator: {type: none}
physics: {gravity: [0, 0, 0]}
initial: {base_angular_velocity: [0.1, 4, 0.2]}
duration: 5
)");
  const Recording recording = run(s);
  const std::vector<double> q = exported(s, &recording).channel("base", "rotation");
  ASSERT_GT(q.size(), 4U * 200);
  double least = 1;
  for (std::size_t k = 4; k < q.size(); ++k)
    least = std::min(least, k % 4 == 0 ? q[k] * q[k - 4] + q[k + 1] * q[k - 3] + q[k + 2] * q[k - 2] + q[k + 3] * q[k - 1] : 1);
  EXPECT_GT(least, 0.99) << "0.02 s at 4 rad/s: cos(0.04)";
  EXPECT_LT(*std::min_element(q.begin(), q.end()), -0.9) << "it has turned by more than a whole turn";
}

TEST(Gltf, BoxesMoveAsRecordedWhateverTheTraceHolds) {
  const Scenario s = scenario(R"(
gaitlab: 1
robot: {modules: mtran, position: [-0.2, 0, 0.0325]}
contact: {law: bullet, on: all}
ground: {type: boxes, friction: 0.1, boxes: [{center: [0, 0, 0.05], size: [0.1, 0.2, 0.1], mass: 0.2}, {center: [1, 1, 0], size: [0.3, 0.2, 0.1], rpy: [0, 0, 0.5]}]}
initial: {base_velocity: [1, 0, 0]}
duration: 0.6
)");
  const Recording recording = run(s);
  EXPECT_EQ(recording.trace.find("box.0.x"), recording.trace.columns.size());
  EXPECT_TRUE(boxes_without_way(s, recording).empty());
  const GlbFile file = exported(s, &recording);
  const std::vector<double> times = file.times();
  for (std::size_t frame = 0; frame < times.size(); ++frame) {
    const Pose ours = traced(recording, "box.0", row_at(recording, times[frame]));
    const Pose read = file.pose("ground.boxes[0]", frame);
    EXPECT_LE((ours.p - read.p).norm(), kShifted * ours.p.norm() + kDoubles);
    EXPECT_LE(angle(ours.R, read.R), kTurned + kDoubles);
  }
  EXPECT_GT(file.pose("ground.boxes[0]", times.size() - 1).p.x(), 0.05);
  EXPECT_TRUE(file.channel("ground.boxes[1]", "translation").empty());
  EXPECT_LT(angle(file.pose("ground.boxes[1]", 0).R, rpy({0, 0, 0.5})), kDoubles);
  EXPECT_EQ(file.json()["nodes"][file.node("ground.boxes[0]")]["scale"], (std::vector<double>{0.1, 0.2, 0.1}));
  Recording older = recording;
  older.rest.columns.change([](auto& columns) {
    for (Column& column : columns) {
      if (column.name.starts_with("box.")) column.name.insert(0, "lost.");
    }
  });
  EXPECT_EQ(boxes_without_way(s, older), std::vector<std::size_t>{0});
  EXPECT_LT((exported(s, &older).pose("ground.boxes[0]", times.size() - 1).p - Vec3(0, 0, 0.05)).norm(), kDoubles);
}

const char* const kBall = R"(
gaitlab: 1
robot: {modules: ball.yaml, base: BASE, position: [0, 0, 0.2]}
contact: {on: all}
actuator: {type: none}
duration: 0.2
trace: {columns: [base.*]}
)";
const char* const kBallType = R"(
gaitlab_module: 1
name: ball
bodies:
  ball: {mass: 1, com: [0, 0, 0], inertia: [0.001, 0.001, 0.001, 0, 0, 0], shape: [{sphere: 0.05}], source: "chosen"}
hinges: []
faces: []
contacts: {feet: [], all: [{body: ball, sphere: [0, 0, 0], radius: 0.05}]}
)";

Scenario ball(const std::string& base) {
  const Folder folder;
  folder.write("ball.yaml", kBallType);
  std::string text = kBall;
  text.replace(text.find("BASE"), 4, base);
  return read_scenario(folder.write("test.yaml", text), {}, catalog());
}

TEST(Gltf, RobotsWithoutJoints) {
  const Scenario falls = ball("floating");
  const Recording fall = run(falls);
  const GlbFile file = exported(falls, &fall);
  ASSERT_EQ(file.json()["animations"][0]["channels"].size(), 1U) << "it does not turn";
  const std::vector<double> z = file.channel("base", "translation");
  EXPECT_EQ(z.back(), static_cast<float>(end(fall, "base.z")));
  const Scenario held = ball("fixed");
  const Recording stays = run(held);
  EXPECT_FALSE(exported(held, &stays).json().contains("animations")) << "nothing moves";
  EXPECT_NEAR(exported(held, &stays).pose("m0/ball", 0).p.z(), 0.2, kDoubles);
}

TEST(Gltf, AScenarioAloneStandsAsItStarts) {
  const Scenario s = shipped("rubble.yaml", {"duration=0.02"});
  const GlbFile file = exported(s);
  EXPECT_EQ(to_gltf(s, nullptr, kLook).frames, 1U);
  EXPECT_FALSE(file.json().contains("animations"));
  const Recording recording = run(s);
  for (const Body& body : s.robot->bodies) {
    const Pose ours = traced(recording, "body." + body.name, 0);
    EXPECT_LT((file.pose(body.name, 0).p - ours.p).norm() + angle(file.pose(body.name, 0).R, ours.R), kDoubles) << body.name;
  }
  for (int b = 0; b < 5; ++b) EXPECT_TRUE(file.has_node(fmt::format("ground.boxes[{}]", b)));
}

TEST(Gltf, OneMeshABodyTypeInTheColoursOfTheFigure) {
  const GlbFile file = exported(shipped("hexapod.yaml"));
  std::set<std::string> meshes;
  for (const auto& mesh : file.json()["meshes"]) meshes.insert(mesh["name"]);
  EXPECT_EQ(meshes.size(), 4U) << "three of the module, the ground";
  for (const char* body : {"active", "link", "passive"}) EXPECT_TRUE(meshes.contains(std::string("mtran/") + body));
  EXPECT_EQ(file.json()["materials"].size(), 5U);
  for (const auto& material : file.json()["materials"]) {
    if (material["name"] != "active block") continue;
    const auto& factor = material["pbrMetallicRoughness"]["baseColorFactor"];
    // Linear values of the sRGB colour #56B4E9, from tables with three digits.
    EXPECT_NEAR(factor[0], 0.0931, 5e-4);
    EXPECT_NEAR(factor[1], 0.4564, 5e-4);
    EXPECT_NEAR(factor[2], 0.8148, 5e-4);
    EXPECT_EQ(factor[3], 1);
  }
}

TEST(Gltf, BodiesWithoutAShapeAreNamed) {
  RandomRobots random(72);
  const Scenario s = random_scenario(random, Base::floating);
  const std::vector<std::string> hidden = bodies_without_shape(*s.robot);
  const GlbFile file = exported(s);
  std::size_t drawn = 0;
  for (const Body& body : s.robot->bodies) drawn += file.json()["nodes"][file.node(body.name)].contains("mesh") ? 1 : 0;
  EXPECT_EQ(drawn + hidden.size(), s.robot->bodies.size());
  for (const std::string& name : hidden) EXPECT_FALSE(file.json()["nodes"][file.node(name)].contains("mesh")) << name;
  Robot bare = *s.robot;
  for (ModuleType& type : bare.types) {
    for (BodyType& body : type.bodies) body.shapes.clear();
  }
  Scenario nothing = s;
  nothing.robot = std::make_shared<const Robot>(std::move(bare));
  EXPECT_EQ(bodies_without_shape(*nothing.robot).size(), s.robot->bodies.size());
  EXPECT_FALSE(exported(nothing).json().contains("meshes")) << "an empty list is not valid glTF";
}

TEST(Gltf, NumbersThatAreNotFiniteAreRefused) {
  const Scenario s = shipped("caterpillar.yaml", {"duration=0.1"});
  Recording recording = run(s);
  const std::size_t column = recording.trace.find("joint.3.angle");
  recording.trace.values[column + 4 * recording.trace.columns.size()] = std::nan("");
  const std::string text = message_of([&] { (void)to_gltf(s, &recording, kLook); });
  EXPECT_TRUE(contains(text, "column joint.3.angle of its recording is nan at t = 0.02 s")) << text;
}

}  // namespace
}  // namespace gaitlab::test
