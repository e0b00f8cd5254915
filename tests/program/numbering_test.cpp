// Modules may be numbered in any order, and the numbers do not change the robot. A parent may have a larger number than its
// child.
#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/labels.h"
#include "tests/program/engines.h"

namespace gaitlab::test {
namespace {

// Whole walks.
const Label kRenumberedWalks("*RenumberedWalk.*", "long;unsanitized");

/// Calls the program for a row of three modules, of which the middle has number `middle` and the last has number `last`.
class ChainNumbered : public testing::Test {
 protected:
  struct Answers {
    std::string mjcf, urdf;
    nlohmann::json forward, inverse;
  };

  ChainNumbered() { std::filesystem::create_directory_symlink(kScenarios + "modules", folder_ / "modules"); }

  Result call(const std::string& arguments) {
    Result result = gaitlab(arguments, folder_ / "");
    EXPECT_EQ(result.code, 0) << arguments << "\n" << result.err;
    return result;
  }
  Answers answers(int middle, int last) {
    const auto joints = [&](const std::array<double, 4>& values) {
      return fmt::format("{{default: 0.1, m{0}/active: {2}, m{0}/passive: {3}, m{1}/active: {4}, m{1}/passive: {5}}}", middle,
                         last, values[0], values[1], values[2], values[3]);
    };
    folder_.write("s.yaml", fmt::format(R"(
gaitlab: 1
name: chain
robot: {{modules: mtran, docks: [[1, {1}, 4, {0}, 0], [1, {0}, 4, 0, 1]]}}
initial: {{angles: {2}, speeds: {3}}}
cpg: {{type: sine, amplitude: 0.2, offset: {2}}}
duration: 0.03
)",
                                        middle, last, joints({0.2, -0.3, 0.4, -0.5}), joints({1, -2, 3, -1})));
    const nlohmann::json state = {
        {"tau", {{"default", 0.1}, {fmt::format("m{}/active", middle), 0.3}, {fmt::format("m{}/passive", last), -0.2}}},
        {"qdd", {{"default", 0.5}, {fmt::format("m{}/active", middle), -3}, {fmt::format("m{}/passive", last), 2}}}};
    folder_.write("state.json", state.dump());
    const std::string check = call("check s.yaml").out;
    EXPECT_NE(check.find("3 modules, 9 bodies (moving as 7), 12 degrees of freedom"), std::string::npos) << check;
    for (const char* written : {"run", "s.xml", "s.urdf"}) std::filesystem::remove_all(folder_ / written);
    call("run s.yaml --quiet --out run");
    call("export s.yaml --strict --to mjcf s.xml");
    call("export s.yaml --to urdf s.urdf");
    return {read(folder_ / "s.xml"), read(folder_ / "s.urdf"),
            nlohmann::json::parse(call("dynamics s.yaml --state state.json").out),
            nlohmann::json::parse(call("dynamics s.yaml --state state.json --inverse").out)};
  }

  Folder folder_;
};

/// Lines of a text in sorted order, with m1 and m2 exchanged if `swap` is true. Exported files list motors and sensors by
/// number.
std::vector<std::string> swapped_lines(std::string text, bool swap) {
  for (std::size_t at = 0; swap && (at = text.find('m', at)) != std::string::npos; ++at) {
    if (text.compare(at, 3, "m1/") == 0) {
      text[at + 1] = '2';
    } else if (text.compare(at, 3, "m2/") == 0) {
      text[at + 1] = '1';
    }
  }
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    if (line.find("<!--") == std::string::npos && line.find("Written by") == std::string::npos) lines.push_back(line);
  }
  std::sort(lines.begin(), lines.end());
  return lines;
}

TEST_F(ChainNumbered, AgainstItsDocksIsTheSameForEveryCommand) {
  const Answers along = answers(1, 2);
  const Answers against = answers(2, 1);
  EXPECT_EQ(swapped_lines(against.mjcf, true), swapped_lines(along.mjcf, false));
  EXPECT_EQ(swapped_lines(against.urdf, true), swapped_lines(along.urdf, false));
  // Joints 2k and 2k + 1 belong to module k. The order of the links is the same, so that sums have the same order of terms.
  const std::array<std::size_t, 6> joint{0, 1, 4, 5, 2, 3};
  for (std::size_t j = 0; j < joint.size(); ++j) {
    EXPECT_EQ(against.forward["qdd"][joint[j]], along.forward["qdd"][j]) << j;
    EXPECT_EQ(against.inverse["tau"][joint[j]], along.inverse["tau"][j]) << j;
    EXPECT_EQ(against.forward["bias"][6 + joint[j]], along.forward["bias"][6 + j]) << j;
    for (std::size_t i = 0; i < joint.size(); ++i) {
      EXPECT_EQ(against.forward["mass_matrix"][6 + joint[j]][6 + joint[i]], along.forward["mass_matrix"][6 + j][6 + i]);
    }
  }
  EXPECT_EQ(against.inverse["reactions"]["m2/dock"], along.inverse["reactions"]["m1/dock"]);
  EXPECT_EQ(against.inverse["reactions"]["m1/dock"], along.inverse["reactions"]["m2/dock"]);
}

class RenumberedWalk : public EveryEngine {};
INSTANTIATE_TEST_SUITE_P(Engines, RenumberedWalk, engines(), engine_name);

TEST_P(RenumberedWalk, IsTheSameWalk) {
  // The hexapod has reversed numbers: legs have smaller numbers than the spine, and every parent except module 0 has a larger
  // number than its children.
  const auto walk = [](const std::function<int(int)>& number) {
    constexpr std::array<std::array<int, 5>, 10> kRows{{{1, 1, 4, 0, 1},
                                                        {1, 2, 4, 1, 3},
                                                        {1, 3, 4, 2, 1},
                                                        {1, 4, 4, 3, 3},
                                                        {0, 5, 3, 0, 3},
                                                        {2, 6, 5, 0, 1},
                                                        {0, 7, 3, 2, 3},
                                                        {2, 8, 5, 2, 1},
                                                        {0, 9, 3, 4, 3},
                                                        {2, 10, 5, 4, 1}}};
    std::string docks;
    for (const auto& r : kRows) docks += fmt::format("[{}, {}, {}, {}, {}], ", r[0], number(r[1]), r[2], number(r[3]), r[4]);
    docks.resize(docks.size() - 2);
    return run(scenario(fmt::format(R"(
gaitlab: 1
robot: {{modules: mtran, docks: [{}]}}
physics: {{engine: {}}}
contact: {{on: feet}}
cpg: {{type: tripod, frequency: 1, amplitude: 0.4, model: {{ramp: 0}}}}
duration: 0.6
trace: {{columns: [joint.*, com.*]}}
)",
                                    docks, GetParam())));
  };
  const Recording along = walk([](int m) { return m; });
  const Recording against = walk([](int m) { return m == 0 ? 0 : 11 - m; });
  const Table a(along.trace);
  const Table b(against.trace);
  // The tripods of the gait do not depend on the numbers, because the front left leg is always the first leg.
  double worst = 0;
  for (std::size_t row = 0; row < along.trace.rows(); ++row) {
    for (int j = 0; j < 22; ++j) {
      const int other = j < 2 ? j : 2 * (11 - j / 2) + j % 2;
      for (const char* what : {"setpoint", "angle", "torque"}) {
        const double one = a.at(row, fmt::format("joint.{}.{}", j, what));
        worst = std::max(worst, std::abs(b.at(row, fmt::format("joint.{}.{}", other, what)) - one));
      }
    }
    for (const char* axis : {"com.x", "com.y", "com.z"}) worst = std::max(worst, std::abs(b.at(row, axis) - a.at(row, axis)));
  }
  EXPECT_LT(worst, 1e-9) << "rounding of numbers of 1 in another order, which every footfall multiplies by up to ten";
  EXPECT_GT(a(0.6, "com.x") - a(0, "com.x"), 0.01) << "it walks";
}

}  // namespace
}  // namespace gaitlab::test
