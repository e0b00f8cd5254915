// Tests of plugins from libraries, which the setting `plugins:` of the scenario loads.
#include <dlfcn.h>
#include <xmmintrin.h>

#include <cstdlib>

#include "core/plugin/load_trial.h"
#include "core/scenario/plugin_files.h"
#include "tests/folders.h"
#include "tests/labels.h"
#include "tests/messages.h"
#include "tests/program/fixture.h"

namespace gaitlab::test {
namespace {

// Under the address sanitizer a failed allocation ends the process.
const Label kHoarding("Plugins.AStaticObjectThatAllocatesWithoutABoundIsAnError", "unsanitized");

const std::string kPlugins = std::string(gaitlab::test::build_folder()) + "/plugins/";

std::string with(const std::string& library, const std::string& cpg) {
  return "gaitlab: 1\nplugins: [" + kPlugins + library + "]\nrobot: {modules: mtran}\nduration: 0.3\ncpg: {type: " + cpg +
         "}\n";
}

class Plugins : public ::testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directory_symlink(kScenarios + "modules", folder / "modules"); }
  std::string error(const std::string& text) {
    folder.write("s.yaml", text);
    const Result result = gaitlab("check s.yaml --plugins-from-scenario", folder / "");
    EXPECT_EQ(result.code, 2);
    return result.err;
  }
  Folder folder;
};

TEST_F(Plugins, ACpgOutOfTreeMovesTheRobotAndRunsAgainFromTheResolvedScenario) {
  folder.write("s.yaml", with("wave.so", "wave, coupling: 5"));
  ASSERT_EQ(gaitlab("run s.yaml --quiet --out a", folder / "").code, 0);
  ASSERT_EQ(gaitlab("run a/scenario.resolved.yaml --quiet --out b --plugin '" + kPlugins + "wave.so'", folder / "").code, 0);
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
  EXPECT_NE(text.find("was built for 'gaitlab-0, cc 1, libc 1', this program is 'gaitlab-19, "), std::string::npos) << text;
}

TEST_F(Plugins, ANameThatIsTakenNamesBothOrigins) {
  const std::string text = error(with("sine_again.so", "sine"));
  EXPECT_NE(text.find("cpg 'sine' is registered twice: by built in and by " + kPlugins + "sine_again.so"), std::string::npos)
      << text;
}

TEST_F(Plugins, TwoLibrariesWithOneNameAreBothNamed) {
  std::filesystem::copy_file(kPlugins + "wave.so", folder / "copy.so");
  const std::string copy = std::filesystem::canonical(folder / "copy.so").string();
  EXPECT_EQ(error("gaitlab: 1\nplugins:\n  - " + kPlugins + "wave.so\n  - ./copy.so\nrobot: {}\nduration: 1\n"),
            "s.yaml:4:5: error: plugin './copy.so' cannot be loaded: " + copy + ": cpg 'wave' is registered twice: by " +
                kPlugins + "wave.so and by " + copy + "\n");
}

TEST_F(Plugins, AFileThatIsNotThereNamesWhatWasTried) {
  const std::string text = error("gaitlab: 1\nplugins: [lib/wave.so]\nrobot: {}\nduration: 1\n");
  EXPECT_EQ(text, "s.yaml:2:11: error: plugin 'lib/wave.so' cannot be loaded: No such file or directory (tried '" +
                      std::filesystem::canonical(folder / "").string() + "/lib/wave.so')\n");
}

/// A long path is whole, because libraries differ in its end.
TEST_F(Plugins, ALongPathIsWhole) {
  const std::string path = std::string(40, 'a') + "/" + std::string(40, 'b') + "/wave.so";
  const std::string text = error("gaitlab: 1\nplugins: [" + path + "]\nrobot: {}\nduration: 1\n");
  EXPECT_NE(text.find("plugin '" + path + "' cannot be loaded"), std::string::npos) << text;
}

TEST_F(Plugins, AStaticObjectThatThrowsIsAnError) {
  EXPECT_EQ(error(with("throws_at_load.so", "sine")),
            "s.yaml:2:11: error: plugin '" + kPlugins +
                "throws_at_load.so' cannot be loaded: a static object of this plugin threw an exception when it was loaded\n");
}

/// The child of the trial may allocate 4 GB, so that a plugin without a bound does not take all memory of the machine.
TEST_F(Plugins, AStaticObjectThatAllocatesWithoutABoundIsAnError) {
  EXPECT_EQ(
      error(with("allocates_at_load.so", "sine")),
      "s.yaml:2:11: error: plugin '" + kPlugins +
          "allocates_at_load.so' cannot be loaded: a static object of this plugin threw an exception when it was loaded\n");
}

TEST_F(Plugins, AStaticObjectThatEndsTheProcessIsAnError) {
  EXPECT_EQ(error(with("exits_at_load.so", "sine")),
            "s.yaml:2:11: error: plugin '" + kPlugins +
                "exits_at_load.so' cannot be loaded: a static object of this plugin ended the process when it was loaded (exit "
                "code 0)\n");
}

TEST_F(Plugins, ARegistrationThatEndsTheProcessIsAnError) {
  EXPECT_EQ(error(with("exits_at_register.so", "sine")),
            "s.yaml:2:11: error: plugin '" + kPlugins +
                "exits_at_register.so' cannot be loaded: its gaitlab_register ended the process (exit code 0)\n");
}

/// Result of the trial of a library with short limits.
std::string trial(const char* library) {
  const auto enter = [](void* handle) {
    Catalog catalog;
    reinterpret_cast<void (*)(Registry&)>(dlsym(handle, "gaitlab_register"))(catalog);
  };
  return load_trial(kPlugins + library, enter, {std::chrono::seconds(1), std::chrono::seconds(1)});
}

TEST_F(Plugins, AStaticObjectOrRegistrationThatNeverReturnsIsAnError) {
  EXPECT_EQ(trial("spins_at_register.so"),
            "its gaitlab_register takes more than 1 s of CPU time; a plugin should do its work when it is called");
  EXPECT_EQ(trial("spins_at_load.so"),
            "its static objects take more than 1 s of CPU time when it is loaded; a plugin should do "
            "its work when it is called");
}

/// A child that sleeps uses no CPU time.
TEST_F(Plugins, AStaticObjectOrRegistrationThatSleepsIsAnError) {
  ::setenv("GAITLAB_PAUSES", (folder / "child").c_str(), 1);
  EXPECT_EQ(trial("spins_at_load.so"),
            "a static object slept when it was loaded and used hardly any CPU time for 1 s; a plugin should do its work when "
            "it is called");
  EXPECT_EQ(trial("spins_at_register.so"),
            "its gaitlab_register slept and used hardly any CPU time for 1 s; a plugin should do its work when it is called");
  ::unsetenv("GAITLAB_PAUSES");
}

/// The loader would return the old code for the path of a file that was built again.
TEST_F(Plugins, AFileThatWasBuiltAgainIsRefused) {
  const std::string copy = folder / "copy.so";
  std::filesystem::copy(kPlugins + "wave.so", copy);
  Catalog first = app::standard_catalog();
  load_plugin_file(copy, first);
  Catalog second = app::standard_catalog();
  load_plugin_file(copy, second);
  std::filesystem::remove(copy);
  std::filesystem::copy(kPlugins + "throws.so", copy);
  Catalog third = app::standard_catalog();
  const std::string said = message_of([&] { load_plugin_file(copy, third); });
  EXPECT_NE(
      said.find(
          "cannot be loaded: it was built again since this process loaded it; start the program again to run the new code"),
      std::string::npos)
      << said;
}

TEST_F(Plugins, LoadingLeavesTheRoundingOfTheProcessorAsItWas) {
  const unsigned before = _mm_getcsr();
  Catalog all = app::standard_catalog();
  load_plugin(kPlugins + "flushes.so", file_hash(kPlugins + "flushes.so"), all);
  EXPECT_EQ(_mm_getcsr() & 0xFFC0U, before & 0xFFC0U);  // without the flags of previous operations
}

/// Scenario with a plugin of this kind that throws from the function `where`.
std::string throwing(const std::string& kind, const std::string& where) {
  const std::string text =
      "gaitlab: 1\nplugins: [" + kPlugins +
      "throws.so]\nrobot: {modules: mtran, base: fixed}\nground: {type: none}\ncontact: {on: none}\nduration: "
      "0.3\n";
  return text + kind + ": {type: throws, where: " + where + "}\n";
}

TEST_F(Plugins, WhatOneThrowsBeforeTheRunIsAnErrorOfTheScenario) {
  const std::vector<std::array<std::string, 3>> cases{
      {"cpg", "constructor", "no luck"},
      {"cpg", "fields", "fields threw: no luck"},
      {"cpg", "note", "note threw: no luck"},
      {"cpg", "start", "start threw: no luck"},
      {"controller", "constructor", "no luck"},
      {"controller", "command_unit", "command_unit threw: no luck"},
      {"actuator", "constructor", "no luck"},
      {"actuator", "fields", "fields threw: no luck"},
      {"actuator", "effort", "effort threw: no luck"},
      {"actuator", "size", "command_limit has 3 numbers; expected 2, one per joint and lane"}};
  for (const auto& [kind, where, what] : cases) {
    const std::string text = error(throwing(kind, where));
    const std::string place = "s.yaml:7:" + std::to_string(kind.size() + 10) + ": error: ";
    EXPECT_EQ(text, fmt::format("{}{} 'throws' ({}throws.so): {}\n", place, kind, kPlugins, what));
    EXPECT_EQ(gaitlab("run s.yaml --quiet --out run", folder / "").code, 2);
    EXPECT_FALSE(std::filesystem::exists(folder / "run")) << kind << ' ' << where;
  }
}

TEST_F(Plugins, WhatOneThrowsInTheRunEndsItAndKeepsWhatWasSimulated) {
  const std::vector<std::array<std::string, 3>> cases{
      {"cpg", "output", "output threw: no luck"},
      {"cpg", "int", "output threw: something that is not derived from std::exception"},
      {"cpg", "derivative", "derivative threw: no luck"},
      {"cpg", "event", "event threw: no luck"},
      {"controller", "update", "update threw: no luck"},
      {"actuator", "electrical", "electrical threw: no luck"}};
  for (const auto& [kind, where, what] : cases) {
    folder.write("s.yaml", throwing(kind, where));
    const Result result = gaitlab(fmt::format("run s.yaml --quiet --out {}{}", kind, where), folder / "");
    EXPECT_EQ(result.code, 1);
    const std::string told =
        fmt::format("{0} 'throws' ({1}throws.so): {2}; the rows up to that time are in {0}{3}\n", kind, kPlugins, what, where);
    EXPECT_NE(result.err.find(told), std::string::npos) << result.err;
    EXPECT_TRUE(std::filesystem::exists(folder / (kind + where + "/summary.json")));
  }
}

TEST_F(Plugins, WhatOneThrowsWhenTheRunIsJudgedKeepsTheTrace) {
  folder.write("s.yaml", throwing("cpg", "times"));
  const Result result = gaitlab("run s.yaml --quiet --out run", folder / "");
  EXPECT_NE(result.code, 0);
  EXPECT_TRUE(contains(result.err, "'throws' (" + kPlugins + "throws.so): times threw: no luck")) << result.err;
  EXPECT_TRUE(std::filesystem::exists(folder / "run/trace.h5"));
}

/// A second run that fails is told, and costs neither the verdict of the first nor its files. The servos are too weak to hold
/// their module.
TEST_F(Plugins, WhatOneThrowsInTheRunWithoutFrictionIsANote) {
  const std::string weak = "actuator: {type: servo, voltage: 6, stall_torque: 0.02, no_load_speed: 5}\n";
  for (const std::string where : {"start", "times"}) {
    folder.write("s.yaml", throwing("cpg", "second " + where) + weak);
    const Result result = gaitlab("run s.yaml --no-retry --no-report --out " + where, folder / "");
    EXPECT_EQ(result.code, 0) << result.err;
    EXPECT_TRUE(contains(result.out, "verdict   infeasible: ")) << result.out;
    EXPECT_TRUE(contains(result.err, "s.yaml: note: the word without this friction is not known: ")) << result.err;
    EXPECT_TRUE(contains(result.err, ": " + where + " threw: no luck")) << result.err;
    EXPECT_FALSE(contains(read(folder / (where + "/verdict.json")), "without_chosen_friction"));
  }
}

TEST_F(Plugins, ANewOneIsWrittenOnce) {
  EXPECT_EQ(gaitlab("new plugin cpg ripple", folder / "").code, 0);
  const std::string code = read(folder / "ripple/ripple.cpp");
  EXPECT_NE(code.find("gaitlab::add_cpg<RippleCpg>(registry, \"ripple\", kManual);"), std::string::npos) << code;
  EXPECT_EQ(code.find('@'), std::string::npos);
  const Result again = gaitlab("new plugin actuator ripple", folder / "");
  EXPECT_EQ(again.code, 2);
  EXPECT_EQ(again.err, "ripple: error: exists; nothing was written\n");
  EXPECT_EQ(read(folder / "ripple/ripple.cpp"), code);
}

TEST_F(Plugins, ANewOneNeedsANameThatCanBeOne) {
  const auto refused = [&](const std::string& arguments) {
    const Result result = gaitlab("new plugin " + arguments + " --out made", folder / "");
    EXPECT_EQ(result.code, 2) << arguments;
    EXPECT_FALSE(std::filesystem::exists(folder / "made")) << arguments;
    return result.err;
  };
  const std::string rule = " is not allowed; expected letters, digits and `_`, beginning with a letter\n";
  EXPECT_EQ(refused("cpg 3legs"), "gaitlab new plugin cpg: error: name '3legs'" + rule);
  EXPECT_EQ(refused("cpg ../up"), "gaitlab new plugin cpg: error: name '../up'" + rule);
  EXPECT_EQ(refused("cpg test"), "gaitlab new plugin cpg: error: name 'test' is a target of CMake; choose another\n");
  EXPECT_EQ(refused("cpg sine"),
            "gaitlab new plugin cpg: error: cpg 'sine' is built in, and a name can be registered once; choose another\n");
  EXPECT_EQ(refused("engine fast"),
            "gaitlab new plugin: error: unknown kind 'engine'; known kinds: cpg, controller, actuator\n");
}

}  // namespace
}  // namespace gaitlab::test
