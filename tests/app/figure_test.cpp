// Tests of `gaitlab figure`: refused recipes, reproducible bytes, and correct positions of the numbers of the trace.
#include <zlib.h>

#include <cmath>
#include <regex>

#include "core/recording/csv.h"
#include "core/recording/run_files.h"
#include "report/figures/paper/recipe.h"
#include "tests/program/cart.h"

namespace gaitlab::test {
namespace {

namespace fs = std::filesystem;

class PaperFigure : public ::testing::Test {
 protected:
  void SetUp() override {
    fs::create_directory_symlink(kScenarios + "modules", folder / "modules");
    folder.write(
        "creep.yaml",
        "gaitlab: 1\nrobot: {modules: mtran, docks: [[1, 1, 4, 0, 0]]}\ncontact: {on: all}\nduration: 0.5\n"
        "physics: {engine: articulated}\ncpg: {type: phase_oscillator, frequency: 1, amplitude: 0.4, phase_lag: 1.2}\n");
    ASSERT_EQ(gaitlab("run creep.yaml --quiet --out run", folder / "").code, 0);
  }
  Result draw(const std::string& recipe, const std::string& options) {
    folder.write("figure.yaml", recipe);
    return gaitlab("figure figure.yaml " + options, folder / "");
  }
  /// Expects that the recipe is refused with exactly this message, and that no file is written.
  void refused(const std::string& recipe, const std::string& message) {
    const Result result = draw(recipe, "-o f.svg");
    EXPECT_EQ(result.code, 2);
    EXPECT_EQ(result.err, message + "\n");
    EXPECT_EQ(result.out, "");
    EXPECT_FALSE(fs::exists(folder / "f.svg"));
    EXPECT_FALSE(fs::exists(folder / "f.csv"));
  }
  Folder folder;
};

const std::string kRuns = "runs: {creep: run}\n";
const std::string kTwin = kRuns +
                          "panels:\n"
                          "  - from: 0.1\n"
                          "    left: {columns: [joint.1.angle]}\n"
                          "    right: {columns: [joint.m0/passive.torque]}\n";

TEST_F(PaperFigure, RecipesAreReadStrictly) {
  refused(kTwin + "sise: ieee-column\n", "figure.yaml:6:1: error: unknown key 'sise'; did you mean 'size'?");
  refused(kTwin + "size: ieee-colum\n",
          "figure.yaml:6:7: error: size is 'ieee-colum'; expected ieee-column, ieee-page, a width in mm or [width, height] in "
          "mm; did you mean "
          "'ieee-column'?");
  refused(kTwin + "size: [88.9, 5]\n", "figure.yaml:6:14: error: size[1], the height, is 5 mm; expected 20 to 500 mm");
  refused(kTwin + "size: 8\n", "figure.yaml:6:7: error: size, the width, is 8 mm; expected 20 to 500 mm");
  refused(kTwin + "size: [88.9, 20]\n", "figure.yaml:6:14: error: a height of 20 mm is too small: the panels need 26 mm");
  refused(kRuns + "panels: [{kind: curve, left: {columns: [com.x]}}]\n",
          "figure.yaml:2:17: error: kind 'curve' is unknown; did you mean 'curves'?");
  refused(kRuns + "panels: [{kind: heat, left: {columns: [com.x]}}]\n",
          "figure.yaml:2:23: error: unknown key 'left'; known keys: kind, title, run, joints, from, to, height");
  refused(kRuns + "panels: [{left: {columns: [joint.1.torqe]}}]\n",
          "figure.yaml:2:28: error: no column 'joint.1.torqe' in run 'creep'; did you mean 'joint.1.torque'?");
  refused(
      kRuns + "panels: [{left: {columns: [joint.m0/pasive.torque]}}]\n",
      "figure.yaml:2:28: error: no column 'joint.m0/pasive.torque' in run 'creep'; did you mean 'joint.m0/passive.torque'?");
  refused(
      kRuns + "panels: [{left: {columns: [joint.1.torque, joint.1.angle]}}]\n",
      "figure.yaml:2:27: error: joint.1.torque is in N m and joint.1.angle in rad, but an axis has only one unit; draw one of "
      "them on the other axis");
  refused(kRuns + "panels: [{kind: envelope, joints: [m0/activ]}]\n",
          "figure.yaml:2:36: error: no joint 'm0/activ'; did you mean 'm0/active'?");
  refused(kRuns + "panels: [{to: 2, left: {columns: [com.x]}}]\n",
          "figure.yaml:2:15: error: `to` is 2 s, beyond the end of the run at 0.5 s");
  refused(kRuns + "panels: [{kind: curves}]\n",
          "figure.yaml:2:10: error: no curve is drawn; expected `left: {columns: [...]}` or the same with `right`");
  refused(kRuns + "panels: [{kind: views}]\n", "figure.yaml:2:10: error: missing key 'times', a list of times in s");
  refused(kRuns + "panels: [{kind: heap}]\n", "figure.yaml:2:17: error: kind 'heap' is unknown; did you mean 'heat'?");
  refused(kRuns + "panels: [{kind: views, times: [0.1, 3]}]\n",
          "figure.yaml:2:37: error: 3 s is beyond the end of the run at 0.5 s");
  refused("runs: {a: run, b: run}\npanels: [{kind: heat}]\n",
          "figure.yaml:2:10: error: missing key 'run': there are several, a, b");
  refused("runs: {a: run}\npanels: [{kind: heat, run: b}]\n",
          "figure.yaml:2:28: error: run 'b' is not one of `runs`; did you mean 'a'?");
  refused(kRuns + "panels: [{motor: m0/activ, left: {columns: [com.x]}}]\n",
          "figure.yaml:2:18: error: no joint 'm0/activ'; did you mean 'm0/active'?");
  refused("runs: {a: run, b: run}\npanels: [{motor: m0/active, left: {columns: [com.x]}}]\n",
          "figure.yaml:2:18: error: `motor` needs a panel with one run; expected `runs: [NAME]`");
  refused("runs: {creep: walk}\npanels: [{left: {columns: [com.x]}}]\n",
          "figure.yaml:1:15: error: run 'creep': walk does not exist; simulate it first, or name its folder with --run "
          "creep=FOLDER");
}

TEST_F(PaperFigure, AStretchThatTheRunDoesNotHold) {
  for (const std::string kind : {"curves, left: {columns: [com.x]}", "heat", "envelope"}) {
    const std::string column = std::to_string(23 + kind.size());
    const std::string panel = kRuns + "panels: [{kind: " + kind + ", ";
    refused(panel + "to: 2}]\n", "figure.yaml:2:" + column + ": error: `to` is 2 s, beyond the end of the run at 0.5 s");
    refused(panel + "from: 0.6}]\n", "figure.yaml:2:" + std::to_string(25 + kind.size()) +
                                         ": error: `from` is 0.6 s, not before the end of the run at 0.5 s");
  }
  refused(kRuns + "panels: [{kind: heat, from: 0.101, to: 0.102}]\n",
          "figure.yaml:2:29: error: the run has fewer than two rows from 0.101 s to 0.102 s; expected a longer interval");
  refused(kRuns + "panels: [{kind: heat, from: 0.2, to: 0.1}]\n",
          "figure.yaml:2:38: error: `to` is 0.1 s, which is not after `from`, 0.2 s");
}

TEST_F(PaperFigure, HingesWithoutAMotorAreLeftOut) {
  folder.write("cart.yaml", kCastorFirst);
  ASSERT_EQ(gaitlab("run cart.yaml --quiet --out cart", folder / "").code, 0);
  const std::string runs = "runs: {cart: cart}\n";
  for (const std::string kind : {"heat", "envelope"}) {
    const Result result = draw(runs + "panels: [{kind: " + kind + "}]\n", "-o " + kind + ".svg");
    EXPECT_EQ(result.code, 0) << result.err;
    const std::string numbers = read(folder / (kind + ".csv"));
    EXPECT_TRUE(contains(numbers, "m0/arm")) << kind;
    EXPECT_FALSE(contains(numbers, "m0/castor")) << kind;
    for (const std::string joint : {"m0/castor", "0"}) {
      refused(runs + "panels: [{kind: " + kind + ", joints: [" + joint + "]}]\n",
              fmt::format("figure.yaml:2:{}: error: joint m0/castor has no motor", 28 + kind.size()));
    }
  }
}

TEST_F(PaperFigure, TitlesMarksMotorsAndLogarithms) {
  const std::string panels =
      "panels:\n"
      "  - {title: the torque, motor: m0/passive, marks: [0.2, 3], left: {columns: [joint.1.torque], least: 70}}\n"
      "  - {left: {columns: [joint.1.speed], log: true, range: [0.001, 10]}}\n";
  ASSERT_EQ(draw(kRuns + "title: Creep\n" + panels, "-o drawn.svg").code, 0);
  const std::string svg = read(folder / "drawn.svg");
  for (const char* part :
       {"<title>Creep</title>", ">Creep</text>", ">the torque</text>", ">0.001</text>", ">10</text>", ">50</text>"})
    EXPECT_TRUE(contains(svg, part)) << part;
  const std::string mark = "stroke-dasharray=\"1 3\"";  // one, because 3 s is not within the panel
  EXPECT_TRUE(contains(svg, mark));
  EXPECT_EQ(svg.find(mark), svg.rfind(mark));
  refused(kRuns + "panels: [{left: {columns: [joint.1.speed], log: true, range: [0, 10]}}]\n",
          "figure.yaml:2:62: error: range begins at 0; expected numbers above 0 on a logarithmic axis");
  refused(kRuns + "panels: [{left: {columns: [joint.1.speed], log: true, least: 3}}]\n",
          "figure.yaml:2:62: error: `least` extends a linear axis; remove `least` or `log`");
}

TEST_F(PaperFigure, SameBytesTwice) {
  for (const std::string kind : {"svg", "pdf"}) {
    ASSERT_EQ(draw(kTwin, "-o a." + kind).code, 0);
    ASSERT_EQ(draw(kTwin, "-o b." + kind).code, 0);
    EXPECT_EQ(read(folder / ("a." + kind)), read(folder / ("b." + kind)));
  }
  EXPECT_EQ(read(folder / "a.csv"), read(folder / "b.csv"));
}

TEST_F(PaperFigure, AnotherRunCanBeNamed) {
  const std::string recipe = "runs: {creep: nowhere}\npanels: [{left: {columns: [com.x]}}]\n";
  EXPECT_EQ(draw(recipe, "-o f.svg --run creep=run").code, 0);
  EXPECT_EQ(draw(recipe, "-o f.svg --run crep=run").err,
            "--run crep=run: error: run 'crep' is not in the recipe; did you mean 'creep'?\n");
}

TEST_F(PaperFigure, TheNumbersAreThoseOfTheTrace) {
  ASSERT_EQ(draw(kTwin, "-o f.svg").code, 0);
  const Trace drawn = read_csv(folder / "f.csv");
  const Trace trace = read_trace(folder / "run").trace;
  ASSERT_EQ(drawn.columns.size(), 3U);
  EXPECT_EQ(drawn.columns[0].name, "t [s]");
  EXPECT_EQ(drawn.columns[1].name, "joint.1.angle [rad]");
  EXPECT_EQ(drawn.columns[2].name, "joint.1.torque [N m]");
  ASSERT_EQ(drawn.rows(), 81U);  // from 0.1 to 0.5 s in steps of 5 ms
  const std::size_t before = trace.rows() - drawn.rows();
  for (std::size_t row = 0; row < drawn.rows(); ++row) {
    EXPECT_EQ(drawn.at(row, 0), trace.at(row + before, 0));
    EXPECT_EQ(drawn.at(row, 1), trace.at(row + before, trace.find("joint.1.angle")));
    EXPECT_EQ(drawn.at(row, 2), trace.at(row + before, trace.find("joint.1.torque")));
  }
}

struct At {
  double x, y;
};

/// Points from the pairs of numbers in a text.
std::vector<At> points(const std::string& text) {
  static const std::regex kNumber("-?[0-9.]+");
  std::vector<double> numbers;
  for (std::sregex_iterator it(text.begin(), text.end(), kNumber), end; it != end; ++it)
    numbers.push_back(std::stod(it->str()));
  std::vector<At> all;
  for (std::size_t i = 0; i + 1 < numbers.size(); i += 2) all.push_back({numbers[i], numbers[i + 1]});
  return all;
}

double attribute(const std::string& svg, const std::string& name) {
  return std::stod(svg.substr(svg.find(" " + name + "=\"") + name.size() + 3));
}

/// Linear map from values to coordinates, determined by two labels of an axis and their positions.
struct Axis {
  double value, at, per;
  double operator()(double v) const { return at + per * (v - value); }
};

/// Axis from labels, which are pairs of value and coordinate.
Axis axis_from(const std::vector<std::pair<double, double>>& labels) {
  const auto [v0, a0] = labels.front();
  const auto [v1, a1] = labels.back();
  return {v0, a0, (a1 - a0) / (v1 - v0)};
}

TEST_F(PaperFigure, SvgAndPdfHaveTheCurvesWhereTheirLabelsSay) {
  ASSERT_EQ(draw(kTwin, "-o f.svg").code, 0);
  ASSERT_EQ(draw(kTwin, "-o f.pdf").code, 0);
  const std::string svg = read(folder / "f.svg");
  // Labels of the x axis are below the frame. Labels of the y axis are at its left, 4.5 px below the height of their values.
  std::vector<std::pair<double, double>> below;
  std::vector<std::pair<double, double>> left;
  static const std::regex kText("<text x=\"([0-9.]+)\" y=\"([0-9.]+)\" [^>]*text-anchor=\"(middle|end)\"[^>]*>([^<]*)</text>");
  for (std::sregex_iterator it(svg.begin(), svg.end(), kText), end; it != end; ++it) {
    std::string text = (*it)[4];
    if (text.starts_with("\xE2\x88\x92")) text.replace(0, 3, "-");
    char* rest = nullptr;
    const double value = std::strtod(text.c_str(), &rest);
    if (rest != text.c_str() + text.size()) continue;
    if ((*it)[3] == "middle") below.emplace_back(value, std::stod((*it)[1]));
    if ((*it)[3] == "end") left.emplace_back(value, std::stod((*it)[2]) - 4.5);
  }
  ASSERT_GE(below.size(), 3U);
  ASSERT_GE(left.size(), 3U);
  const Axis x = axis_from(below);
  const Axis y = axis_from(left);
  const std::size_t curve = svg.find("stroke=\"#0072B2\" stroke-width=\"1.6\" stroke-linejoin");
  ASSERT_NE(curve, std::string::npos);
  const std::size_t start = svg.rfind(" d=\"", curve);
  const std::vector<At> drawn = points(svg.substr(start, svg.find('"', start + 4) - start));
  const Trace data = read_csv(folder / "f.csv");
  ASSERT_EQ(drawn.size(), data.rows());  // fewer than two rows per 0.25 px, so that all rows are drawn
  for (std::size_t row = 0; row < data.rows(); ++row) {
    // Coordinates and positions of labels have two decimals. The tolerance is for three rounding errors of 0.005; those of the
    // labels are extrapolated over the axis.
    EXPECT_NEAR(drawn[row].x, x(data.at(row, 0)), 0.03);
    EXPECT_NEAR(drawn[row].y, y(data.at(row, 1)), 0.03);
  }
  // The PDF contains the same path, transformed by its matrix, so that both agree on paper.
  const std::string pdf = read(folder / "f.pdf");
  const std::size_t stream = pdf.find("stream\n") + 7;
  const std::string packed = pdf.substr(stream, std::stoul(pdf.substr(pdf.find("/Length ") + 8)));
  std::string page(1 << 20, '\0');
  uLongf size = page.size();
  ASSERT_EQ(
      uncompress(reinterpret_cast<Bytef*>(page.data()), &size, reinterpret_cast<const Bytef*>(packed.data()), packed.size()),
      Z_OK);
  page.resize(size);
  const double scale = std::stod(page);
  const std::size_t blue = page.find("0 0.447 0.698 RG 1.6 w 1 j ");
  ASSERT_NE(blue, std::string::npos);
  const std::vector<At> in_pdf = points(page.substr(blue + 27, page.find("S Q", blue) - blue - 27));
  ASSERT_EQ(in_pdf.size(), drawn.size());
  const double mm = attribute(svg, "width") / std::stod(svg.substr(svg.find("viewBox=\"0 0 ") + 13));
  const double height = attribute(svg, "height");
  const std::size_t box = pdf.find("/MediaBox [0 0 ");
  const double top = points(pdf.substr(box + 15, 30)).front().y;
  EXPECT_NEAR(attribute(svg, "width"), 88.9, 1e-9);
  EXPECT_NEAR(top * 25.4 / 72, height, 0.01);  // sizes have two decimals, in points and in mm
  for (std::size_t row = 0; row < drawn.size(); row += 7) {
    // Distances from the left and top edges of the paper, mm. The tolerance is for the two decimals of the viewBox.
    EXPECT_NEAR(in_pdf[row].x * scale * 25.4 / 72, drawn[row].x * mm, 2e-3);
    EXPECT_NEAR(in_pdf[row].y * scale * 25.4 / 72, drawn[row].y * mm, 2e-3);
  }
}

TEST_F(PaperFigure, TheEnvelopeIsThatOfEquations1And2) {
  ASSERT_EQ(draw(kRuns + "panels: [{kind: envelope, joints: [m0/*]}]\n", "-o f.svg").code, 0);
  const Trace data = read_csv(folder / "f.csv");
  const auto column = [&](const char* name) { return data.find(name); };
  ASSERT_LT(column("m0/active speed [rad/s]"), data.columns.size());
  // Default data of the actuator dc_motor.
  constexpr double kR = 4.3, kKt = 0.00395, kGear = 594, kEta = 0.7, kU = 7.4, kI = 1.2;
  std::size_t rows = 0;
  for (std::size_t row = 0; row < data.rows(); ++row) {
    const double w = data.at(row, column("envelope speed [rad/s]"));
    if (std::isnan(w)) continue;
    ++rows;
    const double most = kEta * kKt * kGear * std::clamp((kU - kKt * kGear * w) / kR, -kI, kI);
    const double least = kEta * kKt * kGear * std::clamp((-kU - kKt * kGear * w) / kR, -kI, kI);
    EXPECT_NEAR(data.at(row, column("envelope most [N m]")), most, 1e-12);  // rounding errors of numbers near 2
    EXPECT_NEAR(data.at(row, column("envelope least [N m]")), least, 1e-12);
  }
  ASSERT_GT(rows, 100U);
  // The envelope extends to 1.25 times the speed without load.
  EXPECT_NEAR(data.at(rows - 1, column("envelope speed [rad/s]")), 1.25 * kU / (kKt * kGear), 1e-12);
}

TEST_F(PaperFigure, TheHeatMapIsTheShareOfTheTorqueAtThatSpeed) {
  ASSERT_EQ(draw(kRuns + "panels: [{kind: heat, joints: ['1']}]\n", "-o f.svg").code, 0);
  const Trace data = read_csv(folder / "f.csv");
  const Trace trace = read_trace(folder / "run").trace;
  ASSERT_EQ(data.columns.size(), 2U);
  double largest = 0;
  for (std::size_t row = 0; row < trace.rows(); ++row) {
    const double w = trace.at(row, trace.find("joint.1.speed"));
    const double torque = trace.at(row, trace.find("joint.1.torque"));
    const double sign = torque < 0 ? -1 : 1;
    const double has = 0.7 * 0.00395 * 594 * std::min(1.2, (7.4 - sign * 0.00395 * 594 * w) / 4.3);
    largest = std::max(largest, std::abs(torque) / has);
  }
  double shown = 0;
  for (std::size_t row = 0; row < data.rows(); ++row) shown = std::max(shown, data.at(row, 1));
  EXPECT_NEAR(shown, largest, 1e-12);
}

TEST_F(PaperFigure, EveryKindIsDrawn) {
  const Result all = draw(kRuns +
                              "size: ieee-page\npanels:\n"
                              "  - left: {columns: [joint.*.angle], range: [-0.1, 0.1]}\n"
                              "  - {kind: envelope}\n  - {kind: heat}\n  - {kind: views, times: [0, 0.5], joint: m0/active}\n",
                          "-o f.pdf");
  EXPECT_EQ(all.code, 0) << all.err;
  EXPECT_EQ(all.err, "");
  for (const char* file : {"f.pdf", "f-a.csv", "f-b.csv", "f-c.csv", "f-d.csv"}) EXPECT_TRUE(fs::exists(folder / file)) << file;
  EXPECT_TRUE(contains(all.out, "f.pdf: 181.9 x ")) << all.out;
  refused(kRuns + "panels: [{kind: footfalls}]\n",
          "figure.yaml:2:17: error: footfalls need a robot with legs (docs/modules.md), and a run with rows");
}

/// Runs of CSV files have units, which follow from the names of the columns.
TEST_F(PaperFigure, RunsOfCsvHaveUnits) {
  ASSERT_EQ(gaitlab("run creep.yaml --quiet --no-report --format csv --out csv", folder / "").code, 0);
  std::string recipe = kTwin;
  ASSERT_EQ(draw(recipe, "-o h.svg").code, 0);
  const Result drawn = draw(recipe.replace(recipe.find(": run}"), 6, ": csv}"), "-o g.svg");
  EXPECT_EQ(drawn.code, 0) << drawn.err;
  EXPECT_TRUE(read(folder / "g.svg") == read(folder / "h.svg"));
  EXPECT_TRUE(read(folder / "g.csv") == read(folder / "h.csv"));
  EXPECT_TRUE(contains(read(folder / "g.svg"), "torque (N m)"));
  refused("runs: {creep: csv}\npanels: [{left: {columns: [joint.1.torque, joint.1.angle]}}]\n",
          "figure.yaml:2:27: error: joint.1.torque is in N m and joint.1.angle in rad, but an axis has only one unit; draw one "
          "of them on the other axis");
}

/// Missing loads of feet are an error, because a foot without a known load would be drawn as unloaded.
TEST_F(PaperFigure, LoadsThatAreNotThereAreAnError) {
  ASSERT_EQ(gaitlab("run " + kScenarios +
                        "hexapod.yaml --set physics.engine=articulated --set duration=0.05 --quiet --no-report --format csv "
                        "--out legs",
                    folder / "")
                .code,
            0);
  const std::string footfalls = "runs: {hexapod: legs}\npanels: [{kind: footfalls}]\n";
  ASSERT_EQ(draw(footfalls, "-o whole.svg").code, 0);
  fs::remove(folder / "legs/recording.h5");  // this file contains the loads
  refused(footfalls, "figure.yaml:2:17: error: run 'hexapod' lacks column load.9, which shows the stance of a leg");
  const Result stance = draw("runs: {hexapod: legs}\npanels: [{left: {columns: [com.x]}, stance: front left}]\n", "-o f.svg");
  EXPECT_EQ(stance.code, 2);
  EXPECT_TRUE(contains(stance.err, "run 'hexapod' lacks column load.")) << stance.err;
}

/// A view states the time of its row. The last row is at the end of the run, also if this is not a multiple of trace.period.
TEST_F(PaperFigure, ViewsNameTheTimeOfTheirRow) {
  ASSERT_EQ(gaitlab("run creep.yaml --set duration=0.503 --quiet --no-report --out odd", folder / "").code, 0);
  ASSERT_EQ(draw("runs: {creep: odd}\npanels: [{kind: views, times: [0.2, 0.503]}]\n", "-o f.svg").code, 0);
  const Trace data = read_csv(folder / "f.csv");
  ASSERT_EQ(data.rows(), 2U);
  EXPECT_NEAR(data.at(0, 0), 0.2, 1e-12);
  EXPECT_NEAR(data.at(1, 0), 0.503, 1e-12);
  EXPECT_TRUE(contains(read(folder / "f.svg"), "0.503 s"));
}

/// Curves that leave the range of an axis end at the frame.
TEST_F(PaperFigure, CurvesEndAtTheFrame) {
  ASSERT_EQ(draw(kRuns + "panels: [{left: {columns: [joint.1.angle], range: [-0.05, 0.05]}}]\n", "-o f.svg").code, 0);
  const std::string svg = read(folder / "f.svg");
  const std::size_t frame = svg.find("fill=\"none\" stroke=\"#333333\"");
  const std::size_t rect = svg.rfind("<rect", frame);
  const std::string box = svg.substr(rect, frame - rect);
  const double top = attribute(box, "y");
  const double bottom = top + attribute(box, "height");
  const std::size_t curve = svg.find("stroke=\"#0072B2\" stroke-width=\"1.6\" stroke-linejoin");
  const std::size_t start = svg.rfind(" d=\"", curve);
  std::size_t at_edge = 0;
  for (const At& p : points(svg.substr(start, curve - start))) {
    EXPECT_GE(p.y, top - 0.01);
    EXPECT_LE(p.y, bottom + 0.01);
    at_edge += std::abs(p.y - top) < 0.02 || std::abs(p.y - bottom) < 0.02 ? 1 : 0;
  }
  EXPECT_GT(at_edge, 0U);
}

TEST(Recipe, TheShippedOnesAreRight) {
  std::size_t recipes = 0;
  for (const auto& entry : fs::directory_iterator(kScenarios + "figures")) {
    EXPECT_NO_THROW(report::read_recipe(entry.path().string())) << entry.path();
    ++recipes;
  }
  EXPECT_EQ(recipes, 7U);
}

}  // namespace
}  // namespace gaitlab::test
