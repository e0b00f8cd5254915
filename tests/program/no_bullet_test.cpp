// The program without Bullet: engine articulated is available, and the error for the default engine contains a remedy.
#include "tests/program/fixture.h"

namespace gaitlab::test {
namespace {

const std::string kHexapod = kScenarios + "hexapod.yaml";

TEST(NoBullet, HexapodWalksOnEngineArticulated) {
  const Folder folder;
  const Result result =
      gaitlab("run '" + kHexapod + "' --set physics.engine=articulated --set duration=1 --out run", folder / "");
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_TRUE(std::filesystem::exists(folder / "run/summary.json"));
}

TEST(NoBullet, DefaultEngineIsRefused) {
  const Folder folder;
  const Result result = gaitlab("run '" + kHexapod + "' --out run", folder / "");
  EXPECT_EQ(result.code, 2);
  EXPECT_NE(result.err.find("built without the default engine 'bullet'; write physics: {engine: articulated}"),
            std::string::npos)
      << result.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "run"));
}

TEST(NoBullet, ListHasEngineArticulatedAlone) {
  const Result result = gaitlab("list engine", Folder() / "");
  EXPECT_EQ(result.code, 0);
  EXPECT_NE(result.out.find("articulated"), std::string::npos) << result.out;
  EXPECT_EQ(result.out.find("bullet"), std::string::npos) << result.out;
}

}  // namespace
}  // namespace gaitlab::test
