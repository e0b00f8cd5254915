// What a page holds: its numbers, unpacked again by code that is not the program's; its robot, its motors, its feet.
#include <zlib.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>

#include "report/envelope.h"
#include "report/harmonic.h"
#include "report/packing.h"
#include "report/page.h"
#include "report/robot_tree.h"
#include "report/start_row.h"
#include "tests/program/fixture.h"
#include "tests/random_robots.h"

namespace gaitlab::test {
namespace {

using nlohmann::json;

std::string from_base64(const std::string& text) {
  std::string bytes;
  unsigned held = 0;
  int bits = 0;
  for (const char c : text) {
    if (c == '=') break;
    const unsigned six = c >= 'A' && c <= 'Z'   ? static_cast<unsigned>(c - 'A')
                         : c >= 'a' && c <= 'z' ? static_cast<unsigned>(c - 'a') + 26
                         : c >= '0' && c <= '9' ? static_cast<unsigned>(c - '0') + 52
                         : c == '+'             ? 62U
                                                : 63U;
    held = held << 6 | six;
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    bytes.push_back(static_cast<char>(held >> bits & 255U));
  }
  return bytes;
}

std::string inflated(const std::string& bytes) {
  std::string all(std::size_t{64} << 20, '\0');
  uLongf size = all.size();
  EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(all.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()),
            Z_OK);
  all.resize(size);
  return all;
}

/// The channels of a page, by name.
std::map<std::string, std::vector<double>> unpacked(const json& channels, const std::string& bytes) {
  std::map<std::string, std::vector<double>> all;
  std::size_t at = 0;
  for (const json& channel : channels) {
    std::vector<double>& values = all[channel[0].get<std::string>()];
    double sum = 0;
    for (std::size_t i = 0; i < channel[3].get<std::size_t>(); ++i) {
      double zigzag = 0;
      double weight = 1;
      unsigned byte = 128;
      for (; byte > 127; weight *= 128) {
        byte = static_cast<unsigned char>(bytes.at(at++));
        zigzag += (byte & 127U) * weight;
      }
      sum += std::fmod(zigzag, 2) == 0 ? zigzag / 2 : -(zigzag + 1) / 2;
      values.push_back(sum * channel[2].get<double>());
    }
  }
  EXPECT_EQ(at, bytes.size());
  return all;
}

/// A page and what is in it.
struct Opened {
  json meta;
  std::map<std::string, std::vector<double>> channels;
  explicit Opened(const report::PageData& data)
      : meta(json::parse(data.meta)), channels(unpacked(meta["channels"], inflated(from_base64(data.data)))) {}
};

report::PageData data_of(const Scenario& s, const Recording& r, std::size_t most = report::kMostData) {
  const report::Summary summary = report::summarise(s, r, 1.5);
  return report::page_data(s, r, summary, report::verdict(s, r, summary, report::overlaps(s, r)), {}, most);
}

std::vector<unsigned> bytes_of(const report::Packing& packing) {
  std::vector<unsigned> all;
  for (const char c : packing.bytes()) all.push_back(static_cast<unsigned char>(c));
  return all;
}

/// The same numbers as in the test of the page's own reader: written down by hand, from differences 0, 1, -2, 65, -128, 8255,
/// -16383, 1008192.
TEST(Packing, BytesAreThese) {
  report::Packing packing;
  packing.add("x", "", 1, {0, 1, -1, 64, -64, 8191, -8192, 1000000});
  EXPECT_EQ(bytes_of(packing), (std::vector<unsigned>{0x00, 0x02, 0x03, 0x82, 0x01, 0xff, 0x01, 0xfe, 0x80, 0x01, 0xfd, 0xff,
                                                      0x01, 0x80, 0x89, 0x7b}));
}

TEST(Packing, WhatIsNoNumberRepeatsTheOneBefore) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double most = std::numeric_limits<double>::infinity();
  report::Packing packing;
  packing.add("x", "", 0.5, {nan, 2, nan, most, 2.5});
  EXPECT_EQ(bytes_of(packing), (std::vector<unsigned>{0, 8, 0, 0, 2}));
  report::Packing huge;
  huge.add("x", "", 1, {1e300, -1e300});
  const json channels = json::array({json::array({"x", "", 1, 2})});
  EXPECT_EQ(unpacked(channels, huge.bytes()).at("x"), (std::vector<double>{0x1p50, -0x1p50}));
}

TEST(Packing, Base64IsThatOfTheRfc) {  // RFC 4648, 10
  for (const auto& [bytes, text] : {std::pair("", ""),
                                    {"f", "Zg=="},
                                    {"fo", "Zm8="},
                                    {"foo", "Zm9v"},
                                    {"foob", "Zm9vYg=="},
                                    {"fooba", "Zm9vYmE="},
                                    {"foobar", "Zm9vYmFy"}}) {
    EXPECT_EQ(report::base64(bytes), text);
  }
  EXPECT_EQ(report::base64("\xff\xfe\xfb"), "//77");
}

TEST(Packing, SmallNumbersHaveFinerQuanta) {
  EXPECT_EQ(report::quantum_of(5, 1e-3), 1e-3);
  EXPECT_EQ(report::quantum_of(0, 1e-3), 1e-3) << "nothing ever moved";
  EXPECT_EQ(report::quantum_of(0.9, 1e-3), 5e-4);
  EXPECT_EQ(report::quantum_of(0.012, 1e-3), 1e-5);
  EXPECT_EQ(report::quantum_of(0.4, 1e-3), 2e-4);
  EXPECT_EQ(report::quantum_of(std::numeric_limits<double>::infinity(), 1e-3), 1e-3);
}

TEST(PageData, EverySignalComesBackToHalfAQuantum) {
  const Scenario s =
      shipped("rubble.yaml", {"duration=0.3", "contact.law=bullet",
                              "trace.columns=[joint.*, base.*, com.*, contact.*, energy.*, box.*]", "ground.boxes.0.mass=0.1"});
  const Recording r = run(s);
  const Opened page(data_of(s, r));
  std::size_t compared = 0;
  for (const json& channel : page.meta["channels"]) {
    const std::string name = channel[0];
    const Series told = r.series(name);
    if (told.empty()) continue;  // a foot
    ++compared;
    const std::vector<double>& values = page.channels.at(name);
    ASSERT_EQ(values.size(), told.size()) << name;
    const double half = 0.5 * channel[2].get<double>();
    // Rounding: of the quotient and of the product, 2^-53 of the number each.
    for (std::size_t k = 0; k < values.size(); ++k) EXPECT_NEAR(values[k], told[k], half + 4e-16 * std::abs(told[k])) << name;
  }
  EXPECT_GT(compared, 22U * 6);
  EXPECT_EQ(page.channels.count("box.0.qw"), 1U);
  EXPECT_EQ(page.meta["ground"]["boxes"][0]["moves"], 0);
  EXPECT_EQ(page.meta["ground"]["boxes"][1]["moves"], -1);
}

Quat quaternion_of(const json& pose) { return {pose[3], pose[4], pose[5], pose[6]}; }
Vec3 vector_of(const json& list) { return Vec3(list[0].get<double>(), list[1].get<double>(), list[2].get<double>()); }

/// Poses of the bodies of a page, by name, as a page computes them.
std::map<std::string, std::pair<Vec3, Quat>> placed_bodies(const json& bodies, const Vec3& position, const Quat& orientation,
                                                           const std::vector<double>& angles) {
  std::vector<std::pair<Vec3, Quat>> at;
  std::map<std::string, std::pair<Vec3, Quat>> named;
  for (const json& body : bodies) {
    const int parent = body["parent"];
    auto [p, q] = parent < 0 ? std::pair(position, orientation) : at.at(static_cast<std::size_t>(parent));
    const auto go = [&p = p, &q = q](const json& pose) {
      p += q * vector_of(pose);
      q = q * quaternion_of(pose);
    };
    go(body["pre"]);
    if (const int joint = body["joint"]; joint >= 0)
      q = q * Quat(Eigen::AngleAxisd(angles.at(static_cast<std::size_t>(joint)), vector_of(body["axis"])));
    go(body["post"]);
    at.emplace_back(p, q);
    named[body["name"]] = at.back();
  }
  return named;
}

/// A turn by so little is all that lies between them.
double turned_apart(const Quat& a, const Quat& b) { return (a.conjugate() * b).vec().norm(); }

constexpr double kPlaces = 1e-12;  // m, rad: rounding (2^-53) of a product of up to 100 poses, some m from the origin

TEST(PageData, BodiesAreWhereTheTraceHasThem) {
  std::size_t scenarios = 0;
  for (const auto& file : std::filesystem::directory_iterator(kScenarios)) {
    if (file.path().extension() != ".yaml") continue;
    const Scenario s = shipped(file.path().filename().string(), {"duration=0.02", "trace.columns=[\"*\"]"});
    const Recording r = run(s);
    const json bodies = json::parse(data_of(s, r).meta)["bodies"];
    ASSERT_EQ(bodies.size(), s.robot->bodies.size());
    ++scenarios;
    for (const std::size_t row : {std::size_t{0}, r.rows() - 1}) {
      const RobotState state = r.state(*s.robot, row);
      for (const auto& [name, pose] : placed_bodies(bodies, state.position, state.orientation, state.q)) {
        const auto at = [&, &name = name](const char* axis) { return r.series("body." + name + "." + axis)[row]; };
        EXPECT_LT((pose.first - Vec3(at("x"), at("y"), at("z"))).norm(), kPlaces) << s.name << ' ' << name;
        EXPECT_LT(turned_apart(pose.second, Quat(at("qw"), at("qx"), at("qy"), at("qz"))), kPlaces) << s.name << ' ' << name;
      }
    }
  }
  EXPECT_GT(scenarios, 4U);
}

TEST(PageData, BodiesOfRandomRobotsAreWhereKinematicsHasThem) {
  RandomRobots random(15);
  for (int i = 0; i < 40; ++i) {
    const Robot robot = random.robot();
    const RobotState state = random.state(robot, Base::floating);
    Kinematics k(robot);
    k.update(robot, state);
    const report::RobotTree tree(robot);
    const json bodies = json::parse(tree.bodies().dump());
    const auto placed = placed_bodies(bodies, state.position, state.orientation, state.q);
    ASSERT_EQ(placed.size(), robot.bodies.size());
    for (std::size_t b = 0; b < robot.bodies.size(); ++b) {
      const Body& body = robot.bodies[b];
      const auto& [p, q] = placed.at(body.name);
      EXPECT_EQ(bodies[tree.place(b)]["name"], body.name);
      EXPECT_LT((p - k.point(body.link, body.in_link.p)).norm(), kPlaces) << i << ' ' << body.name;
      EXPECT_LT(turned_apart(q, Quat(k.R[body.link] * body.in_link.R)), kPlaces) << i << ' ' << body.name;
    }
    for (std::size_t j = 0; j < robot.joints.size(); ++j)
      EXPECT_EQ(bodies[tree.place(tree.moved_by(j))]["joint"], j) << "the body that a joint moves hangs on that joint";
  }
}

TEST(PageData, TheSameRunGivesTheSameBytes) {
  const Scenario s = shipped("caterpillar.yaml", {"duration=0.2", "physics.engine=articulated"});
  const std::string first = report::page(data_of(s, run(s)));
  EXPECT_TRUE(report::page(data_of(s, run(s))) == first);
  EXPECT_EQ(json::parse(data_of(s, run(s)).meta)["summary"].count("wall_time"), 0U);
}

std::size_t count_of(const std::string& text, std::string_view part) {
  std::size_t found = 0;
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += part.size()) ++found;
  return found;
}

TEST(PageData, ANameEndsNoScript) {
  Scenario s = shipped("pendulum.yaml", {"duration=0.02"});
  s.name = "</script><!--<script> /*DATA*/ & \"\\ \xff";
  const report::PageData data = data_of(s, run(s));
  EXPECT_EQ(count_of(data.meta, "<"), 0U);
  const std::string page = report::page(data);
  const std::string empty(report::page_template());
  for (const char* part : {"</script", "<!--", "<script"}) EXPECT_EQ(count_of(page, part), count_of(empty, part)) << part;
  EXPECT_EQ(json::parse(data.meta)["name"], "</script><!--<script> /*DATA*/ & \"\\ \xef\xbf\xbd")
      << "no UTF-8: the sign for it";
  EXPECT_TRUE(contains(page, "&lt;/script&gt;&lt;!--&lt;script&gt; /*DATA*/ &amp; \"\\ "));
  EXPECT_TRUE(contains(page, data.data)) << "the name's mark is left alone, and the page's own is filled in";
}

TEST(PageData, ABigRunShowsFewerRows) {
  const Scenario s = shipped("caterpillar.yaml", {"duration=0.503", "physics.engine=articulated"});
  const Recording r = run(s);
  const report::PageData whole = data_of(s, r);
  const Opened page(data_of(s, r, whole.data.size() / 3));
  const json& meta = page.meta;
  const std::size_t rows = meta["rows"];
  EXPECT_LT(rows, r.rows() / 2);
  const std::vector<double>& t = page.channels.at("t");
  ASSERT_EQ(t.size(), rows);
  EXPECT_NEAR(t[1], meta["period"].get<double>(), 1e-6);
  EXPECT_NEAR(t.back(), 0.503, 1e-6) << "the last row stays";
  EXPECT_TRUE(contains(meta["missing"].back(), "row is shown, to keep the page small")) << meta["missing"];
  EXPECT_EQ(Opened(whole).meta["rows"], r.rows());
}

TEST(PageData, ARobotThatHasNotRun) {
  const Scenario s = shipped("hexapod.yaml");
  const Recording start = report::start_row(s);
  report::Verdict none;
  none.word = "not judged";
  const Opened page(report::page_data(s, start, report::summarise(s, start, 0), none));
  EXPECT_EQ(page.meta["outcome"], "not run");
  EXPECT_EQ(page.meta["rows"], 1);
  EXPECT_EQ(page.meta["verdict"]["verdict"], "not judged");
  EXPECT_EQ(page.meta["verdict"]["checks"], json::array());
  EXPECT_EQ(page.meta["missing"], json::array()) << page.meta["missing"];
  EXPECT_EQ(page.meta["cycle"], nullptr);
  EXPECT_EQ(page.channels.count("joint.0.torque"), 0U);
  EXPECT_EQ(page.meta["faces"]["mtran/active"].size(), 3U);
  EXPECT_EQ(page.meta["docks"].size(), 10U);
  const Opened ran(data_of(s, run(shipped("hexapod.yaml", {"duration=0.01"}))));
  for (const char* channel : {"base.z", "com.z", "joint.3.angle"})
    EXPECT_EQ(page.channels.at(channel)[0], ran.channels.at(channel)[0]) << channel << " is that of the first row of a run";
}

TEST(PageData, ABodyWithoutJoints) {
  const Folder folder;
  folder.write("ball.yaml",
               "gaitlab_module: 1\nname: ball\nbodies: {ball: {mass: 1, com: [0, 0, 0], inertia: [1e-3, 1e-3, 1e-3, 0, 0, 0], "
               "shape: [{sphere: 0.1}]}}\n");
  const Scenario s = read_scenario(folder.write("s.yaml",
                                                "gaitlab: 1\nname: ball\nrobot: {modules: ball.yaml, position: [0, 0, "
                                                "2]}\nground: {type: none}\nduration: 0.1\ntrace: {columns: [base.*]}\n"),
                                   {}, catalog());
  const Opened page(data_of(s, run(s)));
  for (const char* list : {"joints", "motors", "docks", "contacts", "feet", "phases"})
    EXPECT_EQ(page.meta[list], json::array()) << list;
  EXPECT_EQ(page.meta["bodies"].size(), 1U);
  EXPECT_NEAR(page.channels.at("base.z").back(), 2 - 0.5 * 9.81 * 0.01, 1e-4) << "free fall, to 0.02 mm and the step's order";
}

TEST(PageData, NoFolderIsNamed) {
  const std::string library = std::string(GAITLAB_BINARY_DIR) + "/plugins/wave.so";
  Catalog with = app::standard_catalog();
  const Scenario s =
      read_scenario(kScenarios + "caterpillar.yaml", {"plugins=['" + library + "']", "duration=0.02", "cpg.type=wave"}, with);
  const report::PageData data = data_of(s, run(s));
  EXPECT_FALSE(contains(data.meta, GAITLAB_BINARY_DIR));
  EXPECT_FALSE(contains(data.meta, GAITLAB_SOURCE_DIR));
  EXPECT_TRUE(contains(json::parse(data.meta)["scenario"], "path: wave.so"));
}

TEST(PageMotors, AreThoseOfEq1And2) {
  const Scenario s = shipped("caterpillar.yaml", {"actuator.i_max={default: 1.2, m0/active: 0.3}"});
  const report::Motors motors = report::motors(s, 1);
  ASSERT_EQ(motors.of_joint.size(), s.robot->joints.size());
  ASSERT_EQ(motors.kinds.size(), 2U);
  EXPECT_EQ(motors.of_joint[0], 0U);
  EXPECT_EQ(motors.of_joint[1], 1U);
  EXPECT_EQ(motors.of_joint[5], 1U);
  const actuators::DcMotorActuator::Settings shipped_motor;
  const double R = shipped_motor.R[0];
  const double Kt = shipped_motor.Kt[0];
  const double Ks = shipped_motor.Ks[0];
  const double n = shipped_motor.gear[0];
  const double eta = shipped_motor.efficiency[0];
  const double u = shipped_motor.u_max[0];
  for (const auto& [kind, largest] : {std::pair(0, 0.3), {1, 1.2}}) {
    const report::Envelope& motor = motors.kinds[static_cast<std::size_t>(kind)];
    EXPECT_EQ(motor.unit, "V");
    EXPECT_EQ(motor.command, u);
    EXPECT_NEAR(motor.current.value(), largest, 1e-12) << "rounding";
    EXPECT_NEAR(motor.no_load.value(), u / (Ks * n), 1e-9) << "what sixty halvings leave, and rounding";
    EXPECT_NEAR(motor.rest.value(), eta * Kt * n * std::min(largest, u / R), 1e-12);
    ASSERT_EQ(motor.speed.size(), motor.most.size());
    EXPECT_GE(motor.speed.back(), motor.no_load.value());
    for (std::size_t i = 0; i < motor.speed.size(); ++i) {
      const double w = motor.speed[i];
      EXPECT_NEAR(motor.most[i], eta * Kt * n * std::clamp((u - Ks * n * w) / R, -largest, largest), 1e-12);
      EXPECT_NEAR(motor.least[i], eta * Kt * n * std::clamp((-u - Ks * n * w) / R, -largest, largest), 1e-12);
    }
  }
}

TEST(PageMotors, OfATorqueSource) {
  const std::vector<std::string> torque{"actuator={type: torque, limit: 1.5}", "controller={type: pid, unit: N m, Kp: 5}"};
  const report::Motors bounded = report::motors(shipped("caterpillar.yaml", torque), 4);
  ASSERT_EQ(bounded.kinds.size(), 1U);
  EXPECT_EQ(bounded.kinds[0].unit, "N m");
  EXPECT_EQ(bounded.kinds[0].command, 1.5);
  EXPECT_EQ(bounded.kinds[0].rest, 1.5);
  EXPECT_FALSE(bounded.kinds[0].no_load);
  EXPECT_FALSE(bounded.kinds[0].current);
  EXPECT_EQ(bounded.kinds[0].speed.back(), 4);
  for (const double least : bounded.kinds[0].least) EXPECT_EQ(least, -1.5);
  const report::Motors free =
      report::motors(shipped("caterpillar.yaml", {"actuator={type: torque}", "controller={type: pid, unit: N m, Kp: 5}"}), 4);
  ASSERT_EQ(free.kinds.size(), 1U);
  EXPECT_FALSE(free.kinds[0].command);
  EXPECT_FALSE(free.kinds[0].rest);
  EXPECT_TRUE(free.kinds[0].most.empty());
}

/// A robot that stands: the ground carries its weight, below its centre of mass.
TEST(PageFeet, CarryTheWeightBelowTheCentreOfMass) {
  const std::vector<std::string> stands{"duration=1.5", "physics.engine=articulated", "cpg={type: sine, amplitude: 0}",
                                        "trace.columns=[joint.*, base.*, com.*, contact.*]"};
  const Scenario s = shipped("hexapod.yaml", stands);
  const Recording r = run(s);
  const Opened page(data_of(s, r));
  const std::size_t feet = page.meta["feet"].size();
  ASSERT_EQ(feet, 6U);
  double weight = 0;
  Vec3 moment = Vec3::Zero();
  for (std::size_t i = 0; i < feet; ++i) {
    const auto end = [&](const char* what) { return page.channels.at(fmt::format("foot.{}.{}", i, what)).back(); };
    weight += end("fz");
    moment += end("fz") * Vec3(end("x"), end("y"), end("z"));
  }
  EXPECT_NEAR(weight, page.meta["weight"].get<double>(), 0.1) << "six feet to 0.01 N, and what still sways";
  const Vec3 below = moment / weight;
  EXPECT_NEAR(below.x(), r.com(r.rows() - 1).x(), 1e-3) << "places to 0.25 mm, forces to 0.01 N, and what still sways";
  EXPECT_NEAR(below.y(), r.com(r.rows() - 1).y(), 1e-3);
  EXPECT_NEAR(below.z(), 0, 1e-3) << "the plane, into which feet sink by less";
}

TEST(PageFeet, WithoutContactColumnsHaveTheirLoad) {
  const Scenario s = shipped("hexapod.yaml", {"duration=0.1", "physics.engine=articulated", "trace.columns=[joint.*]"});
  const Recording r = run(s);
  const Opened page(data_of(s, r));
  ASSERT_EQ(page.meta["feet"].size(), 6U);
  EXPECT_EQ(page.meta["feet"][0]["name"], "m5/passive");
  EXPECT_EQ(page.channels.count("foot.0.fx") + page.channels.count("foot.0.x"), 0U);
  EXPECT_NEAR(page.channels.at("foot.0.fz").back(), r.series("load.5").back(), 0.01);
  EXPECT_EQ(page.meta["missing"].size(), 2U) << page.meta["missing"];
}

TEST(PageLoads, AreThoseAtControlTicks) {
  const Scenario s = shipped("hexapod.yaml", {"duration=0.3", "physics.engine=articulated", "trace.columns=[joint.*]"});
  Simulation simulation({&s, 1}, Loads::recorded);
  simulation.run();
  const Recording r = simulation.take_recording(0);
  const Opened page(data_of(s, r));
  EXPECT_EQ(page.meta["missing"], json::array());
  ASSERT_EQ(page.meta["feet"].size(), 6U);
  ASSERT_EQ(page.meta["docks"].size(), 10U);
  // 0.15 s is a control tick and a trace tick: there nothing lies between.
  const std::size_t tick = 10;
  const std::size_t row = 30;
  ASSERT_NEAR(r.loads.at(tick, 0), 0.15, 1e-9);
  std::size_t compared = 0;
  const auto compare = [&](const std::string& channel, const std::string& column, double half) {
    const std::size_t at = r.loads.find(column);
    ASSERT_LT(at, r.loads.columns.size()) << column;
    EXPECT_NEAR(page.channels.at(channel)[row], r.loads.at(tick, at), half) << channel << ": half of the largest quantum";
    ++compared;
  };
  for (std::size_t m = 1; m <= 10; ++m) {
    const std::string dock = fmt::format("dock.{}.", m - 1);
    EXPECT_EQ(page.meta["docks"][m - 1]["module"], m);
    for (const char* force : {"tension", "shear"}) compare(dock + force, fmt::format("dock.{}.{}", m, force), 5e-3);
    for (const char* moment : {"bending", "torsion"}) compare(dock + moment, fmt::format("dock.{}.{}", m, moment), 5e-4);
  }
  for (std::size_t i = 0; i < 6; ++i) {
    const std::string name = "foot." + page.meta["feet"][i]["name"].get<std::string>() + ".";
    for (const char* axis : {"fx", "fy", "fz"}) compare(fmt::format("foot.{}.{}", i, axis), name + axis, 0.01);
    for (const char* axis : {"x", "y", "z"}) compare(fmt::format("foot.{}.{}", i, axis), name + axis, 2.5e-4);
  }
  compare("stability", "stability", 2.5e-4);
  EXPECT_EQ(compared, 77U);
}

TEST(FirstHarmonic, IsThatOfASineWithAMean) {
  // A period that the rows do not divide; the window is its last two.
  Trace table;
  table.columns = {{"t", "s", ""}, {"x", "rad", ""}, {"y", "rad", ""}};
  const double period = 1.2345;
  for (int k = 0; k <= 600; ++k) {
    const double t = 0.005 * k;
    const double turn = 2 * std::numbers::pi * t / period;
    for (const double value : {t, 0.3 + 0.5 * std::sin(turn + 0.7), -0.2 * std::sin(turn)}) table.values.push_back(value);
  }
  const MotionCycle cycle{.found = true, .from = 0.1, .period = period, .error = 0};
  const auto found = report::first_harmonics(cycle, Series(table, 0), {Series(table, 1), Series(table, 2)});
  ASSERT_EQ(found.size(), 2U);
  EXPECT_NEAR(found[0].amplitude, 0.5, 1e-12) << "rounding of some hundred terms";
  EXPECT_NEAR(found[0].phase, 0.7, 1e-12);
  EXPECT_NEAR(found[1].amplitude, 0.2, 1e-12);
  EXPECT_NEAR(std::abs(found[1].phase), std::numbers::pi, 1e-12);
  EXPECT_TRUE(report::first_harmonics({}, Series(table, 0), {Series(table, 1)}).empty());
}

}  // namespace
}  // namespace gaitlab::test
