#include "report/plot/pdf.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <cmath>
#include <limits>

#include "report/plot/helvetica.h"

namespace gaitlab::report {
namespace {

/// Number that follows `key` in a text.
std::size_t number_after(const std::string& text, const std::string& key, std::size_t from = 0) {
  const std::size_t at = text.find(key, from);
  return at == std::string::npos ? 0 : std::stoul(text.substr(at + key.size()));
}

std::string stream_of(const std::string& file) {
  const std::size_t start = file.find("stream\n") + 7;
  const std::string packed = file.substr(start, number_after(file, "/Length "));
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

TEST(Pdf, TextIsEscaped) {
  Pdf pdf({100, 50, 0.2});
  pdf.text({5, 5}, "a(b)\\c \xC3\xA9", {});
  EXPECT_NE(stream_of(pdf.finish()).find("/F1 13 Tf (a\\(b\\)\\\\c \\351) Tj"), std::string::npos);
  EXPECT_TRUE(pdf.missing().empty());
}

TEST(Pdf, GreekAndMinusAreInSymbolAndWhatIsMissingIsTold) {
  Pdf pdf({100, 50, 0.2});
  pdf.text({5, 5},
           "\xE2\x88\x92"
           "2 \xCF\x84\xE2\x9C\x93",
           {});  // contains a minus, a tau and a check mark
  EXPECT_NE(stream_of(pdf.finish()).find("/F3 13 Tf (-) Tj /F1 13 Tf (2 ) Tj /F3 13 Tf (t) Tj /F1 13 Tf (?) Tj"),
            std::string::npos);
  EXPECT_EQ(pdf.missing(), (std::set<char32_t>{0x2713}));
}

TEST(Pdf, AnchorsUseTheWidthOfTheText) {
  Pdf pdf({100, 50, 0.2});
  pdf.text({50, 20}, "WW", {.size = 10, .anchor = Anchor::end});
  pdf.text({50, 20}, "WW", {.size = 10, .anchor = Anchor::middle, .upwards = true});
  const std::string page = stream_of(pdf.finish());
  EXPECT_NE(page.find("1 0 0 -1 31.12 20 Tm"), std::string::npos) << page;   // moved by 2 * 9.44 to the left
  EXPECT_NE(page.find("0 -1 -1 0 50 29.44 Tm"), std::string::npos) << page;  // moved down by 9.44
}

/// Widths of characters equal the metrics of Adobe (Core14_AFMs: Helvetica.afm, Helvetica-Bold.afm, Symbol.afm).
TEST(Helvetica, HasItsPublishedWidths) {
  const auto width = [](const char* text, bool bold = false) { return std::lround(helvetica_width(text, 1000, bold)); };
  EXPECT_EQ(width(" "), 278);
  EXPECT_EQ(width("A"), 667);
  EXPECT_EQ(width("m"), 833);
  EXPECT_EQ(width("W"), 944);
  EXPECT_EQ(width("@"), 1015);
  EXPECT_EQ(width("0123456789"), 5560);
  EXPECT_EQ(width("\xC3\x86"), 1000);      // AE
  EXPECT_EQ(width("\xE2\x80\x94"), 1000);  // em dash
  EXPECT_EQ(width("@", true), 975);
  EXPECT_EQ(width("\xCE\xA9"), 768);      // Omega of the font Symbol
  EXPECT_EQ(width("\xE2\x88\x92"), 549);  // minus
}

}  // namespace
}  // namespace gaitlab::report
