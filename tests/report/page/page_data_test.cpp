// Tests of the data of a page: numbers, robot, large and small runs, hostile names.
#include "report/page/page_data.h"

#include "report/analysis/start_row.h"
#include "report/page/robot_tree.h"
#include "tests/folders.h"
#include "tests/random_robots.h"
#include "tests/report/page/opened_page.h"

namespace gaitlab::test {
namespace {

using nlohmann::json;

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
    if (told.empty()) continue;  // channel of a foot, which is not a trace column
    ++compared;
    const std::vector<double>& values = page.channels.at(name);
    ASSERT_EQ(values.size(), told.size()) << name;
    const double half = 0.5 * channel[2].get<double>();
    // The tolerance is half a quantum, and the rounding errors of a quotient and a product, 2^-53 of the number each.
    for (std::size_t k = 0; k < values.size(); ++k) EXPECT_NEAR(values[k], told[k], half + 4e-16 * std::abs(told[k])) << name;
  }
  EXPECT_GT(compared, 22U * 6);
  EXPECT_EQ(page.channels.count("box.0.qw"), 1U);
  EXPECT_EQ(page.meta["ground"]["boxes"][0]["moves"], 0);
  EXPECT_EQ(page.meta["ground"]["boxes"][1]["moves"], -1);
}

Quat quaternion_of(const json& pose) { return {pose[3], pose[4], pose[5], pose[6]}; }
Vec3 vector_of(const json& list) { return Vec3(list[0].get<double>(), list[1].get<double>(), list[2].get<double>()); }

/// Poses of the bodies by name, computed from the data of a page as the page does.
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

/// Half of the angle between two orientations, for small angles, rad.
double turned_apart(const Quat& a, const Quat& b) { return (a.conjugate() * b).vec().norm(); }

constexpr double kPlaces = 1e-12;  // m, rad; rounding errors of a product of up to 100 poses, some m from the origin

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
  EXPECT_TRUE(contains(meta["missing"].back(), "is shown, to keep the page small")) << meta["missing"];
  EXPECT_EQ(Opened(whole).meta["rows"], r.rows());
}

TEST(PageData, OfALargeHeightfieldSaysWhichHeightsAreDrawn) {
  const Folder folder;
  std::string rows;
  for (int y = 0; y < 201; ++y) rows += "0 0 0\n";
  const std::string file = folder.write("flat.txt", rows);
  const Scenario s = shipped("pendulum.yaml", {"duration=0.02", "ground.type=heightfield", "ground.heightfield.file=" + file});
  const Opened page(data_of(s, run(s)));
  EXPECT_EQ(page.meta["missing"].back(), "only one height in 2 along x and y is drawn; the robot walked on all heights");
  EXPECT_EQ(page.meta["ground"]["heightfield"]["ny"], 101);
}

TEST(PageData, ARobotThatHasNotRun) {
  const Scenario s = shipped("hexapod.yaml");
  const Recording start = report::start_row(s);
  report::Verdict none;
  none.word = Word::not_judged;
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

/// Entry `longest` of a page: the joint that is at a limit for the largest share of time.
json longest_of(const Scenario& s) { return json::parse(data_of(s, run(s)).meta)["verdict"]["longest"]; }

TEST(PageData, TheJointThatIsLongestAtALimitIsThatOfBothLimitsTogether) {
  const Scenario s =
      shipped("caterpillar.yaml", {"duration=5", "physics.engine=articulated", "actuator.i_max=0.35", "actuator.u_max=6"});
  const Recording r = run(s);
  const report::Summary summary = report::summarise(s, r, 0);
  double most = 0;
  std::string name;
  for (std::size_t j = 0; j < s.robot->joints.size(); ++j) {
    const JudgedJoint& joint = summary.judged.joints[j];
    if (const double share = joint.voltage_limited + joint.current_limited; share > most) {
      most = share;
      name = s.robot->joints[j].name;
    }
  }
  ASSERT_GT(most, 0);
  const json longest = longest_of(s);
  EXPECT_EQ(longest["joint"], name);
  EXPECT_EQ(longest["voltage"].get<double>() + longest["current"].get<double>(), most);
  EXPECT_EQ(longest_of(shipped("caterpillar.yaml",
                               {"duration=0.5", "physics.engine=articulated", "actuator.i_max=50", "actuator.u_max=500"})),
            nullptr);
}

TEST(PageData, TheSentenceBehindTheWordIsTheTerminals) {
  const Scenario s = shipped("caterpillar.yaml", {"duration=1", "physics.engine=articulated"});
  const Recording r = run(s);
  const report::Summary summary = report::summarise(s, r, 0);
  const report::Verdict verdict = report::verdict(s, r, summary, report::overlaps(s, r));
  const json told = json::parse(report::page_data(s, r, summary, verdict).meta)["verdict"];
  EXPECT_NE(verdict.why(), "");
  EXPECT_EQ(told["why"], verdict.why());
  for (const json& check : told["checks"]) EXPECT_NE(check["advice"], "") << check["id"];
}

TEST(PageData, FeetGoByTheirLegs) {
  const auto titles = [](const Scenario& s) {
    std::map<std::string, std::string> all;
    Simulation simulation({&s, 1}, Loads::recorded);
    simulation.run();
    const json meta = json::parse(data_of(s, simulation.take_recording(0)).meta);
    for (const json& foot : meta["feet"]) all[foot["name"]] = foot["title"];
    return all;
  };
  const auto legs = titles(shipped("hexapod.yaml", {"duration=2.5", "physics.engine=articulated"}));
  EXPECT_EQ(legs.size(), 6U);
  for (const auto& [name, title] : legs)
    EXPECT_TRUE(title.ends_with(" left") || title.ends_with(" right")) << name << ": " << title;
  for (const auto& [name, title] : titles(shipped("caterpillar.yaml", {"duration=0.1", "physics.engine=articulated"})))
    EXPECT_EQ(title, name) << "a caterpillar has no legs";
}

// The elements of a passive block in scenarios/modules/mtran.yaml, section contacts: vertices of the end face (points), and two
// spheres.
TEST(PageData, FeetHaveTheContactElementsOfTheirBody) {
  const json vertices = {{0.0325, 0.0325, 0.0325, 0.0},
                         {0.0325, 0.0325, -0.0325, 0.0},
                         {0.0325, -0.0325, 0.0325, 0.0},
                         {0.0325, -0.0325, -0.0325, 0.0}};
  const json spheres = {{0.0, 0.0325, 0.0, 0.0325}, {0.0, -0.0325, 0.0, 0.0325}};
  json all = vertices;
  all.insert(all.end(), spheres.begin(), spheres.end());
  for (const auto& [file, expected] : {std::pair("hexapod.yaml", vertices), std::pair("caterpillar.yaml", all)}) {
    const Scenario s = shipped(file, {"duration=0.5", "physics.engine=articulated"});
    Simulation simulation({&s, 1}, Loads::recorded);
    simulation.run();
    const json meta = json::parse(data_of(s, simulation.take_recording(0)).meta);
    std::size_t passive = 0;
    for (const json& foot : meta["feet"]) {
      if (!foot["name"].get<std::string>().ends_with("/passive")) continue;
      ++passive;
      ASSERT_EQ(foot["points"].size(), expected.size()) << foot["name"];
      for (std::size_t i = 0; i < expected.size(); ++i) {
        for (std::size_t k = 0; k < 4; ++k)
          EXPECT_NEAR(foot["points"][i][k].get<double>(), expected[i][k].get<double>(), 1e-9) << foot["name"] << " " << i;
      }
    }
    EXPECT_GT(passive, 2U) << file;
  }
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
  const std::string library = std::string(gaitlab::test::build_folder()) + "/plugins/wave.so";
  Catalog with = app::standard_catalog();
  const Scenario s =
      read_scenario(kScenarios + "caterpillar.yaml", {"plugins=['" + library + "']", "duration=0.02", "cpg.type=wave"}, with);
  const report::PageData data = data_of(s, run(s));
  EXPECT_FALSE(contains(data.meta, gaitlab::test::build_folder()));
  EXPECT_FALSE(contains(data.meta, gaitlab::test::source_folder()));
  EXPECT_TRUE(contains(json::parse(data.meta)["scenario"], "path: wave.so"));
}

}  // namespace
}  // namespace gaitlab::test
