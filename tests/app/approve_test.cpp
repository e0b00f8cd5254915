// Tests of `gaitlab approve`: displayed changes, preserved bands, refused runs.
#include "tests/app/golden_command.h"
#include "tests/labels.h"

namespace gaitlab::test {

using namespace golden;
namespace {

const Label kLongApprove(
    "ApproveCommand.AQuantisedScenarioHasAGoldenOfMeans:ApproveCommand.WhatARefusalAdvisesHelps:ApproveCommand."
    "ApproveKeepsTheBandsOfTheSameGaitAlone",
    "long");

namespace fs = std::filesystem;

class ApproveCommand : public GoldenCommand {};

TEST_F(ApproveCommand, ApproveShowsTheChangeAndWantsAReason) {
  const std::string before = bytes("good.golden");
  const std::string wanted =
      "; expected a sentence for the golden's history: why these numbers are right. Nothing was written\n";
  Result result = call("approve good.yaml");
  EXPECT_EQ(result.code, 2);
  EXPECT_EQ(result.out, "since approval 1 (first golden):\n  nothing has changed\n");
  EXPECT_EQ(result.err, "--reason: error: is missing" + wanted);
  folder.write("good.yaml", kCaterpillar + "actuator: {Kt: 0.0039895}\n");
  result = call("approve good.yaml --reason ' '");
  EXPECT_EQ(result.code, 2);
  expect_contains(result.out, "\n  actuator.Kt: 0.00395 -> 0.0039895\n  column ");
  expect_contains(result.out, "\n  m1/passive torque ");
  EXPECT_EQ(result.err, "--reason: error: is empty" + wanted);
  result = call("approve good.yaml --reason --quiet");
  EXPECT_EQ(result.code, 2);
  EXPECT_EQ(result.err, "--reason: error: is '--quiet', which is an option" + wanted);
  EXPECT_EQ(bytes("good.golden"), before);
  folder.write("new.yaml", kCaterpillar);
  expect_refused("approve new.yaml", "--reason: error: is missing" + wanted.substr(0, wanted.size() - 1));
}

TEST_F(ApproveCommand, ApproveKeepsTheBandsOfTheSameGaitAlone) {
  const Golden before = read_golden(folder / "good.golden");
  Result result = call("approve good.yaml --reason 'nothing new'");
  EXPECT_EQ(result.code, 0);
  EXPECT_TRUE(result.out.starts_with("since approval 1 (first golden):\n  nothing has changed\ngood.golden: approval 2: "));
  expect_contains(result.out, "; bands kept\n");
  Golden after = read_golden(folder / "good.golden");
  for (std::size_t i = 0; i < before.bands.size(); ++i) EXPECT_EQ(after.bands[i].width(), before.bands[i].width());

  const std::string other_motor = kCaterpillar + "actuator: {Kt: 0.0039895}\n";
  folder.write("good.yaml", other_motor);
  result = call("approve good.yaml --reason 'the motor that we bought'");
  EXPECT_EQ(result.code, 0);
  EXPECT_TRUE(result.out.starts_with("since approval 2 (nothing new):\n  actuator.Kt: 0.00395 -> 0.0039895\n")) << result.out;
  expect_contains(result.out, "; bands made\n");
  after = read_golden(folder / "good.golden");
  ASSERT_EQ(after.history.size(), 3U);
  EXPECT_EQ(after.history[2].reason, "the motor that we bought");
  EXPECT_EQ(after.history[2].number, 3);
  EXPECT_NE(after.bands[1].width(), before.bands[1].width());
  EXPECT_EQ(call("test good.yaml").code, 0);
  folder.write("good.yaml", finer(other_motor));
  EXPECT_EQ(call("test good.yaml").code, 0);  // an unchanged scenario is within its bands

  std::string smaller = kCaterpillar;
  smaller.replace(smaller.find("0.6,"), 4, "0.3,");
  folder.write("good.yaml", smaller);
  result = call("approve good.yaml --reason 'small waves'");
  EXPECT_EQ(result.code, 0) << result.err;
  expect_contains(result.out, "\n  band of ");

  folder.write("good.yaml", kCaterpillar + "trace: {period: 0.025}\n");
  result = call("approve good.yaml --reason 'fewer rows'");
  EXPECT_EQ(result.code, 0);
  expect_contains(result.out, "\n  a row every 0.025 s, in the golden every 0.02 s\n");
  expect_contains(result.out, "; bands made\n");
}

TEST_F(ApproveCommand, ApproveReplacesAGoldenThatCannotBeReadWhereTold) {
  folder.write("good.golden/golden.json", "{}");
  expect_refused("approve good.yaml --reason 'made anew'",
                 "good.golden/golden.json: error: is not a golden of gaitlab; the golden is unchanged. gaitlab approve "
                 "--replace makes a new golden with a new history");
  EXPECT_EQ(read(folder / "good.golden/golden.json"), "{}");
  EXPECT_EQ(call("approve good.yaml --reason 'made anew' --replace").code, 0);
  EXPECT_EQ(read_golden(folder / "good.golden").history.size(), 1U);
}

TEST_F(ApproveCommand, ApproveLooksAtItsTargetFirst) {
  folder.write("new.yaml", kCaterpillar);
  folder.write("new.golden", "a file");
  expect_refused("approve new.yaml --reason 'mine'",
                 "new.golden: error: is a file, but a golden is a folder; move this file away");
  fs::remove(folder / "good.golden/golden.json");
  expect_refused("approve good.yaml --reason 'made anew'",
                 "good.golden/golden.json: error: is missing: the golden is incomplete; the golden is unchanged. gaitlab "
                 "approve --replace makes a new golden with a new history");
  fs::create_symlink("loop.yaml", folder / "loop.yaml");
  expect_refused("test loop.yaml", "loop.yaml: error: cannot be read: Too many levels of symbolic links");
  const Result folder_with_it = call("test .");  // all other scenarios are still tested
  EXPECT_EQ(folder_with_it.code, 2);
  expect_contains(folder_with_it.err, "./loop.yaml: error: cannot be read: Too many levels of symbolic links\n");
  expect_contains(folder_with_it.out, "0 passed, 0 failed, ");
}

// The cost of transport of a robot that hardly moves is meaningless. A distance that changes from below to above the limit for
// the cost of transport is therefore not a regression.
TEST_F(ApproveCommand, AStepAcrossTheLimitOfTransportIsNone) {
  const std::string text =
      "gaitlab: 1\nrobot: {modules: mtran, docks: [[1, 1, 4, 0, 0]]}\ncontact: {on: all}\n"
      "cpg: {type: phase_oscillator, frequency: 1, amplitude: 0.40458984374999996, phase_lag: 1.2}\n"
      "duration: 0.1\nphysics: {step: 2.5e-5}\n";  // the distance is 1.0001 mm, and 0.99995 mm with half of the step
  folder.write("edge.yaml", text);
  ASSERT_EQ(call("approve edge.yaml --reason 'on the edge'").code, 0);
  const std::string once = bytes("edge.golden");
  for (const Band& band : read_golden(folder / "edge.golden").number_bands) EXPECT_LT(band.width(), 1);
  fs::remove_all(folder / "edge.golden");
  ASSERT_EQ(call("approve edge.yaml --reason 'on the edge' -j 2").code, 0);
  EXPECT_EQ(bytes("edge.golden"), once);
  folder.write("edge.yaml", finer(text));
  EXPECT_EQ(call("test edge.yaml").code, 0);
}

TEST_F(ApproveCommand, ApproveRefusesBandsThatWouldNoticeNothing) {
  folder.write("chaos.yaml", kCaterpillar + "controller: {Kp: 400}\n");  // the sampled control loop is unstable
  const Result result = call("approve chaos.yaml --reason 'why not'");
  EXPECT_EQ(result.code, 2);
  EXPECT_TRUE(result.err.starts_with("chaos.yaml: error: the band of m")) << result.err;
  expect_contains(result.err, " % of its range, more than 0.2 %: max(ensemble ");
  expect_contains(result.err, "Nothing was written\n");
  EXPECT_FALSE(fs::exists(folder / "chaos.golden"));

  const std::string before = bytes("good.golden");  // the bands of an existing golden do not permit approval
  folder.write("good.yaml", kCaterpillar + "controller: {Kp: 400}\n");
  EXPECT_EQ(call("approve good.yaml --reason 'why not'").code, 2);
  EXPECT_EQ(bytes("good.golden"), before);
}

/// Value after `key: ` in a message, up to the next space.
std::string advised(const std::string& message, const std::string& key) {
  const std::size_t at = message.find(key + ": ");
  if (at == std::string::npos) return "";
  const std::size_t from = at + key.size() + 2;
  return message.substr(from, message.find(' ', from) - from);
}

// The advice in the message of a refused approval leads to an approved golden in one step.
TEST_F(ApproveCommand, WhatARefusalAdvisesHelps) {
  const auto approve_with = [&](const std::string& physics) {
    folder.write("long.yaml", kGait + "physics: {engine: articulated, " + physics + "}\n");
    return call("approve long.yaml --reason 'as advised'");
  };
  const auto expect_helps = [&](const std::string& physics) {
    const Result result = approve_with(physics);
    EXPECT_EQ(result.code, 0) << physics << "\n" << result.err;
    fs::remove_all(folder / "long.golden");
  };
  Result result = approve_with("step: 0.0005");
  EXPECT_EQ(result.code, 2);
  expect_contains(result.err, "; take physics.integrator: extrapolated with physics.step: ");
  expect_contains(result.err, "), or physics.step: ");
  expect_contains(result.err, ", so its order is ");
  expect_contains(result.err, "). Nothing was written\n");
  expect_helps("step: " + advised(result.err, "or physics.step"));
  expect_helps("integrator: extrapolated, step: " + advised(result.err, "extrapolated with physics.step"));

  result = approve_with("accuracy: 0.01");
  EXPECT_EQ(result.code, 2);
  expect_contains(result.err, "; take physics.accuracy: ");
  expect_helps("accuracy: " + advised(result.err, "take physics.accuracy"));
}

// The golden of a scenario whose encoders have a resolution holds means over 16 starts. A run with the same bits passes, for
// any number of threads. A motor constant that is 2 % larger exceeds the bands.
TEST_F(ApproveCommand, AQuantisedScenarioHasAGoldenOfMeans) {
  const auto write = [&](const std::string& more) {
    folder.write("steps.yaml",
                 "gaitlab: 1\nname: steps\nrobot: {modules: mtran, docks: [[1, 1, 4, 0, 0]]}\ncontact: {on: all}\n"
                 "physics: {engine: articulated}\nduration: 1.5\n"
                 "cpg: {type: phase_oscillator, frequency: 1, amplitude: 0.6, phase_lag: 1.2}\n"
                 "sensors: {encoder: {type: encoder, resolution: 0.00511}}\n" +
                     more);
  };
  write("");
  const Result approved_means = call("approve steps.yaml --reason 'ten bits' -j 2");
  ASSERT_EQ(approved_means.code, 0) << approved_means.err;
  expect_contains(approved_means.out, "numbers are means over 16 starts that differ by up to 1e-3 rad; no column is compared");
  const Golden golden = read_golden(folder / "steps.golden");
  EXPECT_EQ(golden.starts, 16);
  EXPECT_EQ(golden.run.trace.columns.size(), 1U);
  for (const char* jobs : {"1", "3"}) {
    const Result same = call(std::string("test steps.yaml -j ") + jobs);
    EXPECT_EQ(same.code, 0) << same.out;
    expect_contains(same.out, "distance                0  passed");
  }
  write("actuator: {Kt: 0.00403}\n");
  const Result stronger = call("test steps.yaml -j 2");
  EXPECT_EQ(stronger.code, 4) << stronger.out;
  expect_contains(stronger.out, "actuator.Kt: 0.00395 -> 0.00403");
  write("");
  folder.write("steps.yaml", read(folder / "steps.yaml").substr(0, read(folder / "steps.yaml").find("sensors:")));
  const Result exact = call("test steps.yaml");
  EXPECT_EQ(exact.code, 4);
  expect_contains(exact.out, "no sensor has a resolution, so that this is one run, but the golden has means over starts");
}

TEST_F(ApproveCommand, AnyNumberOfThreadsWritesTheSameBytes) {
  const std::string before = bytes("good.golden");
  for (const char* jobs : {"1", "2", "7"}) {
    fs::remove_all(folder / "good.golden");
    ASSERT_EQ(call(std::string("approve good.yaml --reason 'first golden' -j ") + jobs).code, 0);
    EXPECT_EQ(bytes("good.golden"), before) << jobs;
  }
  fs::copy(folder / "good.golden", folder / "other.golden");
  folder.write("other.yaml", kCaterpillar + "controller: {Kp: 102}\nname: good\n");
  const Result one = call("test . --out a");
  const Result two = call("test . --out b -j 2");
  EXPECT_EQ(one.code, 4);
  EXPECT_EQ(two.code, 4);
  EXPECT_EQ(one.out.substr(0, one.out.find("page: ")), two.out.substr(0, two.out.find("page: ")));
  EXPECT_EQ(read(folder / "a/good.svg"), read(folder / "b/good.svg"));
  EXPECT_NE(read(folder / "a/good.svg"), "");
}

}  // namespace
}  // namespace gaitlab::test
