// Tests of the files of `gaitlab figure`: a figure that is named is replaced; files with other content never are.
#include "tests/program/fixture.h"

namespace gaitlab::test {
namespace {

namespace fs = std::filesystem;

class FigureFiles : public ::testing::Test {
 protected:
  void SetUp() override {
    fs::create_directory_symlink(kScenarios + "modules", folder / "modules");
    folder.write("one.yaml",
                 "gaitlab: 1\nrobot: {modules: mtran, base: fixed}\nground: {type: none}\ncontact: {on: none}\nduration: 0.1\n"
                 "physics: {engine: articulated}\ncpg: {type: phase_oscillator, frequency: 1, amplitude: 0.4}\n");
    run("run");
    folder.write("figure.yaml", "runs: {one: run}\npanels: [{left: {columns: [joint.m0/active.torque]}}]\n");
    folder.write("two.yaml",
                 "runs: {one: run}\npanels: [{left: {columns: [joint.m0/active.torque]}}, {left: {columns: "
                 "[joint.m0/active.angle]}}]\n");
    folder.write("mine.csv", kMine);
  }
  void run(const std::string& arguments) {
    ASSERT_EQ(gaitlab("run one.yaml --quiet --no-report --out " + arguments, folder / "").code, 0);
  }
  Result figure(const std::string& arguments) { return gaitlab("figure " + arguments, folder / ""); }
  /// Expects that the numbers do not replace this file, and that nothing is written.
  void refused(const std::string& arguments, const std::string& file) {
    const Result result = figure(arguments);
    EXPECT_EQ(result.code, 2);
    EXPECT_EQ(result.err, file +
                              ": error: has other columns than this figure, and is not replaced; move it away, or name another "
                              "file with --csv FILE.csv. Nothing was written\n");
    EXPECT_EQ(read(folder / file), kMine);
  }
  const std::string kMine = "t,x\n0,1\n";
  Folder folder;
};

TEST_F(FigureFiles, AFigureIsReplacedOnlyWhereItIsNamed) {
  const Result first = figure("figure.yaml");
  EXPECT_EQ(first.code, 0) << first.err;
  EXPECT_TRUE(contains(first.out, "figure.svg: 88.9 x ")) << first.out;
  EXPECT_EQ(figure("figure.yaml").err, "figure.svg: error: exists; name it with -o to replace it. Nothing was written\n");
  EXPECT_EQ(figure("figure.yaml -o figure.svg").code, 0);
  EXPECT_EQ(figure("figure.yaml -o figure.pdf").code, 0);  // writes the same numbers to figure.csv
  EXPECT_EQ(figure("figure.yaml -o f.png").err, "-o f.png: error: expected a file named .svg or .pdf\n");
}

TEST_F(FigureFiles, NumbersOfAnEarlierRunAreReplaced) {
  ASSERT_EQ(figure("figure.yaml -o f.svg").code, 0);
  const std::string before = read(folder / "f.csv");
  run("other --set cpg.amplitude=0.5");
  EXPECT_EQ(figure("figure.yaml -o f.svg --run one=other").code, 0);
  EXPECT_NE(read(folder / "f.csv"), before);
}

TEST_F(FigureFiles, NumbersOfOthersStay) {
  refused("figure.yaml -o mine.pdf", "mine.csv");
  EXPECT_FALSE(fs::exists(folder / "mine.pdf"));
  folder.write("mine.svg", "a drawing of mine");
  refused("figure.yaml -o mine.svg", "mine.csv");
  EXPECT_EQ(read(folder / "mine.svg"), "a drawing of mine");
  folder.write("two-b.csv", kMine);
  refused("two.yaml", "two-b.csv");
  EXPECT_FALSE(fs::exists(folder / "two-a.csv"));
  EXPECT_FALSE(fs::exists(folder / "two.svg"));
  folder.write("two-b.csv", "");
  EXPECT_EQ(figure("two.yaml").code, 2);
}

TEST_F(FigureFiles, NumbersGoToTheNamedFile) {
  EXPECT_EQ(figure("figure.yaml -o mine.pdf --csv numbers.csv").code, 0);
  EXPECT_EQ(read(folder / "mine.csv"), kMine);
  EXPECT_TRUE(fs::exists(folder / "numbers.csv"));
  EXPECT_EQ(figure("two.yaml --csv numbers.csv").code, 0);
  EXPECT_TRUE(fs::exists(folder / "numbers-a.csv") && fs::exists(folder / "numbers-b.csv"));
  EXPECT_FALSE(fs::exists(folder / "two-a.csv"));
  refused("figure.yaml -o f.svg --csv mine.csv", "mine.csv");
  EXPECT_EQ(figure("figure.yaml -o f.svg --csv numbers.txt").err, "--csv numbers.txt: error: expected a file named .csv\n");
  EXPECT_EQ(figure("figure.yaml -o f.svg --csv no/numbers.csv").err,
            "no/numbers.csv: error: cannot be written: its folder does not exist\n");
  EXPECT_FALSE(fs::exists(folder / "f.svg"));
}

TEST(Recipe, HasAManual) {
  const Result curves = gaitlab("explain figure curves", ".");
  EXPECT_EQ(curves.code, 0) << curves.err;
  for (const char* key : {"panels[].left.columns", "panels[].stance", "size (mm)", "runs"})
    EXPECT_TRUE(contains(curves.out, key)) << key;
  EXPECT_TRUE(contains(gaitlab("explain figure views", ".").out, "panels[].times"));
}

}  // namespace
}  // namespace gaitlab::test
