// Tests of the list of settings in which two texts differ.
#include "core/settings/changed_settings.h"

#include <gtest/gtest.h>

namespace gaitlab::test {
namespace {

using Sentences = std::vector<std::string>;

TEST(ChangedSettings, NamesThePathOfEveryChangedSetting) {
  const std::string then = "actuator:\n  type: dc_motor\n  i_max: 1.2\ncontroller: {Kp: 100}\nduration: 20\n";
  EXPECT_EQ(changed_settings(then, then), Sentences{});
  EXPECT_EQ(changed_settings(then, "actuator:\n  type: dc_motor\n  i_max: 0.45\ncontroller: {Kp: 97}\nduration: 20\n"),
            (Sentences{"actuator.i_max: 1.2 -> 0.45", "controller.Kp: 100 -> 97"}));
}

TEST(ChangedSettings, WhatOneTextLacksIsNotSet) {
  EXPECT_EQ(changed_settings("cpg: {type: sine, phase_lag: 1.2}\n", "cpg: {type: tripod, model: {tilt: 0.4}}\nseed: 1\n"),
            (Sentences{"cpg.type: sine -> tripod", "cpg.model: not set -> {tilt: 0.4}", "cpg.phase_lag: 1.2 -> not set",
                       "seed: not set -> 1"}));
  EXPECT_EQ(changed_settings("angles: 0\n", "angles: {m0/active: 0.3}\n"), Sentences{"angles: 0 -> {m0/active: 0.3}"});
}

TEST(ChangedSettings, AVectorIsOneValueAndALongListHasElements) {
  EXPECT_EQ(changed_settings("gravity: [0, 0, -9.81]\n", "gravity: [0, 0, -1.62]\n"),
            Sentences{"gravity: [0, 0, -9.81] -> [0, 0, -1.62]"});
  EXPECT_EQ(changed_settings("angles: [1, 2, 3, 4, 5, 6, 7]\n", "angles: [1, 2, 3, 9, 5, 6, 8]\n"),
            (Sentences{"angles[3]: 4 -> 9", "angles[6]: 7 -> 8"}));
  EXPECT_EQ(changed_settings("docks:\n  - [1, 1, 4, 0, 1]\n  - [1, 2, 4, 1, 3]\n",
                             "docks:\n  - [1, 1, 4, 0, 1]\n  - [1, 2, 4, 1, 1]\n"),
            Sentences{"docks[1]: [1, 2, 4, 1, 3] -> [1, 2, 4, 1, 1]"});
  EXPECT_EQ(
      changed_settings("boxes:\n  - {size: 1, mass: 2}\n  - {size: 3}\n", "boxes:\n  - {size: 1, mass: 4}\n  - {size: 3}\n"),
      Sentences{"boxes[0].mass: 2 -> 4"});
}

TEST(ChangedSettings, AnElementMoreInTheMiddleIsOneChange) {
  const std::string two = "docks:\n  - [1, 1]\n  - [3, 3]\n";
  const std::string three = "docks:\n  - [1, 1]\n  - [2, 2]\n  - [3, 3]\n";
  EXPECT_EQ(changed_settings(two, three), Sentences{"docks[1]: not set -> [2, 2]"});
  EXPECT_EQ(changed_settings(three, two), Sentences{"docks[1]: [2, 2] -> not set"});
}

TEST(ChangedSettings, CountsThoseThatAreTooMany) {
  EXPECT_EQ(changed_settings("a: 1\nb: 1\nc: 1\n", "a: 2\nb: 2\nc: 2\n", 1),
            (Sentences{"a: 1 -> 2", "... and 2 more settings"}));
}

TEST(ChangedSettings, LongValuesAreShownAroundTheChange) {
  const std::string start(40, 'x');
  EXPECT_EQ(changed_settings("path: " + start + "old\n", "path: " + start + "new\n"),
            Sentences{"path: ...xxxxxxxxold -> ...xxxxxxxxnew"});
  EXPECT_EQ(changed_settings("a: 1\n", "a: 1\nb: " + start + "\n"), Sentences{"b: not set -> " + start.substr(0, 30) + "..."});
  EXPECT_EQ(changed_settings("equations: |\n  dx = 1\n  dy = 2\n", "equations: |\n  dx = 1\n  dy = 3\n"),
            Sentences{"equations, line 2: \"dy = 3\", was \"dy = 2\""});
}

TEST(ChangedSettings, LinesWhereThereIsNoSetting) {
  EXPECT_EQ(changed_settings("a: 1\n", "a: [1\n"), Sentences{"line 1: \"a: [1\", was \"a: 1\""});
  EXPECT_EQ(changed_settings("a: 1\n", "a: 1 # why\n"), Sentences{"line 1: \"a: 1 # why\", was \"a: 1\""});
}

// Control characters of a golden, whose origin may be unknown, are escaped before they reach the terminal.
TEST(ChangedSettings, ControlCharactersAreWrittenOut) {
  for (const std::string& text : changed_settings("a: 1\n", "a: \"\\x1b[2J\"\n\"\\x1b\": 2\n"))
    EXPECT_EQ(text.find('\x1b'), std::string::npos) << text;
}

}  // namespace
}  // namespace gaitlab::test
