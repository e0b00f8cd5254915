// Tests of places within scalars, and of texts of several lines that are printed as blocks.
#include "core/settings/node_places.h"

#include <gtest/gtest.h>

#include <random>

namespace gaitlab {
namespace {

/// Character of a YAML text at a place.
char character(const std::string& yaml, const SourceLocation& place) {
  std::size_t line = 0;
  for (int k = 1; k < place.line; ++k) line = yaml.find('\n', line) + 1;
  return yaml[line + static_cast<std::size_t>(place.column) - 1];
}

Node scalar(const std::string& text) {
  Node node{Node::Kind::scalar};
  node.text = text;
  node.quoted = true;
  return node;
}

std::string repeated(const std::string& text, char c) {
  std::string out;
  for (const char one : text) out += one == c ? std::string(2, c) : std::string(1, one);
  return out;
}

/// Expects the correct place of every character except line ends.
void expect_places(const std::string& yaml, const Node& node, const std::string& text) {
  ASSERT_EQ(node.text, text) << yaml;
  for (std::size_t k = 0; k < text.size(); ++k) {
    if (text[k] == '\n') continue;
    EXPECT_EQ(character(yaml, place_in(node, k)), text[k]) << yaml << "\n" << k;
  }
}

TEST(NodePlaces, EveryCharacterOfManyTexts) {
  std::mt19937 random(7);
  const std::string letters = "ab+ '#:\n|x[";
  for (int round = 0; round < 3000; ++round) {
    std::string text = "s";
    const std::size_t size = random() % 12;
    for (std::size_t k = 0; k < size; ++k) text += letters[random() % letters.size()];
    text += 'e';
    Node map{Node::Kind::map};
    map.keys = {{"k", {}}, {"after", {}}};
    map.items = {scalar(text), scalar("z")};
    // The tree is printed in double quotes or as a block, and read again.
    const std::string printed = "top:\n" + print_yaml(map, 2);
    const Node back = parse_yaml(printed, "f");
    expect_places(printed, back.items[0].items[0], text);
    EXPECT_EQ(back.items[0].items[1].text, "z") << printed;
    if (text.find('\n') != std::string::npos) continue;
    const std::string single = "top: [a, '" + repeated(text, '\'') + "']\n";
    expect_places(single, parse_yaml(single, "f").items[0].items[1], text);
    if (text.find_first_of("#:'") != std::string::npos) continue;
    const std::string yaml = "a: 1\nb:  " + text + "\n";
    expect_places(yaml, parse_yaml(yaml, "f").items[1], text);
  }
}

TEST(NodePlaces, TheEndIsBehindTheLastCharacter) {
  const Node root = parse_yaml("a: bc\nd: 'e'\nf: |\n  gh\n", "f");
  EXPECT_EQ(to_string(place_in(root.items[0], 2)), "f:1:6");
  EXPECT_EQ(to_string(place_in(root.items[0], 99)), "f:1:6");
  EXPECT_EQ(to_string(place_in(root.items[1], 1)), "f:2:6");
  EXPECT_EQ(to_string(place_in(root.items[2], 2)), "f:4:5");
}

TEST(NodePlaces, ABlockWithWindowsLineEndsAndAByteOrderMark) {
  const Node root = parse_yaml(
      "\xEF\xBB\xBF"
      "a: |\r\n\r\n  b\r\n   c\r\n",
      "f");
  ASSERT_EQ(root.items[0].text, "\nb\n c\n");
  EXPECT_EQ(to_string(place_in(root.items[0], 1)), "f:3:3");
  EXPECT_EQ(to_string(place_in(root.items[0], 4)), "f:4:4");
}

TEST(NodePlaces, WhatCannotBeFollowedHasTheScalarsPlace) {
  const Node root = parse_yaml("a: >\n  b\n  c\nd: \"e\\x41f\"\ng: h\n  i\nj: \"k\n  l\"\n", "f");
  EXPECT_EQ(to_string(place_in(root.items[0], 2)), "f:1:4");
  EXPECT_EQ(to_string(place_in(root.items[1], 0)), "f:4:5");
  EXPECT_EQ(to_string(place_in(root.items[1], 2)), "f:4:4");
  EXPECT_EQ(to_string(place_in(root.items[2], 2)), "f:5:4");
  EXPECT_EQ(to_string(place_in(root.items[3], 2)), "f:7:4");
  EXPECT_EQ(to_string(place_in(root, 2)), "f:1:1");
}

}  // namespace
}  // namespace gaitlab
