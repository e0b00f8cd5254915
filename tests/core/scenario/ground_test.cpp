// The section `ground`: what is read, what is refused and where, and that the resolved scenario holds all of it.
#include "core/scenario/resolved.h"
#include "tests/core/scenario/fixture.h"

namespace gaitlab::fakes {
namespace {

class GroundSection : public ScenarioTest {
 protected:
  std::string wrong(const std::string& ground) {
    std::string text = error(kShort + "ground: " + ground + "\n");
    for (std::size_t at = text.find("DIR/"); at != std::string::npos; at = text.find("DIR/")) text.erase(at, 4);
    return text;
  }
};

TEST_F(GroundSection, ReadsBoxes) {
  const Scenario s = read(kShort + R"(ground:
  type: boxes
  friction: 0.5
  boxes:
    - {center: [1, 2, 3], size: [0.1, 0.2, 0.3], rpy: [0, 0, 0.1]}
    - {size: [1, 1, 1], friction: 0.2, mass: 0}
)");
  ASSERT_EQ(s.ground.boxes.size(), 2U);
  EXPECT_EQ(s.ground.kind, Ground::Kind::boxes);
  EXPECT_EQ(s.ground.boxes[0].center, Vec3(1, 2, 3));
  EXPECT_EQ(s.ground.boxes[0].size, Vec3(0.1, 0.2, 0.3));
  EXPECT_EQ(s.ground.boxes[0].R, rpy({0, 0, 0.1}));
  EXPECT_EQ(s.ground.boxes[0].friction, 0.5);  // the ground's
  EXPECT_EQ(s.ground.boxes[1].friction, 0.2);
  EXPECT_NE(resolved(s).find("ground:\n  type: boxes\n  friction: 0.5\n  boxes:\n"
                             "    - {center: [1, 2, 3], size: [0.1, 0.2, 0.3], rpy: [0, 0, 0.1], friction: 0.5, mass: 0}\n"
                             "    - {center: [0, 0, 0], size: [1, 1, 1], rpy: [0, 0, 0], friction: 0.2, mass: 0}\n"),
            std::string::npos)
      << resolved(s);
  expect_stable(s);
}

TEST_F(GroundSection, ReadsAHeightfieldInTheScenarioAndFromAFile) {
  const Scenario s =
      read(kShort + "ground: {type: heightfield, heightfield: {values: [[0, 0.1, 0.2], [1, 2, 3e-1]], spacing: 0.5}}\n");
  EXPECT_EQ(s.ground.field.columns, 3U);
  EXPECT_EQ(s.ground.field.values, (std::vector<double>{0, 0.1, 0.2, 1, 2, 0.3}));
  EXPECT_NE(resolved(s).find("  heightfield:\n    values:\n      - [0, 0.1, 0.2]\n      - [1, 2, 0.3]\n"
                             "    origin: [0, 0, 0]\n    spacing: 0.5\n"),
            std::string::npos)
      << resolved(s);
  expect_stable(s);
  folder_.write("hills.csv", "# two rows\n0, 0.1,0.2\n\n1 2\t3e-1 # the far one\n");
  const Scenario from_file = read(kShort + "ground: {type: heightfield, heightfield: {file: hills.csv, spacing: 0.5}}\n");
  EXPECT_EQ(resolved(from_file), resolved(s));
}

TEST_F(GroundSection, RefusesBoxesAtTheirPlace) {
  EXPECT_EQ(wrong("{type: boxes}"), "s.yaml:3:9: error: a ground of type boxes needs some; expected boxes: [{center, size}]");
  EXPECT_EQ(wrong("{type: boxes, boxes: []}"),
            "s.yaml:3:30: error: a ground of type boxes needs some; expected boxes: [{center, size}]");
  EXPECT_EQ(wrong("{boxes: [{size: [1, 1, 1]}]}"),
            "s.yaml:3:10: error: boxes is given, but the ground is of type plane; expected type: boxes");
  EXPECT_EQ(wrong("{type: box}"), "s.yaml:3:16: error: type 'box' is unknown; did you mean 'boxes'?");
  EXPECT_EQ(wrong("{type: boxes, boxes: [{center: [0, 0, 0]}]}"),
            "s.yaml:3:31: error: boxes[0] has no size; expected size: [x, y, z]");
  EXPECT_EQ(wrong("{type: boxes, boxes: [{size: [1, 0, 1]}]}"),
            "s.yaml:3:42: error: size[1] is 0 m; allowed are more than 0 and up to 1000000 m");
  EXPECT_EQ(wrong("{type: boxes, boxes: [{size: [1, 1]}]}"),
            "s.yaml:3:38: error: size has 2 numbers; expected a list of 3 numbers in m");
  EXPECT_EQ(wrong("{type: boxes, boxes: [{size: [1, 1, 1], centre: [0, 0, 0]}]}"),
            "s.yaml:3:49: error: unknown key 'centre'; did you mean 'center'?");
  EXPECT_EQ(wrong("{type: boxes, boxes: [{size: [1, 1, 1], mass: 2}]}"),
            "s.yaml:3:55: error: boxes[0] has a mass, and contact.law: penalty moves no box; expected mass: 0, or contact.law: "
            "bullet");
  EXPECT_EQ(wrong("{type: boxes, boxes: [{size: [1, 1, 1], friction: -1}]}"),
            "s.yaml:3:59: error: friction is -1; allowed are 0 to 100");
}

TEST_F(GroundSection, RefusesHeightfieldsAtTheirPlace) {
  const auto field = [this](const std::string& keys) { return wrong("{type: heightfield, heightfield: {" + keys + "}}"); };
  EXPECT_EQ(wrong("{type: heightfield}"),
            "s.yaml:3:9: error: a heightfield needs heights; expected heightfield: {values: [[...], [...]]} or {file: PATH}");
  EXPECT_EQ(field("values: [[0, 1], [2]]"), "s.yaml:3:60: error: values[1] has 1 number; expected 2 like values[0]");
  EXPECT_EQ(field("values: [[0, 1], 5]"), "s.yaml:3:60: error: values[1] is 5; expected a list of numbers");
  EXPECT_EQ(field("values: [[0, x], [1, 1]]"), "s.yaml:3:56: error: values[0][1] is 'x'; expected a number in m");
  EXPECT_EQ(field("values: [[0], [1]]"), "s.yaml:3:51: error: the heightfield has 2 rows of 1; expected at least 2 of 2");
  EXPECT_EQ(field("values: [[], []]"),
            "s.yaml:3:52: error: values[0] is empty; expected a list of numbers\n"
            "s.yaml:3:56: error: values[1] is empty; expected a list of numbers");
  EXPECT_EQ(field("values: []"), "s.yaml:3:51: error: the heightfield has 0 rows of 0; expected at least 2 of 2");
  EXPECT_EQ(field("values: 5"), "s.yaml:3:51: error: values is 5; expected a list of rows of numbers");
  EXPECT_EQ(field("values: [[0, 1], [1, 1]], spacing: 0"),
            "s.yaml:3:78: error: spacing is 0 m; allowed are 1e-06 to 1000000 m");
  EXPECT_EQ(field("values: [[0, 1], [1, 1]], file: a.csv"),
            "s.yaml:3:75: error: the heightfield has a file and values; expected one of them\n"
            "s.yaml:3:51: note: values is here");
  const std::string missing = field("file: a.csv");
  EXPECT_TRUE(missing.starts_with("s.yaml:3:49: error: file ")) << missing;
  EXPECT_NE(missing.find("a.csv' cannot be read: No such file or directory"), std::string::npos) << missing;
  folder_.write("a.csv", "0, 1\n2, , 3\n1, 0x1\n");
  EXPECT_EQ(field("file: a.csv"),
            "a.csv:2:1: error: row[1] has 3 numbers; expected 2 like row[0]\n"
            "a.csv:2:4: error: row[1][1] is ''; expected a number in m\n"
            "a.csv:3:4: error: row[2][1] is 0x1; expected a decimal number in m");
}

}  // namespace
}  // namespace gaitlab::fakes
