// Tests of the margins, size and title of figures for papers.
#include <regex>

#include "report/plot/font.h"
#include "tests/labels.h"
#include "tests/program/fixture.h"

namespace gaitlab::test {
namespace {

const Label kLongFigureMargins("FigureMargins.AreKeptAtAnyWidth", "long");

/// Journals require columns of 84 or 85 mm. All texts keep a margin of 1 mm (4.6 px) at both edges; their widths are those of
/// the font.
TEST(FigureMargins, AreKeptAtAnyWidth) {
  const Folder folder;
  ASSERT_EQ(gaitlab("run '" + kScenarios + "hexapod.yaml' --set duration=2 --quiet --no-report --out legs", folder / "").code,
            0);
  folder.write("f.yaml",
               "runs: {hexapod: legs}\nsize: 84\n"
               "panels: [{kind: views, times: [1, 1.5], legend: false}, {kind: footfalls}, {kind: heat}]\n");
  const Result result = gaitlab("figure f.yaml -o f.svg", folder / "");
  ASSERT_EQ(result.code, 0) << result.err;
  const std::string svg = read(folder / "f.svg");
  EXPECT_TRUE(contains(svg, " width=\"84mm\" "));
  EXPECT_TRUE(contains(svg, "<title>views of hexapod; footfalls of hexapod; heat of hexapod</title>"));
  const double width = std::stod(svg.substr(svg.find("viewBox=\"0 0 ") + 13));
  static const std::regex kLine("<text x=\"([0-9.]+)\" y=\"[0-9.]+\" font-size=\"([0-9.]+)\"([^>]*)>([^<]*)</text>");
  std::size_t texts = 0;
  for (std::sregex_iterator it(svg.begin(), svg.end(), kLine), end; it != end; ++it, ++texts) {
    const std::string style = (*it)[3];
    const std::string text = (*it)[4];
    const bool upwards = contains(style, "rotate");
    const double wide = upwards ? 0 : report::print_width(text, std::stod((*it)[2]), contains(style, "bold"));
    const double share = contains(style, "\"middle\"") ? 0.5 : contains(style, "\"end\"") ? 1 : 0;
    const double left = std::stod((*it)[1]) - share * wide;
    EXPECT_GE(left, 4.6) << text;
    EXPECT_LE(left + wide, width - 4.6) << text;
  }
  EXPECT_GT(texts, 50U);
}

}  // namespace
}  // namespace gaitlab::test
