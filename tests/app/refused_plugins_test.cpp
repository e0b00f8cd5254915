// Commands load plugins of unknown scenarios and run folders only if an option on the command line permits it.
#include "tests/folders.h"
#include "tests/program/fixture.h"

namespace gaitlab::test {
namespace {

namespace fs = std::filesystem;

class RefusedPlugins : public ::testing::Test {
 protected:
  RefusedPlugins() {
    fs::create_directory_symlink(kScenarios + "modules", folder_ / "modules");
    folder_.write("s.yaml",
                  "gaitlab: 1\nplugins: [" + library_ + "]\nrobot: {modules: mtran}\nduration: 0.05\ncpg: {type: wave}\n");
  }
  Result call(const std::string& arguments) { return gaitlab(arguments, folder_.path()); }
  /// Expects that the command is refused without an option, and works with either of the two options.
  void only_with_leave(const std::string& arguments) {
    const Result refused = call(arguments);
    EXPECT_EQ(refused.code, 2) << arguments << refused.out;
    EXPECT_TRUE(contains(refused.err, " is foreign code and is not loaded; if you trust it: gaitlab " + arguments +
                                          " --plugins-from-scenario, or --plugin FILE for each plugin\n"))
        << refused.err;
    const Result other = call(arguments + " --plugin '" + std::string(gaitlab::test::build_folder()) + "/plugins/rises.so'");
    EXPECT_EQ(other.code, 2) << arguments;
    EXPECT_TRUE(contains(other.err, "is not loaded")) << other.err;
    for (const std::string& leave : {std::string(" --plugins-from-scenario"), " --plugin '" + library_ + "'"}) {
      for (const char* made : {"x.csv", "x.glb", "x.xml", "x"}) fs::remove_all(folder_ / made);
      const Result allowed = call(arguments + leave);
      EXPECT_EQ(allowed.code, 0) << arguments << leave << ": " << allowed.err;
    }
  }

  Folder folder_;
  std::string library_ = std::string(gaitlab::test::build_folder()) + "/plugins/wave.so";
};

TEST_F(RefusedPlugins, WhatLooksAtAScenarioLoadsNone) {
  only_with_leave("check s.yaml");
  only_with_leave("export s.yaml --to mjcf x.xml");
  only_with_leave("export s.yaml --to gltf x.glb");
}

TEST_F(RefusedPlugins, WhatLooksAtARunLoadsNone) {
  ASSERT_EQ(call("run s.yaml --quiet --out a").code, 0);
  const Result absent = call("report a --plugins-from-scenario");
  EXPECT_EQ(absent.code, 2);
  EXPECT_TRUE(contains(absent.err, "plugin 'wave.so' cannot be loaded: No such file or directory (tried '") &&
              contains(absent.err, "; a record contains only the plugin's name, so that --plugin must give the file)"))
      << absent.err;
  EXPECT_EQ(call("report a --plugin '" + library_ + "'").code, 0);
  fs::copy_file(library_, folder_ / "a/wave.so");
  only_with_leave("export a --to gltf x.glb");
  only_with_leave("rerun a --quiet --out x");
  only_with_leave("rerun a --verify");
  only_with_leave("report a");
  only_with_leave("report a a --page x");
  folder_.write("f.yaml", "gaitlab: 1\nruns: {a: a}\npanels:\n  - kind: heat\n");
  const Result figure = call("figure f.yaml -o x.svg");
  EXPECT_EQ(figure.code, 2);
  EXPECT_TRUE(contains(figure.err, "is not loaded")) << figure.err;
  EXPECT_EQ(call("compare a a").code, 0);  // needs no plugin, because it reads only columns and numbers
  EXPECT_EQ(call("export a --to csv x.csv").code, 0);
}

TEST_F(RefusedPlugins, AStudyRunAgainLoadsNone) {
  ASSERT_EQ(call("sweep s.yaml --quiet --grid cpg.frequency=0.4:0.6:2 --out study").code, 0);
  EXPECT_EQ(call("study show study").code, 0);
  fs::copy_file(library_, folder_ / "study/wave.so");
  only_with_leave("study rerun study 1 --out x");
}

TEST_F(RefusedPlugins, WhatRunsAScenarioLoadsThem) {
  EXPECT_EQ(call("run s.yaml --quiet --out run").code, 0);
  EXPECT_EQ(call("converge s.yaml --quiet --halvings 2").code, 0);
}

TEST_F(RefusedPlugins, AFileThatIsNotThereIsTold) {
  const Result result = call("check s.yaml --plugin none.so");
  EXPECT_EQ(result.code, 2);
  EXPECT_EQ(result.err, "--plugin none.so: error: cannot be loaded: No such file or directory\n");
}

}  // namespace
}  // namespace gaitlab::test
