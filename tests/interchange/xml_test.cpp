// Tests of the XML text of exported robot formats.
#include "interchange/xml.h"

#include <gtest/gtest.h>

namespace gaitlab::interchange {
namespace {

TEST(Xml, IsIndentedAndEscaped) {
  Xml root;
  root.name = "robot";
  set(root, "name", "a & b < c > \"d\" 'e' é");
  comment(root, "a comment -- with ---- hyphens, & as it is");
  Xml& body = add(root, "body");
  set(add(body, "joint"), "axis", "0 0 1");
  add(root, "key");
  set(body, "pos", "1");
  set(body, "quat", "2");
  set(body, "pos", "3");
  EXPECT_EQ(print(root),
            "<robot name=\"a &amp; b &lt; c &gt; &quot;d&quot; &apos;e&apos; é\">\n"
            "    <!-- a comment - with - hyphens, & as it is -->\n"
            "    <body pos=\"3\" quat=\"2\">\n"
            "        <joint axis=\"0 0 1\"/>\n"
            "    </body>\n"
            "    <key/>\n"
            "</robot>\n");
  ASSERT_NE(body.attribute("pos"), nullptr);
  EXPECT_EQ(*body.attribute("pos"), "3");
  EXPECT_EQ(body.attribute("size"), nullptr);
}

// The size of nested elements is proportional to their number. (In a chain of 3000 modules, indentation once took 2.6 of 2.7
// GB.)
TEST(Xml, OfElementsWithinOneAnotherGrowsWithTheirNumber) {
  const auto nested = [](int levels) {
    Xml root;
    root.name = "body";
    Xml* last = &root;
    for (int level = 1; level < levels; ++level) last = &add(*last, "body");
    return print(root).size();
  };
  EXPECT_EQ(nested(2000) - nested(1000), nested(3000) - nested(2000));
}

}  // namespace
}  // namespace gaitlab::interchange
