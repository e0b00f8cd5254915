// Tests of the section `ground`: accepted and refused settings, places of errors, and complete resolved scenarios.
#include <fmt/format.h>
#include <sys/stat.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <filesystem>

#include "core/files/hash.h"
#include "core/scenario/height_file.h"
#include "core/scenario/resolved.h"
#include "tests/core/scenario/fixture.h"
#include "tests/messages.h"

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
  ASSERT_EQ(s.ground.boxes().size(), 2U);
  EXPECT_STREQ(s.ground.type().name, "boxes");
  EXPECT_EQ(s.ground.boxes()[0].center, Vec3(1, 2, 3));
  EXPECT_EQ(s.ground.boxes()[0].size, Vec3(0.1, 0.2, 0.3));
  EXPECT_EQ(s.ground.boxes()[0].R, rpy({0, 0, 0.1}));
  EXPECT_EQ(s.ground.boxes()[0].friction, 0.5);  // friction of the ground
  EXPECT_EQ(s.ground.boxes()[1].friction, 0.2);
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
  EXPECT_EQ(s.ground.relief()->columns, 3U);
  EXPECT_EQ(s.ground.relief()->values.list(), (std::vector<double>{0, 0.1, 0.2, 1, 2, 0.3}));
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
  EXPECT_EQ(wrong("{type: boxes}"),
            "s.yaml:3:9: error: a ground of type boxes needs at least one box; expected boxes: [{center, size}]");
  EXPECT_EQ(wrong("{type: boxes, boxes: []}"),
            "s.yaml:3:30: error: a ground of type boxes needs at least one box; expected boxes: [{center, size}]");
  EXPECT_EQ(wrong("{boxes: [{size: [1, 1, 1]}]}"),
            "s.yaml:3:10: error: boxes is given, but the ground is of type plane; expected type: boxes");
  EXPECT_EQ(wrong("{type: box}"), "s.yaml:3:16: error: type 'box' is unknown; did you mean 'boxes'?");
  EXPECT_EQ(wrong("{type: boxes, boxes: [{center: [0, 0, 0]}]}"),
            "s.yaml:3:31: error: boxes[0] has no size; expected size: [x, y, z]");
  EXPECT_EQ(wrong("{type: boxes, boxes: [{size: [1, 0, 1]}]}"),
            "s.yaml:3:42: error: size[1] is 0 m; expected more than 0 and up to 1000000 m");
  EXPECT_EQ(wrong("{type: boxes, boxes: [{size: [1, 1]}]}"),
            "s.yaml:3:38: error: size has 2 numbers; expected a list of 3 numbers in m");
  EXPECT_EQ(wrong("{type: boxes, boxes: [{size: [1, 1, 1], centre: [0, 0, 0]}]}"),
            "s.yaml:3:49: error: unknown key 'centre'; did you mean 'center'?");
  EXPECT_EQ(wrong("{type: boxes, boxes: [{size: [1, 1, 1], mass: 2}]}"),
            "s.yaml:3:55: error: boxes[0] has a mass, but contact.law: penalty moves no box; expected mass: 0, or contact.law: "
            "bullet");
  EXPECT_EQ(wrong("{type: boxes, boxes: [{size: [1, 1, 1], friction: -1}]}"),
            "s.yaml:3:59: error: friction is -1; expected 0 to 100");
}

/// Text of a ground of `count` boxes, each `apart` behind the previous one, m.
std::string row_of_boxes(int count, double apart) {
  std::string text = "{type: boxes, boxes: [";
  for (int i = 0; i < count; ++i)
    text += fmt::format("{}{{center: [{:g}, 0, 0], size: [1, 1, 1]}}", i == 0 ? "" : ", ", apart * i);
  return text + "]}";
}

TEST_F(GroundSection, RefusesMoreThanAHundredBoxesInOnePlace) {
  EXPECT_EQ(read(kShort + "ground: " + row_of_boxes(100, 0)).ground.boxes().size(), 100U);
  EXPECT_EQ(read(kShort + "ground: " + row_of_boxes(300, 0.02)).ground.boxes().size(), 300U);
  EXPECT_EQ(wrong(row_of_boxes(101, 0)),
            "s.yaml:3:31: error: more than 100 boxes contain the centre of boxes[0], [0, 0, 0]; leave out boxes within others");
  EXPECT_NE(wrong(row_of_boxes(300, 0.006)).find("more than 100 boxes contain the centre of boxes[17], [0.102, 0, 0]"),
            std::string::npos);
}

TEST_F(GroundSection, RefusesHeightfieldsAtTheirPlace) {
  const auto field = [this](const std::string& keys) { return wrong("{type: heightfield, heightfield: {" + keys + "}}"); };
  EXPECT_EQ(wrong("{type: heightfield}"),
            "s.yaml:3:9: error: a heightfield needs heights; expected heightfield: {values: [[...], [...]]} or {file: PATH}");
  EXPECT_EQ(field("values: [[0, 1], [2]]"), "s.yaml:3:60: error: values[1] has 1 number; expected 2 like values[0]");
  EXPECT_EQ(field("values: [[0, 1], 5]"), "s.yaml:3:60: error: values[1] is 5; expected a list of numbers");
  EXPECT_EQ(field("values: [[0, x], [1, 1]]"), "s.yaml:3:56: error: values[0][1] is 'x'; expected a number in m");
  EXPECT_EQ(field("values: [[0], [1]]"),
            "s.yaml:3:51: error: the heightfield has 2 rows of 1 heights; expected at least 2 rows of 2");
  EXPECT_EQ(field("values: [[], []]"),
            "s.yaml:3:52: error: values[0] is empty; expected a list of numbers\n"
            "s.yaml:3:56: error: values[1] is empty; expected a list of numbers");
  EXPECT_EQ(field("values: []"), "s.yaml:3:51: error: the heightfield has 0 rows of 0 heights; expected at least 2 rows of 2");
  EXPECT_EQ(field("values: 5"), "s.yaml:3:51: error: values is 5; expected a list of rows of numbers");
  EXPECT_EQ(field("values: [[0, 1], [1, 1]], spacing: 0"), "s.yaml:3:78: error: spacing is 0 m; expected 1e-06 to 1000000 m");
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

/// Bytes of a matrix of '<f8' as numpy.save writes it.
std::string matrix(std::size_t rows, std::size_t columns, const std::vector<double>& numbers) {
  std::string header = fmt::format("{{'descr': '<f8', 'fortran_order': False, 'shape': ({}, {}), }}", rows, columns);
  header.resize(117, ' ');
  std::string bytes = std::string("\x93NUMPY\x01\x00v\x00", 10) + header + "\n";
  const std::size_t start = bytes.size();
  bytes.resize(start + numbers.size() * sizeof(double));
  if (!numbers.empty()) std::memcpy(bytes.data() + start, numbers.data(), numbers.size() * sizeof(double));
  return bytes;
}

class HeightFiles : public GroundSection {
 protected:
  static std::string ground(const std::string& keys) {
    return kShort + "ground: {type: heightfield, heightfield: {" + keys + "}}\n";
  }
  std::string refused(const std::string& keys) { return wrong("{type: heightfield, heightfield: {" + keys + "}}"); }
};

TEST_F(HeightFiles, OfBinaryNumbersHaveTheBitsOfText) {
  const std::vector<double> numbers = {0.1, -0.2, 1.0 / 3, 4e-5, 0, 1e3};
  std::string text;
  for (std::size_t i = 0; i < numbers.size(); ++i) text += fmt::format("{}{}", numbers[i], i % 3 == 2 ? "\n" : " ");
  folder_.write("hills.txt", text);
  folder_.write("hills.npy", matrix(2, 3, numbers));
  for (const char* scale : {"", ", scale: 0.3", ", scale: 2e-3"}) {
    const Scenario from_text = read(ground("file: hills.txt, spacing: 0.5" + std::string(scale)));
    const Scenario from_numbers = read(ground("file: hills.npy, spacing: 0.5" + std::string(scale)));
    EXPECT_EQ(from_numbers.ground.relief()->columns, 3U);
    ASSERT_EQ(from_numbers.ground.relief()->values.size(), numbers.size());
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      EXPECT_EQ(std::bit_cast<std::uint64_t>(from_numbers.ground.relief()->values[i]),
                std::bit_cast<std::uint64_t>(from_text.ground.relief()->values[i]));
    }
    EXPECT_EQ(resolved(from_numbers), resolved(from_text));
    expect_stable(from_numbers);
  }
  EXPECT_EQ(read(ground("file: hills.npy, scale: 0.5")).ground.relief()->values[5], 500);
}

// If there are many heights, the resolved scenario contains the name and hash of their file instead, so that it has at most 1
// MB.
TEST_F(HeightFiles, OfMoreHeightsThanARecordHoldsAreNamedInIt) {
  std::vector<double> numbers(250UL * 300UL);
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = static_cast<double>(i % 977) * 1e-3;
  const std::string file = folder_.write("large.npy", matrix(250, 300, numbers));
  const Scenario s = read(ground("file: large.npy, scale: 0.5, origin: [1, 2, 3]"));
  EXPECT_EQ(s.ground.relief()->columns, 300U);
  EXPECT_EQ(s.ground.relief()->rows(), 250U);
  EXPECT_EQ(s.ground.relief()->values[976], 0.5 * 0.976);
  const std::string once = resolved(s);
  const std::string name = heights_name(*s.ground.relief());
  EXPECT_NE(once.find(fmt::format("  heightfield:\n    file: {}\n    scale: 1\n    hash: {}\n    origin: [1, 2, 3]\n", name,
                                  s.ground.relief()->source.hash)),
            std::string::npos)
      << once.substr(once.find("ground:"));
  EXPECT_EQ(once.find("values:"), std::string::npos);
  const Folder elsewhere;
  const std::string record = elsewhere.write("r.yaml", once);
  elsewhere.write(name, packed_heights(*s.ground.relief()));
  std::filesystem::remove(file);
  const Scenario again = read_scenario(record, {}, catalog_);
  EXPECT_EQ(resolved(again), once);
  EXPECT_EQ(again.ground.relief()->values.list(), s.ground.relief()->values.list());
  Heightfield other = *s.ground.relief();
  other.values = std::vector<double>(other.values.size(), 7);
  elsewhere.write(name, packed_heights(other));
  const std::string refused = test::message_of([&] { (void)read_scenario(record, {}, catalog_); });
  EXPECT_NE(refused.find(name + "' is not the recorded file: its hash is "), std::string::npos) << refused;
  elsewhere.write(name, packed_heights(other).substr(0, 100));
  const std::string cut = test::message_of([&] { (void)read_scenario(record, {}, catalog_); });
  EXPECT_NE(cut.find(name + ": error: it"), std::string::npos) << cut;
}

// A text that this process reads again has the path of the file.
TEST_F(HeightFiles, AreReadByTheirPathInTheSameProcess) {
  const std::string bytes = matrix(250, 300, std::vector<double>(250UL * 300UL, 3));
  const std::string file = std::filesystem::canonical(folder_.write("large.npy", bytes)).string();
  const Scenario s = read(ground("file: large.npy, scale: 0.5"));
  const Folder elsewhere;
  const std::string whole = resolved(s, FilePaths::whole);
  EXPECT_NE(whole.find("file: " + file + "\n    scale: 0.5\n"), std::string::npos) << whole.substr(whole.find("ground:"));
  EXPECT_EQ(resolved(read_scenario(elsewhere.write("r.yaml", whole), {}, catalog_)), resolved(s));
}

TEST_F(HeightFiles, AreRefusedWithWhatTheyHold) {
  folder_.write("flat.npy", matrix(1, 3, {1, 2, 3}));
  EXPECT_EQ(refused("file: flat.npy"),
            "flat.npy: error: the heightfield has 1 rows of 3 heights; expected at least 2 rows of 2");
  folder_.write("gap.npy", matrix(2, 2, {1, 2, std::nan(""), 4}));
  EXPECT_EQ(refused("file: gap.npy"),
            "gap.npy: error: height [1, 0], counted from 0, is nan m; expected -1000000 to 1000000 m");
  folder_.write("deep.npy", matrix(2, 2, {1, 2, 3, -2e4}));
  EXPECT_EQ(refused("file: deep.npy, scale: 100"),
            "deep.npy: error: height [1, 1], counted from 0, is -2000000 m; expected -1000000 to 1000000 m");
  folder_.write("vast.npy", matrix(4097, 4097, {}));
  EXPECT_EQ(refused("file: vast.npy"), "vast.npy: error: its shape is (4097, 4097); expected at most 16777216 numbers");
  folder_.write("cut.npy", matrix(4096, 4096, {1, 2}));
  EXPECT_EQ(refused("file: cut.npy"),
            "cut.npy: error: 16 bytes of numbers follow its header; expected 134217728 for shape (4096, 4096) of type '<f8'");
  folder_.write("text.npy", "0 1\n1 0\n");
  EXPECT_EQ(refused("file: text.npy"),
            "text.npy: error: it does not begin as a file of NumPy; expected a matrix of float32, float64 or integers in C "
            "order, as numpy.save writes it");
  folder_.write("grey.dem", std::string("\x89PNG\r\n\x1a\n", 8) + "rest");
  EXPECT_EQ(
      refused("file: grey.dem"),
      "s.yaml:3:49: error: file 'grey.dem' holds grey values from 0 to 65535; expected `scale`, the metres per grey value");
  EXPECT_EQ(refused("file: grey.dem, scale: 1e-3"),
            "grey.dem: error: it ends too early; expected a PNG of 16 bit grey values without interlacing");
  EXPECT_EQ(refused("values: [[0, 1], [1, 1]], scale: 2"),
            "s.yaml:3:76: error: scale belongs to a file, but the heights are given as values; remove scale");
  EXPECT_EQ(refused("file: gone.npy"), "s.yaml:3:49: error: file 'gone.npy' cannot be read: No such file or directory");
}

TEST_F(HeightFiles, ThatAreNotFilesAreRefusedAndNotWaitedFor) {
  const std::string fifo = (std::filesystem::path(folder_.path()) / "fifo.npy").string();
  ASSERT_EQ(::mkfifo(fifo.c_str(), 0600), 0);
  std::filesystem::create_symlink("fifo.npy", std::filesystem::path(folder_.path()) / "link.npy");
  std::filesystem::create_symlink("loop.npy", std::filesystem::path(folder_.path()) / "loop.npy");
  for (const char* name : {"fifo.npy", "link.npy"}) {
    EXPECT_EQ(refused("file: " + std::string(name)),
              fmt::format("s.yaml:3:49: error: file '{}' cannot be read: not a regular file", name));
  }
  EXPECT_EQ(refused("file: loop.npy"), "s.yaml:3:49: error: file 'loop.npy' cannot be read: Too many levels of symbolic links");
  EXPECT_EQ(refused("file: /dev/zero"), "s.yaml:3:49: error: file '/dev/zero' cannot be read: not a regular file");
}

}  // namespace
}  // namespace gaitlab::fakes
