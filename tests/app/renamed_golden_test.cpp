// Tests of `gaitlab test` on goldens whose scenario has another name or robot, or is gone, and on scenarios without a golden.
#include "tests/app/golden_command.h"
#include "tests/folders.h"

namespace gaitlab::test {

using namespace golden;
namespace {

namespace fs = std::filesystem;

TEST_F(GoldenCommand, AnotherRobotsGoldenIsForeign) {
  fs::rename(folder / "good.golden", folder / "other.golden");
  fs::remove(folder / "good.yaml");
  std::string longer = kCaterpillar;
  longer.replace(longer.find("]]"), 2, "], [1, 2, 4, 1, 0]]");
  folder.write("other.yaml", longer);
  const std::string foreign =
      "other.golden: error: is the golden of 'good', but other.yaml ('other') is another run; gaitlab approve --replace makes "
      "a golden of this run";
  Result result = call("test other.yaml");
  EXPECT_EQ(result.code, 2);
  EXPECT_EQ(result.err, foreign + "\n");
  const std::string before = bytes("other.golden");
  result = call("approve other.yaml --reason 'mine'");
  EXPECT_EQ(result.code, 2);
  EXPECT_EQ(result.err, foreign + "\n");
  EXPECT_EQ(bytes("other.golden"), before);
  EXPECT_EQ(call("approve other.yaml --reason 'mine' --replace").code, 0);
  EXPECT_EQ(read_golden(folder / "other.golden").history.size(), 1U);
}

TEST_F(GoldenCommand, ARenamedAndChangedScenarioIsARegression) {
  fs::rename(folder / "good.golden", folder / "better.golden");
  fs::remove(folder / "good.yaml");
  folder.write("better.yaml", kCaterpillar + "actuator: {Kt: 0.0039895}\n");
  Result result = call("test better.yaml");
  EXPECT_EQ(result.code, 4);
  expect_contains(result.out, "\n  name: good -> better\n");
  expect_contains(result.out, "\n  m1/passive torque ");
  result = call("approve better.yaml --reason 'whose history?'");
  EXPECT_EQ(result.code, 2);
  expect_contains(result.err, "better.golden: error: is the golden of 'good', but better.yaml ('better') is another run");
}

TEST_F(GoldenCommand, ARenamedScenarioKeepsItsGolden) {
  fs::rename(folder / "good.golden", folder / "better.golden");
  fs::rename(folder / "good.yaml", folder / "better.yaml");
  EXPECT_EQ(call("test better.yaml").code, 0);
  const Result result = call("approve better.yaml --reason 'a better name'");
  EXPECT_EQ(result.code, 0);
  expect_contains(result.out, "\n  name: good -> better\n");
  EXPECT_EQ(read_golden(folder / "better.golden").history.size(), 2U);
}

TEST_F(GoldenCommand, NoScenarioAndNoGoldenVanishesUnseen) {
  EXPECT_EQ(call("test . --strict").code, 0);
  fs::create_symlink("good.yaml", folder / "link.yaml");  // a different name means a different scenario, without a golden
  folder.write("short.yml", kCaterpillar);
  Result result = call("test .");
  EXPECT_EQ(result.code, 0);
  expect_contains(result.out, "\n./link.yaml ");
  expect_contains(result.out, "\n./short.yml ");
  expect_contains(result.out, "\n1 passed, 0 failed, 2 skipped\n");
  result = call("test . --strict");
  EXPECT_EQ(result.code, 2);
  expect_contains(result.err, "./link.yaml: error: has no golden (./link.golden does not exist); make it: ");
  fs::remove(folder / "link.yaml");
  fs::remove(folder / "short.yml");

  fs::copy(folder / "good.golden", folder / "gone.golden");
  result = call("test .");
  EXPECT_EQ(result.code, 2);
  EXPECT_EQ(result.err,
            "./gone.golden: error: has no scenario (./gone.yaml does not exist); rename or remove this golden in the same way "
            "as its scenario\n");
  expect_contains(result.out, "\n1 passed, 0 failed, 1 not tested\n");
  fs::remove_all(folder / "gone.golden");

  fs::create_directories(folder / "sub/deeper");
  folder.write("sub/deeper/module.yaml", "no scenario");
  fs::copy(folder / "good.golden", folder / "sub/deeper/walk.golden");
  folder.write("sub/deeper/walk.yaml", "gaitlab: 1\nrobto: {}\n");
  result = call("test .");
  EXPECT_EQ(result.code, 2);
  expect_contains(result.err, "./sub/deeper/walk.yaml:2:1: error: unknown key 'robto'");
  expect_contains(result.out, "\n1 passed, 0 failed, 1 not tested\n");
  fs::remove_all(folder / "sub");
  fs::create_symlink("nothing", folder / "gone.yaml");
  fs::create_symlink("nothing", folder / "good.golden.old");
  result = call("test .");
  EXPECT_EQ(result.code, 2);
  EXPECT_EQ(result.err, "./gone.yaml: error: is a link to a file that does not exist\n");
  fs::remove(folder / "gone.yaml");

  folder.write("good.yml", kCaterpillar);
  const std::string shared = "good.yml: error: would share its golden, good.golden, with good.yaml; rename one of them";
  EXPECT_EQ(call("test good.yml").err, shared + "\n");
  EXPECT_EQ(call("test good.yml").code, 2);
  expect_refused("approve good.yml --reason 'mine'", shared);
}

}  // namespace
}  // namespace gaitlab::test
