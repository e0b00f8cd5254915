#include "report/plot/pdf.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <array>
#include <cmath>
#include <limits>

#include "report/plot/font.h"

namespace gaitlab::report {
namespace {

/// Number that follows `key` in a text.
std::size_t number_after(const std::string& text, const std::string& key, std::size_t from = 0) {
  const std::size_t at = text.find(key, from);
  return at == std::string::npos ? 0 : std::stoul(text.substr(at + key.size()));
}

/// Content of the first stream of a file at or behind `from`. The page is the first stream of a file.
std::string stream_of(const std::string& file, std::size_t from = 0) {
  const std::size_t start = file.find("stream\n", from) + 7;
  const std::string packed = file.substr(start, number_after(file, "/Length ", from));
  std::string page(1 << 20, '\0');
  uLongf size = page.size();
  EXPECT_EQ(
      uncompress(reinterpret_cast<Bytef*>(page.data()), &size, reinterpret_cast<const Bytef*>(packed.data()), packed.size()),
      Z_OK);
  page.resize(size);
  return page;
}

TEST(Pdf, OffsetsAndLengthsAreRight) {
  Pdf pdf({100, 50, 0.2});
  pdf.polyline(std::vector<Point>{{0, 0}, {10, 20.126}}, {.stroke = colour::kBlue, .dash = "8 3"});
  pdf.text({5, 5}, "\xCF\x84 (N m)", {});
  const std::string file = pdf.finish();
  EXPECT_TRUE(file.starts_with("%PDF-1.4\n"));
  EXPECT_TRUE(file.ends_with("%%EOF\n"));
  const std::size_t table = number_after(file, "startxref\n");
  ASSERT_EQ(file.substr(table, 5), "xref\n");
  const std::size_t count = number_after(file, "xref\n0 ", table);
  ASSERT_EQ(number_after(file, "/Size "), count);
  const std::size_t first = file.find("0000000000 65535 f \n", table);
  for (std::size_t i = 1; i < count; ++i) {
    const std::string entry = file.substr(first + 20 * i, 20);
    EXPECT_EQ(entry.substr(10), " 00000 n \n");
    const std::string head = std::to_string(i) + " 0 obj\n";
    EXPECT_EQ(file.substr(std::stoul(entry), head.size()), head);
  }
  const std::size_t start = file.find("stream\n") + 7;
  EXPECT_EQ(file.substr(start + number_after(file, "/Length "), 10), "\nendstream");
  // The width of 100 px of 0.2 mm is 20 mm or 56.69 pt.
  EXPECT_NE(file.find("/MediaBox [0 0 56.69 28.35]"), std::string::npos);
  EXPECT_EQ(file.find("Date"), std::string::npos);
}

TEST(Pdf, PathsAreThoseOfSvg) {
  Pdf pdf({100, 50, 0.2});
  pdf.polyline(std::vector<Point>{{0, 0}, {10, 20.126}, {std::numeric_limits<double>::quiet_NaN(), 3}, {30, 3}, {40, 3}},
               {.stroke = colour::kBlue, .width = 1.6, .dash = "8 3"});
  pdf.polygons(std::vector<Polygon>{{{1, 1}, {2, 1}, {2, 2}}}, {.stroke = "#FF0000", .fill = "#00FF00", .stroke_below = true});
  const std::string page = stream_of(pdf.finish());
  EXPECT_NE(page.find("0 0.447 0.698 RG 1.6 w [8 3] 0 d 1 j 0 0 m 10 20.13 l\n30 3 m 40 3 l\nS Q\n"), std::string::npos)
      << page;
  // The stroke is drawn before the filling.
  const std::string triangle = "1 1 m 2 1 l\n2 2 l\nh ";
  EXPECT_NE(page.find(triangle + "S\n" + triangle + "f Q\n"), std::string::npos) << page;
  EXPECT_EQ(page.find("nan"), std::string::npos);
}

/// The text that a reader copies: the glyphs of the page, in order, through the map /ToUnicode of their font.
std::u32string copied(const std::string& file) {
  const std::string page = stream_of(file);
  std::u32string text;
  for (std::size_t at = page.find(" Tf <"); at != std::string::npos; at = page.find(" Tf <", at + 1)) {
    const std::size_t font = page.rfind("/F", at);
    const std::size_t object = number_after(file, " /F" + page.substr(font + 2, 1) + " ");
    const std::size_t map = number_after(file, "/ToUnicode ", file.find("\n" + std::to_string(object) + " 0 obj"));
    const std::string unicode = stream_of(file, file.find("\n" + std::to_string(map) + " 0 obj"));
    for (std::size_t digit = at + 5; page[digit] != '>'; digit += 4) {
      const std::size_t entry = unicode.find("\n<" + page.substr(digit, 4) + "> <");
      EXPECT_NE(entry, std::string::npos) << page.substr(digit, 4);
      if (entry != std::string::npos) text += static_cast<char32_t>(std::stoul(unicode.substr(entry + 9, 4), nullptr, 16));
    }
  }
  return text;
}

TEST(Pdf, TextCanBeCopied) {
  Pdf pdf({100, 50, 0.2});
  pdf.text({5, 5}, "a(b)\\c \u00E9 \u22122\u00B7\u03C4\u00B2, m s\u207B\u00B9", {});
  pdf.text({5, 9}, "\u03A9 \u2264 \u0161", {.bold = true});
  EXPECT_EQ(copied(pdf.finish()), U"a(b)\\c \u00E9 \u22122\u00B7\u03C4\u00B2, m s\u207B\u00B9\u03A9 \u2264 \u0161");
  EXPECT_TRUE(pdf.missing().empty());
}

TEST(Pdf, MissingCharactersAreReported) {
  Pdf pdf({100, 50, 0.2});
  pdf.text({5, 5}, "1\u2713\xFF", {});  // the font has no check mark, and the byte is invalid
  EXPECT_EQ(copied(pdf.finish()), U"1??");
  EXPECT_EQ(pdf.missing(), (std::set<char32_t>{0x2713, 0xFFFD}));
}

TEST(Pdf, OnlyUsedFontsAreEmbedded) {
  Pdf pdf({100, 50, 0.2});
  EXPECT_EQ(pdf.finish().find("/FontFile2"), std::string::npos);
  pdf.text({5, 5}, "x", {});
  const std::string one = pdf.finish();
  EXPECT_NE(one.find("/FontName /GAITLA+GaitlabSans "), std::string::npos);
  EXPECT_EQ(one.find("Bold"), std::string::npos);
  const std::size_t file = number_after(one, "/FontFile2 ");
  EXPECT_EQ(stream_of(one, one.find("\n" + std::to_string(file) + " 0 obj")), font_of(Face::regular).file());
  pdf.text({5, 5}, "x", {.bold = true});
  EXPECT_NE(pdf.finish().find("/FontName /GAITLB+GaitlabSans-Bold "), std::string::npos);
}

TEST(Pdf, TitleIsInUtf16) {
  EXPECT_EQ(Pdf({100, 50, 0.2}).finish().find("/Title"), std::string::npos);
  EXPECT_NE(Pdf({100, 50, 0.2}, "a\u2212\U0001F9BE").finish().find("/Title <FEFF00612212D83EDDBE>"), std::string::npos);
}

TEST(Pdf, AnchorsUseTheWidthOfTheText) {
  Pdf pdf({100, 50, 0.2});
  pdf.text({50, 20}, "WW", {.size = 10, .anchor = Anchor::end});
  pdf.text({50, 20}, "WW", {.size = 10, .anchor = Anchor::middle, .upwards = true});
  const std::string page = stream_of(pdf.finish());
  EXPECT_NE(page.find("1 0 0 -1 31.12 20 Tm"), std::string::npos) << page;   // moved by 2 * 9.44 to the left
  EXPECT_NE(page.find("0 -1 -1 0 50 29.44 Tm"), std::string::npos) << page;  // moved down by 9.44
}

// Adobe's metrics of Helvetica and Helvetica-Bold (Core14_AFMs), for the characters 0x20 to 0x7E, in thousandths.
// clang-format off
constexpr std::array<int, 95> kHelvetica{
    278, 278, 355, 556, 556, 889, 667, 191, 333, 333, 389, 584, 278, 333, 278, 278,
    556, 556, 556, 556, 556, 556, 556, 556, 556, 556, 278, 278, 584, 584, 584, 556,
    1015, 667, 667, 722, 722, 667, 611, 778, 722, 278, 500, 667, 556, 833, 722, 778,
    667, 778, 722, 667, 611, 722, 667, 944, 667, 667, 611, 278, 278, 278, 469, 556,
    333, 556, 556, 500, 556, 556, 278, 556, 556, 222, 222, 500, 222, 833, 556, 556,
    556, 556, 333, 500, 278, 556, 500, 722, 500, 500, 500, 334, 260, 334, 584};
constexpr std::array<int, 95> kHelveticaBold{
    278, 333, 474, 556, 556, 889, 722, 238, 333, 333, 389, 584, 278, 333, 278, 278,
    556, 556, 556, 556, 556, 556, 556, 556, 556, 556, 333, 333, 584, 584, 584, 611,
    975, 722, 722, 722, 722, 667, 611, 778, 722, 278, 556, 722, 611, 833, 722, 778,
    667, 778, 722, 667, 611, 722, 667, 944, 667, 667, 611, 333, 278, 333, 584, 556,
    333, 556, 611, 556, 611, 556, 333, 611, 611, 278, 278, 556, 278, 889, 611, 611,
    611, 611, 389, 556, 333, 611, 556, 778, 556, 556, 500, 389, 280, 389, 584};
// clang-format on

/// An SVG for print names Helvetica first, so that the layout must fit Helvetica.
TEST(Font, HasTheWidthsOfHelvetica) {
  for (std::size_t k = 0; k < kHelvetica.size(); ++k) {
    const std::string text(1, static_cast<char>(0x20 + k));
    EXPECT_EQ(std::lround(print_width(text, 1000)), kHelvetica[k]) << text;
    EXPECT_EQ(std::lround(print_width(text, 1000, true)), kHelveticaBold[k]) << text;
  }
  EXPECT_EQ(std::lround(print_width("\u00C6", 1000)), 1000);
  EXPECT_EQ(std::lround(print_width("\u2014", 1000)), 1000);
  EXPECT_EQ(std::lround(print_width("\u2212", 1000)), 584);  // as wide as the plus sign
}

TEST(Font, HasGreekSuperscriptsAndSigns) {
  for (const Face face : {Face::regular, Face::bold}) {
    const SetText set = set_text(
        "\u0391\u03A9\u03B1\u03C9\u00B5\u00B0\u2070\u00B9\u00B2\u00B3\u2074\u2079\u207B\u2080\u2089\u208B\u2190\u2192\u2202"
        "\u2206\u2211\u221A\u221E\u222B\u2248\u2260\u2264\u2265\u00D7\u00F7\u2009\u202F\u0141\u017E",
        face);
    EXPECT_TRUE(set.missing.empty());
    EXPECT_GT(font_of(face).ascent(), font_of(face).capital());
    EXPECT_LT(font_of(face).descent(), 0);
  }
}

}  // namespace
}  // namespace gaitlab::report
