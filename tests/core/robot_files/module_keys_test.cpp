// The list of a module file's keys: reader, manual and schema agree with it.
#include "core/robot_files/module_keys.h"

#include <gtest/gtest.h>

#include "core/robot_files/key_reader.h"
#include "core/robot_files/module_manual.h"

namespace gaitlab {
namespace {

constexpr const ModuleMap* kAllMaps[] = {&kModuleMap, &kBodyMap,      &kShapeMap,    &kHingeMap,
                                         &kFaceMap,   &kConnectorMap, &kContactsMap, &kContactMap};

TEST(ModuleKeys, AreAllInTheManual) {
  const std::string manual = "\n" + explain_module_file();
  const std::string page = module_page();
  for (const ModuleMap* map : kAllMaps) {
    for (const ModuleKey& key : map->keys) {
      EXPECT_TRUE(manual.find(" " + std::string(key.key)) != std::string::npos ||
                  manual.find("\n" + std::string(key.key)) != std::string::npos)
          << key.key;
      EXPECT_NE(page.find(std::string(key.spec.about).substr(0, 12)), std::string::npos) << key.key;
    }
  }
}

TEST(ModuleKeys, HaveTheDefaultsOfTheTypes) {
  const auto preset = [](const char* key) { return nlohmann::json::parse(kHingeMap.at(key).preset).get<double>(); };
  const Passive passive;
  EXPECT_EQ(preset("stiffness"), passive.stiffness);
  EXPECT_EQ(preset("rest"), passive.rest);
  EXPECT_EQ(preset("damping"), passive.damping);
  EXPECT_EQ(preset("friction"), passive.friction);
  EXPECT_EQ(preset("friction_speed"), passive.friction_speed);
  EXPECT_EQ(kShapeMap.one_of.size(), 4U) << "the kinds of Shape::Kind, in its order";
  EXPECT_STREQ(kShapeMap.one_of[static_cast<std::size_t>(Shape::Kind::sphere)], "sphere");
  EXPECT_STREQ(kShapeMap.one_of[static_cast<std::size_t>(Shape::Kind::half_cylinder)], "half_cylinder");
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
