// The keys of module files: reader, manual and schema agree.
#include "core/robot_files/module_keys.h"

#include <gtest/gtest.h>

#include "core/robot_files/module_manual.h"

namespace gaitlab {
namespace {

TEST(ModuleKeys, TheManualStatesDefaultsAndWhatIsRequired) {
  const std::string manual = explain_module_file();
  for (const char* row :
       {"\ngaitlab_module: default 1; 1\n", "\nname: required; text\n", "\nbodies.NAME: required; map by name\n",
        "\n    com (m): default [0, 0, 0]; 3 numbers\n", "\n    inertia (kg m^2): 6 numbers\n",
        "\n        sphere (m): more than 0\n", "\n    range (rad): required; 2 numbers | free\n",
        "\n    friction_speed (rad/s): default 0.1; 1e-06 to 1000\n", "\n    actuator: map\n", "\ncontacts: map\n",
        "\n    feet[]: list | shapes\n", "\nmay_overlap: default []; list of pairs\n"})
    EXPECT_NE(manual.find(row), std::string::npos) << row;
  EXPECT_EQ(manual.find("Radius of the sphere."), manual.rfind("Radius of the sphere.")) << "keys of contacts, once";
}

TEST(ModuleKeys, ASchemaRequiresWhatTheReaderRequires) {
  const nlohmann::ordered_json schema = module_type_schema();
  EXPECT_EQ(schema["required"].dump(), R"(["name","bodies"])");
  const nlohmann::ordered_json& hinge = schema["properties"]["hinges"]["items"];
  EXPECT_EQ(hinge["required"].dump(), R"(["name","parent","child","axis","range"])");
  EXPECT_EQ(hinge["properties"]["range"]["anyOf"][1].dump(), R"({"enum":["free"]})");
  EXPECT_EQ(hinge["properties"]["drive"].dump(),
            R"({"enum":["motor","none"],"description":"motor, or none for a passive hinge.","default":"motor"})");
}

}  // namespace
}  // namespace gaitlab
