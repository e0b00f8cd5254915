// Tests of the reasons why a text is not valid YAML.
#include "core/settings/yaml_faults.h"

#include <gtest/gtest.h>

#include "core/settings/node.h"
#include "tests/messages.h"

namespace gaitlab {
namespace {

std::string yaml_error(const std::string& text) {
  return test::message_of([&] { parse_yaml(text, "f"); });
}

TEST(YamlFaults, BracketsThatAreNotClosed) {
  EXPECT_EQ(yaml_error("a: {b: 1\nc: 2\n"), "f:1:4: error: not valid YAML: the { opened here is not closed; expected }");
  EXPECT_EQ(yaml_error("a:\n  - [1, [2, 3]\n  - [4]\n"),
            "f:2:5: error: not valid YAML: the [ opened here is not closed; expected ]");
  EXPECT_EQ(yaml_error("a: [1, {b: 2]\n"),
            "f:1:13: error: not valid YAML: found ], but the { opened in 1:8 is not closed; expected }");
  EXPECT_EQ(yaml_error("a: '{' # {\nb: \"it's [\"\nc: it's {x\nd: [1\n"),
            "f:4:4: error: not valid YAML: the [ opened here is not closed; expected ]");
}

TEST(YamlFaults, IndentationThatFitsNoLine) {
  EXPECT_EQ(yaml_error("a:\n  b: 1\n   c: 2\n"),
            "f:3:4: error: not valid YAML: 'c' is indented by 3 blanks, 'b' of line 2 by 2");
  EXPECT_EQ(yaml_error("a:\n    b: 1\n  c: 2\n"),
            "f:3:3: error: not valid YAML: 'c' is indented by 2 blanks, 'b' of line 2 by 4");
  EXPECT_EQ(yaml_error("a:\n  - b: 1\n  c: 2\n"),
            "f:3:3: error: not valid YAML: found the key 'c' among items of a list (-), which begins in line 2 with the same "
            "indentation");
  EXPECT_EQ(yaml_error("a:\n  b: 1\n  - 2\n"),
            "f:3:3: error: not valid YAML: found an item of a list (-) among keys; 'b' of line 2 has the same indentation");
}

TEST(YamlFaults, QuotesThatAreNotClosed) {
  const std::string open = ": error: not valid YAML: the \" opened here is not closed; expected \"";
  EXPECT_EQ(yaml_error("a: {b: \"c}\n"), "f:1:8" + open);
  EXPECT_EQ(yaml_error("a: {b: \"c}\nd: \"e\"\n"), "f:1:8" + open) << "closed by the next quote";
  EXPECT_EQ(yaml_error("a: \"b\nc: \"d\"\n"), "f:1:4" + open);
  EXPECT_EQ(yaml_error("a: {b: \"c \\\" d}\n"), "f:1:8" + open) << "a quote after a backslash is part of the text";
  EXPECT_EQ(yaml_error("a: \"b \\\" c\n"), "f:1:4" + open) << "at the end of the text";
  EXPECT_EQ(yaml_error("a: 'it''s\n"), "f:1:4: error: not valid YAML: the ' opened here is not closed; expected '");
  EXPECT_EQ(yaml_error("a: \"\\\\\"\nb: ''\nc: ''''\n\"d\": 1\n"), "no error");
  EXPECT_EQ(yaml_error("a: {b: 'it''s}\n"), "f:1:8: error: not valid YAML: the ' opened here is not closed; expected '");
}

TEST(YamlFaults, TextsAfterAValue) {
  EXPECT_EQ(yaml_error("a: [1] 2\n"),
            "f:1:8: error: not valid YAML: found '2' after the ] that ends the value; expected the end of the line");
  EXPECT_EQ(yaml_error("a: {b: [1] 2}\n"),
            "f:1:12: error: not valid YAML: found '2}' after the ] that ends the value; expected a comma or a closing bracket");
  EXPECT_EQ(yaml_error("a: ]\n"), "f:1:4: error: not valid YAML: found ], but no [ is open; expected [ before it");
}

// The scanner of lines does not understand these texts, which precede a fault of another kind.
TEST(YamlFaults, AreNotSeenInBlocks) {
  EXPECT_EQ(
      yaml_error("a: |\n  \"x\" y {z} w ]\n  'q' r\nb: c: d\n"),
      "f:4:5: error: not valid YAML: found a second colon in 'c: d'; expected braces, {c: d}, a text in quotes, or a line "
      "for each key");
}

TEST(YamlFaults, OtherFaultsKeepTheWordsOfTheParser) {
  EXPECT_EQ(yaml_fault_in_words("some rule", "a: b", 3), "some rule");
  EXPECT_EQ(yaml_fault("", "f", 1).text, "");
  EXPECT_EQ(yaml_fault("a: 1\nb: 2\n", "f", 2).text, "");
}

}  // namespace
}  // namespace gaitlab
