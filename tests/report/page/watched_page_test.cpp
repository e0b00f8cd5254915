// The picture with the message of an error, beside a page of `gaitlab watch`.
#include <gtest/gtest.h>

#include <string>

#include "report/page/page.h"

namespace gaitlab::report {
namespace {

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

TEST(WatchedPage, TheMessageIsAPictureOfItsLines) {
  const std::string picture = picture_of("a.yaml:3:1: error: unknown key x <b>\na.yaml:4:2: error: expected & found");
  EXPECT_NE(picture.find("width=\"285\" height=\"36\""), std::string::npos)
      << picture;  // 36 characters of 7.9 px, 2 lines of 18 px
  EXPECT_NE(picture.find(">a.yaml:3:1: error: unknown key x &lt;b&gt;</text>"), std::string::npos) << picture;
  EXPECT_NE(picture.find(">a.yaml:4:2: error: expected &amp; found</text>"), std::string::npos) << picture;
  EXPECT_FALSE(stamped(picture)) << "the stamp of a folder is another picture";
}

TEST(WatchedPage, ALongMessageHasLinesOf110CharactersAndAtMostTwenty) {
  std::string words;
  for (int k = 0; k < 30; ++k) words += "expected ";
  const std::string picture = picture_of(words);
  EXPECT_EQ(count(picture, "<text"), 3u) << picture;
  EXPECT_EQ(count(picture, "expected"), 30u) << picture;
  std::string lines;
  for (int k = 0; k < 200; ++k) lines += "a.yaml: error\n";
  EXPECT_EQ(count(picture_of(lines), "<text"), 20u);
  EXPECT_EQ(count(picture_of(std::string(1000, 'x')), "<text"), 3u);  // a word without blanks is cut
}

}  // namespace
}  // namespace gaitlab::report
