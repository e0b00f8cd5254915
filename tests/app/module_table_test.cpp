// The output of `list module` and `explain module` agrees with the published data of the modules.
#include "app/look/module_table.h"

#include "tests/program/fixture.h"

namespace gaitlab::test {
namespace {

std::string table(const std::string& module) {
  return app::module_table(read_module(kScenarios + "modules/" + module + ".yaml", catalog()));
}
std::string row(const std::string& module) {
  return app::module_row(read_module(kScenarios + "modules/" + module + ".yaml", catalog()));
}

/// The data of M-TRAN are those of the paper, 65 x 65 x 130 mm and 0.400 kg, and of docs/equations.md, 2, 0.7 * 0.00395 * 594
/// * 1.2 N m.
TEST(ModuleTable, SaysWhatThePaperSaysOfMtran) {
  EXPECT_EQ(row("mtran"), "65 x 65 x 130 mm             0.400 kg  2 hinges  1.971 N m");
  const std::string text = table("mtran");
  EXPECT_TRUE(contains(text, "mtran: 65 x 65 x 130 mm, 0.4 kg in 3 bodies, 2 hinges and 6 faces")) << text;
  EXPECT_TRUE(contains(text, "active   +y    -90 to 90 deg")) << text;
  EXPECT_TRUE(contains(text, "active   0.16 kg  -35.53 0 0 mm               0.0001065 9.88e-05 0.000105")) << text;
  EXPECT_TRUE(contains(text, "type: Murata and Kurokawa")) << text;
  EXPECT_TRUE(contains(text, "actuator: chosen")) << text;
}

TEST(ModuleTable, SaysWhatConnectorsBear) {
  const std::string text = table("rofi");  // the connector RoFICoM has 110 N along and 50 N across its normal
  EXPECT_TRUE(contains(text, "110 N")) << text;
  EXPECT_TRUE(contains(text, "50 N")) << text;
  EXPECT_TRUE(contains(text, "free")) << text;
}

TEST(ModuleTable, HoldsModulesWithoutHingesAndWithoutMotors) {
  EXPECT_TRUE(contains(row("revolve_brick"), "0 hinges  -")) << row("revolve_brick");
  EXPECT_TRUE(contains(table("revolve_brick"), "no hinges"));
  EXPECT_TRUE(contains(table("rod"), "1 hinge"));
}

TEST(ModuleTable, HasLinesThatFit) {
  for (const auto& file : std::filesystem::directory_iterator(kScenarios + "modules")) {
    std::istringstream lines(app::module_table(read_module(file.path().string(), catalog())));
    for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 100U) << file.path() << ": " << line;
  }
}

}  // namespace
}  // namespace gaitlab::test
