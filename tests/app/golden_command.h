// Fixture of the tests of `approve` and `test`: a folder with a scenario and its golden.
#pragma once
#include "core/files/atomic_file.h"
#include "golden/golden.h"
#include "tests/program/fixture.h"

namespace gaitlab::test {

inline const std::string kGait =
    "gaitlab: 1\nrobot: {modules: mtran, docks: [[1, 1, 4, 0, 0]]}\ncontact: {on: all}\n"
    "cpg: {type: phase_oscillator, frequency: 1, amplitude: 0.6, phase_lag: 1.2}\nduration: 0.1\n";
/// The gait with steps whose error is far below the bands.
inline const std::string kCaterpillar = kGait + "physics: {step: 2.5e-5}\n";
/// A scenario with half of these steps.
inline std::string finer(std::string text) { return text.replace(text.find("2.5e-5"), 6, "1.25e-5"); }

/// Folder with the scenario good.yaml (two modules that creep for 0.1 s) and its golden, which `approve` has written once.
class GoldenCommand : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    approved = std::make_unique<Folder>();
    std::filesystem::create_directory_symlink(kScenarios + "modules", *approved / "modules");
    approved->write("good.yaml", kCaterpillar);
    const Result result = gaitlab("approve good.yaml --reason 'first golden'", *approved / "");
    ASSERT_EQ(result.code, 0) << result.err;
    told = result.out;
  }
  static void TearDownTestSuite() { approved.reset(); }

  void SetUp() override {
    std::filesystem::create_directory_symlink(kScenarios + "modules", folder / "modules");
    folder.write("good.yaml", kCaterpillar);
    std::filesystem::copy(*approved / "good.golden", folder / "good.golden");
  }

  Result call(const std::string& arguments) { return gaitlab(arguments, folder / ""); }
  void expect_refused(const std::string& arguments, const std::string& message) {
    const Result result = call(arguments);
    EXPECT_EQ(result.code, 2);
    EXPECT_EQ(result.err, message + "\n");
    EXPECT_EQ(result.out, "");
  }
  /// Bytes of the two files of a golden, golden.json and trace.golden.
  [[nodiscard]] std::string bytes(const std::string& golden) const {
    return read(folder / (golden + "/golden.json")) + read(folder / (golden + "/trace.golden"));
  }
  static void expect_contains(const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << "not in:\n" << text;
  }

  static inline std::unique_ptr<Folder> approved;
  static inline std::string told;
  Folder folder;
};

}  // namespace gaitlab::test
