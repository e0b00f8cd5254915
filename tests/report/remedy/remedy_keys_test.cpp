// Numbers of a resolved scenario multiplied by key: scalars, maps by joint, lists, and keys that are missing.
#include "report/remedy/remedy_keys.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gaitlab::test {
namespace {

using report::remedy_keys;
using report::RemedyKey;
using report::RemedySettings;

const RemedyKey& remedy_key(const std::string& name) {
  for (const RemedyKey& key : remedy_keys()) {
    if (key.name == name) return key;
  }
  throw std::invalid_argument(name);
}

using Sets = std::vector<std::string>;

TEST(RemedySettings, MultipliesNumbersWhereTheyStand) {
  const RemedySettings settings(
      "cpg: {frequency: 0.25, amplitude: {default: 0.5, \"*/gamma\": 0, m3/active: 0.2}}\n"
      "actuator: {u_max: 7.4, i_max: [1.2, 0.6], type: dc_motor}\nduration: 20\n");
  EXPECT_EQ(settings.scaled(remedy_key("u_max"), 0.5), Sets{"actuator.u_max=3.7"});
  EXPECT_EQ(settings.scaled(remedy_key("amplitude"), 2),
            Sets{"cpg.amplitude={\"default\": 1, \"*/gamma\": 0, \"m3/active\": 0.4}"});
  EXPECT_EQ(settings.scaled(remedy_key("u_max and i_max"), 2), (Sets{"actuator.u_max=14.8", "actuator.i_max=[2.4, 1.2]"}));
  EXPECT_EQ(settings.value(remedy_key("frequency")), 0.25);
  EXPECT_TRUE(std::isnan(settings.value(remedy_key("amplitude"))));
  EXPECT_TRUE(std::isnan(settings.value(remedy_key("u_max and i_max"))));
}

TEST(RemedySettings, ASlowerGaitIsRunForLonger) {
  const RemedySettings settings("cpg: {frequency: 0.25}\nduration: 20\n");
  EXPECT_EQ(settings.scaled(remedy_key("frequency"), 0.5), (Sets{"cpg.frequency=0.125", "duration=40"}));
  EXPECT_EQ(settings.scaled(remedy_key("frequency"), 0.3), (Sets{"cpg.frequency=0.075", "duration=66.667"}));
  EXPECT_EQ(settings.scaled(remedy_key("frequency"), 2), Sets{"cpg.frequency=0.5"});
}

TEST(RemedySettings, AKeyWithoutNumbersIsMissing) {
  const RemedySettings settings("cpg: {type: table, amplitude: {default: 0}}\nactuator: {u_max: 0, i_max: 1}\nduration: 1\n");
  EXPECT_FALSE(settings.has(remedy_key("frequency")));
  EXPECT_FALSE(settings.has(remedy_key("amplitude")));
  EXPECT_FALSE(settings.has(remedy_key("u_max")));
  EXPECT_FALSE(settings.has(remedy_key("u_max and i_max")));
  EXPECT_FALSE(settings.has(remedy_key("friction")));
  EXPECT_TRUE(settings.has(remedy_key("i_max")));
}

}  // namespace
}  // namespace gaitlab::test
