// Out-of-tree plugins through the scenario's `plugins:`.
#include "fixture.h"

namespace gaitlab::test {
namespace {

const std::string kPlugins = std::string(GAITLAB_BINARY_DIR) + "/plugins/";

std::string with(const std::string& library, const std::string& cpg) {
  return "gaitlab: 1\nplugins: [" + kPlugins + library + "]\nrobot: {modules: mtran}\nduration: 0.3\ncpg: {type: " + cpg +
         "}\n";
}

class Plugins : public ::testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directory_symlink(kScenarios + "modules", folder / "modules"); }
  std::string error(const std::string& text) {
    folder.write("s.yaml", text);
    const Result result = gaitlab("check s.yaml", folder / "");
    EXPECT_EQ(result.code, 2);
    return result.err;
  }
  Folder folder;
};

TEST_F(Plugins, ACpgOutOfTreeMovesTheRobotAndRunsAgainFromTheResolvedScenario) {
  folder.write("s.yaml", with("wave.so", "wave, coupling: 5"));
  ASSERT_EQ(gaitlab("run s.yaml --quiet --out a", folder / "").code, 0);
  ASSERT_EQ(gaitlab("run a/scenario.resolved.yaml --quiet --out b", folder / "").code, 0);
  EXPECT_EQ(read(folder / "a/scenario.resolved.yaml"), read(folder / "b/scenario.resolved.yaml"));
  EXPECT_NE(read(folder / "a/scenario.resolved.yaml").find("coupling: 5"), std::string::npos);
  const auto hash = [&](const std::string& run) {
    const std::string json = read(folder / (run + "/summary.json"));
    return json.substr(json.find("trace_hash"));
  };
  EXPECT_EQ(hash("a"), hash("b"));
}

TEST_F(Plugins, AWrongSettingIsAnErrorAtItsPlace) {
  EXPECT_EQ(error(with("wave.so", "wave, couplng: 5")),
            "s.yaml:5:19: error: unknown key 'couplng'; did you mean 'coupling'?\n");
}

TEST_F(Plugins, AnotherAbiNamesBoth) {
  const std::string text = error(with("other_abi.so", "sine"));
  EXPECT_NE(text.find("was built for 'gaitlab-0, cc 1, libc 1', this program is 'gaitlab-3, "), std::string::npos) << text;
}

TEST_F(Plugins, ANameThatIsTakenNamesBothOrigins) {
  const std::string text = error(with("sine_again.so", "sine"));
  EXPECT_NE(text.find("cpg 'sine' is registered twice: by built in and by " + kPlugins + "sine_again.so"), std::string::npos)
      << text;
}

}  // namespace
}  // namespace gaitlab::test
