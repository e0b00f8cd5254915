// Legs as groups of joints: wherever a pattern is allowed, for docked and imported robots.
#include <set>

#include "core/scenario/resolved.h"
#include "core/scenario/sensor_section.h"
#include "interchange/robot_module.h"
#include "tests/messages.h"
#include "tests/program/fixture.h"

namespace gaitlab::test {
namespace {

/// Entries `JOINT: value` of the joints of legs that `wanted` accepts.
template <class Wanted>
std::string entries(const Scenario& s, const Wanted& wanted, double value) {
  std::string text;
  for (const Leg& leg : plugin_info(s).legs) {
    for (std::size_t k = 0; k < leg.joints.size(); ++k) {
      if (wanted(leg, k)) text += fmt::format(", {}: {}", s.robot->joints[static_cast<std::size_t>(leg.joints[k])].name, value);
    }
  }
  return text;
}

TEST(LegGroups, StandWherePatternsStand) {
  const Scenario s = shipped("hexapod.yaml");
  ASSERT_EQ(plugin_info(s).legs.size(), 6U);
  const auto same = [&](const std::string& groups, const std::string& names) {
    EXPECT_EQ(resolved(shipped("hexapod.yaml", {"controller.Kp={default: 9, " + groups + "}"})),
              resolved(shipped("hexapod.yaml", {"controller.Kp={default: 9" + names + "}"})))
        << groups;
  };
  same("leg:front_left: 11", entries(
                                 s, [](const Leg& leg, std::size_t) { return leg.name == "front_left"; }, 11));
  same("leg:middle_right/1: 11",
       entries(
           s, [](const Leg& leg, std::size_t k) { return leg.name == "middle_right" && k == 1; }, 11));
  same("\"leg:*_left\": 11, \"leg:*_right\": 12", entries(
                                                      s, [](const Leg& leg, std::size_t) { return leg.side > 0; }, 11) +
                                                      entries(
                                                          s, [](const Leg& leg, std::size_t) { return leg.side < 0; }, 12));
  same("\"leg:*/0\": 11", entries(
                              s, [](const Leg&, std::size_t k) { return k == 0; }, 11));
  EXPECT_FALSE(contains(resolved(s), "groups:")) << "they follow again";
  const Scenario group = shipped("hexapod.yaml", {"groups={front: \"leg:front_*\"}"});
  EXPECT_EQ(group.groups.front().joints.size(), 4U) << "also as members of groups";
}

TEST(LegGroups, OfAnImportedRobot) {
  const Folder folder;
  folder.write("dog.yaml", interchange::module_of_robot(kScenarios + "robots/dog.urdf", "dog").text);
  const std::string file = folder.write("dog.scenario.yaml",
                                        "{gaitlab: 1, robot: {modules: ./dog.yaml}, initial: {angles: {default: 0.3, "
                                        "\"*knee\": -1.2}}, cpg: {type: sine, frequency: 1}, contact: {on: all}, duration: 1}");
  const auto with = [&](const std::string& knees) {
    return resolved(read_scenario(file, {"controller.Kp={default: 30, \"" + knees + "\": 40}"}, catalog()));
  };
  EXPECT_EQ(with("leg:*/2"), with("*knee"));
  EXPECT_NE(with("leg:*/2"), with("leg:*/1"));
}

/// Columns of a leg: the load of its bodies, and the foot, which is where the search found it as long as all angles are 0.
TEST(LegColumns, LoadAndFoot) {
  const Scenario s = shipped("hexapod.yaml", {"duration=1", "trace.columns=[\"leg.*\", \"load.*\"]"});
  const Recording record = run(s);
  const Table table(record.trace);
  const RobotInfo robot = plugin_info(s);
  double most = 0;
  for (const Leg& leg : robot.legs) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(table.at(0, fmt::format("leg.{}.{}", leg.name, "xyz"[axis])), leg.foot[axis], 1e-12) << leg.name;
    std::set<std::size_t> modules;
    for (const std::int64_t body : leg.bodies) modules.insert(s.robot->bodies[static_cast<std::size_t>(body)].module);
    for (std::size_t row = 0; row < record.trace.rows(); ++row) {
      double load = 0;
      for (const std::size_t m : modules) load += table.at(row, fmt::format("load.{}", m));
      EXPECT_NEAR(table.at(row, "leg." + leg.name + ".load"), load, 1e-9 * load) << leg.name << " in row " << row;
      most = std::max(most, load);
    }
  }
  EXPECT_GT(most, 1) << "they stand";
}

TEST(LegGroups, MessagesHaveTheNearestLeg) {
  const auto refused = [](const char* name, const char* set) { return message_of([&] { shipped(name, {set}); }); };
  EXPECT_TRUE(contains(refused("hexapod.yaml", "controller.Kp={leg:frontleft: 3}"),
                       "no joint 'leg:frontleft'; did you mean 'leg:front_left'?; each has at most 2 joints"));
  EXPECT_TRUE(
      contains(refused("hexapod.yaml", "controller.Kp={\"leg:*/7\": 3}"), "no joint 'leg:*/7'; known legs: leg:front_left"));
  EXPECT_TRUE(contains(refused("caterpillar.yaml", "controller.Kp={leg:front_left: 3}"),
                       "no joint 'leg:front_left'; the robot has no legs"));
}

}  // namespace
}  // namespace gaitlab::test
