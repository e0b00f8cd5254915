// Tests of the checks that yaml-cpp 0.7 requires (docs/decisions/0003-strict-yaml.md), and of print_yaml.
#include "core/settings/node.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/core/scenario/fakes.h"
#include "tests/cpu_time.h"
#include "tests/labels.h"
#include "tests/messages.h"

namespace gaitlab {
namespace {

const test::Label kLongNode("Node.HostileTextsEndSoon", "long");

using test::message_of;

std::string error(const std::string& text) {
  return message_of([&] { parse_yaml(text, "f"); });
}

TEST(Node, KnowsPlacesAndKinds) {
  const Node root = parse_yaml("a: 1\nb: [x, '5', {c: ~}]\nd:\n  - e: \"q\"\n", "f");
  ASSERT_EQ(root.kind, Node::Kind::map);
  EXPECT_EQ(to_string(root.find("a")->place), "f:1:4");
  EXPECT_EQ(to_string(root.keys[1].second), "f:2:1");
  const Node& b = *root.find("b");
  EXPECT_TRUE(b.flow);
  EXPECT_FALSE(b.items[0].quoted);
  EXPECT_TRUE(b.items[1].quoted);
  EXPECT_EQ(b.items[2].find("c")->kind, Node::Kind::null);
  EXPECT_FALSE(root.find("d")->flow);
  EXPECT_EQ(root.find("x"), nullptr);
}

TEST(Node, ADuplicateKeyIsAnErrorAtTheSecond) {
  EXPECT_EQ(error("a: 1\nb: 2\na: 3\n"), "f:3:1: error: duplicate key 'a'\nf:1:1: note: it is given here first");
  EXPECT_EQ(error("m: {a: 1, 'a': 2}\n"), "f:1:11: error: duplicate key 'a'\nf:1:5: note: it is given here first");
}

TEST(Node, AnchorsAliasesAndTagsAreRefused) {
  EXPECT_EQ(error("a: &x 1\n"), "f:1:4: error: found the anchor '&x'; anchors and aliases are not supported");
  EXPECT_EQ(error("a: &x 1\nb: *x\n"),
            "f:1:4: error: found the anchor '&x'; anchors and aliases are not supported\n"
            "f:2:4: error: found an alias (*name); write the value itself");
  EXPECT_EQ(error("a: &x [*x]\n"),
            "f:1:4: error: found the anchor '&x'; anchors and aliases are not supported\n"
            "f:1:8: error: found an alias (*name); write the value itself");
  EXPECT_EQ(error("a: *x\n"),
            "f:1:4: error: not valid YAML: found * outside of quotes; a pattern goes in quotes: \"*/active\"");
  EXPECT_EQ(error("a: !!float 1\n"), "f:1:4: error: found the tag 'tag:yaml.org,2002:float'; explicit tags are not supported");
  EXPECT_EQ(error("a: ! 1\n"), "f:1:4: error: found the tag '!'; explicit tags are not supported");
  EXPECT_EQ(error("a: !t [1]\n"), "f:1:4: error: found the tag '!t'; explicit tags are not supported");
  EXPECT_EQ(error("a: !t {b: 1}\n"), "f:1:4: error: found the tag '!t'; explicit tags are not supported");
}

TEST(Node, AMergeKeyIsAnOrdinaryKey) { EXPECT_EQ(parse_yaml("a: {<<: 1}\n", "f").find("a")->keys[0].first, "<<"); }

TEST(Node, ASecondDocumentIsRefused) {
  EXPECT_EQ(error("a: 1\n---\nb: 2\n"), "f:2:1: error: found a second YAML document; expected one per file");
  EXPECT_EQ(error("a: 1\n---\n"), "f:2:1: error: found a second YAML document; expected one per file");
  EXPECT_EQ(error("---\na: 1\n...\n"), test::kNoError);
}

TEST(Node, TheRootIsAMap) {
  EXPECT_EQ(error(","), "f:1:1: error: found empty; expected a map (KEY: VALUE lines)");  // LoadAll(",") would never return
  EXPECT_EQ(error("- 1\n"), "f:1:1: error: found a list; expected a map (KEY: VALUE lines)");
  EXPECT_EQ(error("word\n"), "f:1:1: error: found 'word'; expected a map (KEY: VALUE lines)");
  EXPECT_EQ(error(""), "f: error: the file is empty; expected a map (KEY: VALUE lines)");
  EXPECT_EQ(error("# only a comment\n"), "f: error: the file is empty; expected a map (KEY: VALUE lines)");
}

TEST(Node, KeysAreNames) {
  EXPECT_EQ(error("? [a]\n: 1\n"), "f:1:3: error: found a list as a key; expected a name");
  EXPECT_EQ(error("{a: 1}: 1\n"), "f:1:1: error: found a map as a key; expected a name");
  EXPECT_EQ(error("~: 1\n"), "f:1:1: error: found nothing as a key; expected a name");
}

TEST(Node, DepthAndSizeAreLimited) {
  EXPECT_EQ(error("a: " + std::string(31, '[') + std::string(31, ']')), test::kNoError);
  EXPECT_EQ(error("a: " + std::string(32, '[') + std::string(32, ']')), "f:1:35: error: nested deeper than 32 levels");
  EXPECT_EQ(error("a: " + std::string(1 << 24, 'x')), "f: error: the text is larger than 16 MB");
  std::string many = "a: [";
  for (int i = 0; i < 1 << 19; ++i) many += "1,\n";
  EXPECT_EQ(error(many + "]"), "f:524288:1: error: more than 524288 values");  // the key is one of them
}

TEST(Node, AnAliasBombCostsNothing) {
  std::string bomb = "a0: &a0 [x, x]\n";
  for (int i = 1; i < 40; ++i) {
    const std::string before = "*a" + std::to_string(i - 1);
    bomb += fmt::format("a{0}: &a{0} [{1}, {1}]\n", i, before);
  }
  EXPECT_NE(error(bomb).find("found an alias"), std::string::npos);
}

TEST(Node, OnlyTextIsRead) {
  using namespace std::string_literals;
  EXPECT_EQ(error("a: 1\nb: \0\n"s), "f:2:4: error: found a NUL byte; expected a text file");
  EXPECT_EQ(error("a: \x04 b\n"), "f:1:4: error: found the control character 0x04; expected a text file");
  EXPECT_EQ(error("a: \xff\n"), "f:1:4: error: found the byte 0xff, which is not UTF-8; expected a text file");
  EXPECT_EQ(error("a: \xC0\xAF\n"), "f:1:4: error: found the byte 0xc0, which is not UTF-8; expected a text file");
  EXPECT_EQ(error("a: 1\rb: 2\r"), "f:1:5: error: found a carriage return without a line feed; expected a text file");
  EXPECT_EQ(parse_yaml("\xEF\xBB\xBF"
                       "a: 'x'\r\nb: 'gr\xC3\xBC\xC3\x9F'\r\n",
                       "f")
                .find("b")
                ->text,
            "gr\xC3\xBC\xC3\x9F");
}

TEST(Node, SyntaxErrorsHaveAPlace) {
  EXPECT_EQ(error("a: [1, 2\n"), "f:1:4: error: not valid YAML: the [ opened here is not closed; expected ]");
  EXPECT_EQ(error("a: b: c\n"),
            "f:1:5: error: not valid YAML: found a second colon in 'b: c'; expected braces, {b: c}, a text in quotes, or a "
            "line for each key");
}

TEST(Node, AMissingFileIsReportedWhereItWasAskedFor) {
  EXPECT_EQ(message_of([] { read_yaml("/nowhere/x.yaml"); }),
            "/nowhere/x.yaml: error: cannot be read: No such file or directory");
  EXPECT_EQ(message_of([] {
              read_yaml("/nowhere/x.yaml", {"s.yaml", 3, 7});
            }),
            "s.yaml:3:7: error: file '/nowhere/x.yaml' cannot be read: No such file or directory");
  EXPECT_EQ(message_of([] { read_yaml("/tmp"); }), "/tmp: error: cannot be read: Is a directory");
  EXPECT_EQ(message_of([] { read_yaml("/dev/zero"); }), "/dev/zero: error: cannot be read: not a regular file");
}

// Expects equal kinds, texts and flags of two trees; places may differ.
void expect_same(const Node& a, const Node& b) {
  EXPECT_EQ(a.kind, b.kind);
  EXPECT_EQ(a.text, b.text);
  EXPECT_EQ(a.quoted, b.quoted) << a.text;
  EXPECT_EQ(a.flow, b.flow);
  ASSERT_EQ(a.keys.size(), b.keys.size());
  ASSERT_EQ(a.items.size(), b.items.size());
  for (std::size_t i = 0; i < a.keys.size(); ++i) EXPECT_EQ(a.keys[i].first, b.keys[i].first);
  for (std::size_t i = 0; i < a.items.size(); ++i) expect_same(a.items[i], b.items[i]);
}

TEST(PrintYaml, ReadsBackTheSame) {
  const std::string text =
      "a: 1\n"
      "b: a sentence, with a comma: \"quotes\"\n"
      "c: {x: [1, 2.5e-05, -1], y: 'no', joint.*: m3/passive, \"k: v\": ~}\n"
      "d:\n  - 1\n  - e: 2\n    f:\n      - {g: h}\n  - - 3\n    - [4]\n  - {}\n  - []\n  -\n"
      "h: |\n  two\n  lines\n"
      "i: 'null'\nj: ''\nk: '# no'\nl: \"tab\\t, quote \\\", backslash \\\\\"\nm: -\xC3\xBC\n\"\": 1\n\"-\": 1\n\"? x\": 2\n";
  const Node first = parse_yaml(text.substr(0, text.find("b: a")) + text.substr(text.find("c:")), "f");
  const std::string printed = print_yaml(first);
  expect_same(first, parse_yaml(printed, "g"));
  EXPECT_EQ(print_yaml(parse_yaml(printed, "g")), printed);
}

TEST(PrintYaml, QuotesWhatIsNotSafe) {
  Node node{Node::Kind::map};
  for (const char* text : {"plain", "a, b", "a: b", "a #b", "- a", "", "null", " a", "a\nb", "*x", "[", "a:"}) {
    node.keys.emplace_back("k" + std::to_string(node.keys.size()), SourceLocation{});
    node.items.push_back({Node::Kind::scalar, {}, text});
  }
  EXPECT_EQ(print_yaml(node),
            "k0: plain\nk1: a, b\nk2: \"a: b\"\nk3: \"a #b\"\nk4: \"- a\"\nk5: \"\"\nk6: \"null\"\nk7: \" a\"\nk8: \"a\\nb\"\n"
            "k9: \"*x\"\nk10: \"[\"\nk11: \"a:\"\n");
  node.flow = true;
  EXPECT_EQ(print_yaml(node).substr(0, 22), "{k0: plain, k1: \"a, b\"");
  const Node back = parse_yaml(print_yaml(node), "f");
  for (std::size_t i = 0; i < node.items.size(); ++i) EXPECT_EQ(back.items[i].text, node.items[i].text);
}

/// Characters that end a line for some readers of YAML, or that they refuse.
TEST(PrintYaml, EscapesWhatIsNotPrintable) {
  const std::pair<std::string, std::string> kEscapes[] = {
      {"\u0001", "\\x01"},   {"\u007f", "\\x7f"},   {"\u0080", "\\x80"},   {"\u0085", "\\x85"},   {"\u009f", "\\x9f"},
      {"\u2028", "\\u2028"}, {"\u2029", "\\u2029"}, {"\ufeff", "\\ufeff"}, {"\ufffe", "\\ufffe"}, {"\uffff", "\\uffff"}};
  for (const auto& [mark, escape] : kEscapes) {
    Node node{Node::Kind::map};
    for (const std::string& text : {"a" + mark + "b: 1", "two\nli" + mark + "nes\n"}) {
      node.keys.emplace_back(text, SourceLocation{});
      node.items.push_back({Node::Kind::scalar, {}, text});
      node.items.back().quoted = true;
    }
    const std::string printed = print_yaml(node);
    EXPECT_EQ(printed, fmt::format("\"a{0}b: 1\": \"a{0}b: 1\"\n\"two\\nli{0}nes\\n\": \"two\\nli{0}nes\\n\"\n", escape));
    expect_same(node, parse_yaml(printed, "f"));
  }
  const std::string others = "\u00a0\u00e9\u2027\u202f\uff5e\U0001f600";
  EXPECT_EQ(print_yaml(Node{Node::Kind::scalar, {}, others}), others + "\n");
}

TEST(Node, HostileTextsEndSoon) {
  for (const std::string part : {"[",    "{", "- ", "? ",     ": ",      "!a ",  "&a ",     "*a ",  "'",   "\"",  "{a: ",
                                 "[a, ", ",", "\t", "a: 1\n", "- [a]\n", "a\n ", "--- a\n", "%a\n", "'' ", "b:\n"}) {
    for (const std::string begin : {"k: ", "k:\n ", ""}) {
      const auto cost = [&](std::size_t size) {
        std::string text = begin;
        while (text.size() + part.size() < size) text += part;
        return test::cost_of([&] { error(text); });
      };
      // The ratio is 16 if the cost is linear (25 was measured) and 256 if it is quadratic. If other processes disturb the
      // measurement, the median of nine ratios replaces it.
      std::vector<double> ratios{cost(1U << 16) / cost(1U << 12)};
      while (ratios.front() > 64 && ratios.size() < 9) ratios.push_back(cost(1U << 16) / cost(1U << 12));
      std::ranges::nth_element(ratios, ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2));
      const double ratio = ratios[ratios.size() / 2];
      EXPECT_LT(ratio, 128) << begin << part;
    }
  }
}

}  // namespace
}  // namespace gaitlab
