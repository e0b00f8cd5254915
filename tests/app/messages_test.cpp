// Tests of the messages for mistakes of new users.
#include "app/gait/run_time.h"
#include "tests/folders.h"
#include "tests/program/fixture.h"

namespace gaitlab::test {
namespace {

class Messages : public ::testing::Test {
 protected:
  Messages() {
    std::filesystem::create_directory_symlink(kScenarios + "modules", folder_ / "modules");
    folder_.write("ok.yaml", "gaitlab: 1\nrobot: {modules: mtran, docks: [[1, 1, 4, 0, 0]]}\nduration: 0.1\n");
  }
  Result call(const std::string& arguments) { return gaitlab(arguments, folder_.path()); }
  /// Expects that the command is refused with exactly this message.
  void refused(const std::string& arguments, const std::string& message) {
    const Result result = call(arguments);
    EXPECT_EQ(result.code, 2) << arguments;
    EXPECT_EQ(result.err, message + "\n") << arguments;
    EXPECT_EQ(result.out, "") << arguments;
  }
  /// Expects that `check` of a scenario with this text is refused with exactly this message.
  void refused_text(const std::string& text, const std::string& message) {
    folder_.write("s.yaml", text);
    refused("check s.yaml", message);
  }

  Folder folder_;
};

TEST_F(Messages, ACommandOrOptionThatDoesNotExist) {
  refused("rnu ok.yaml", "gaitlab: error: unknown command 'rnu'; did you mean 'run'?");
  refused("run ok.yaml --sett duration=1", "gaitlab run: error: unknown option '--sett'; did you mean '--set'?");
  refused("new plugin cpg mine --ot x", "gaitlab new plugin: error: unknown option '--ot'; did you mean '--out'?");
  refused("run ok.yaml --quite", "gaitlab run: error: unknown option '--quite'; did you mean '--quiet'?");
}

TEST_F(Messages, HelpIsACommandToo) {
  for (const auto& [words, option] :
       {std::pair("help", "--help"), {"help run", "run --help"}, {"help new plugin", "new plugin --help"}}) {
    const Result result = call(words);
    EXPECT_EQ(result.code, 0) << words;
    EXPECT_EQ(result.err, "") << words;
    EXPECT_EQ(result.out, call(option).out) << words;
    EXPECT_TRUE(contains(result.out, "Usage: gaitlab")) << result.out;
  }
  refused("help rnu", "gaitlab: error: unknown command 'rnu'; did you mean 'run'?");
}

TEST_F(Messages, WhatIsMissing) {
  refused(
      "run",
      "gaitlab run: error: SCENARIO is missing: scenario file (YAML), or a name of `gaitlab list scenarios`; expected gaitlab "
      "run SCENARIO");
  refused("export ok.yaml --to csv",
          "gaitlab export: error: FILE is missing: file to write; must not exist; expected gaitlab export SOURCE --to "
          "csv|gltf|mjcf|urdf FILE");
  refused("new",
          "gaitlab new: error: a command is missing; expected gaitlab new and one of: plugin, module, scenario, bench, log");
  refused("new plugn", "gaitlab new: error: unknown command 'plugn'; did you mean 'plugin'?");
  const Result bare = call("");
  EXPECT_EQ(bare.code, 2);
  EXPECT_TRUE(contains(bare.err, "\nRun a gait:\n  run  ")) << bare.err;
  EXPECT_TRUE(contains(bare.err, "\nMany runs:\n  sweep  ")) << bare.err;
  EXPECT_TRUE(bare.err.ends_with("\ngaitlab: error: a command is missing\n")) << bare.err;
  EXPECT_EQ(bare.out, "");
}

TEST_F(Messages, AWordTooMany) {
  refused("run ok.yaml extra", "gaitlab run: error: found 'extra', one argument too many; expected gaitlab run SCENARIO");
  refused("run ok.yaml duration=1",
          "gaitlab run: error: found 'duration=1', one argument too many; expected gaitlab run SCENARIO; did you mean --set "
          "duration=1?");
  refused("run ok.yaml quiet",
          "gaitlab run: error: found 'quiet', one argument too many; expected gaitlab run SCENARIO; did you mean '--quiet'?");
  refused("run ok.yaml check", "gaitlab run: error: found 'check', one argument too many; expected gaitlab run SCENARIO");
  for (const char* words : {"run -x", "run ok.yaml -x"}) {
    const Result result = call(words);
    EXPECT_EQ(result.code, 2);
    EXPECT_TRUE(result.err.starts_with("gaitlab run: error: unknown option '-x'; known options: --help, --set, --seed,"))
        << result.err;
  }
  refused("--quiet run ok.yaml", "gaitlab: error: unknown option '--quiet'; expected after the command: gaitlab run --quiet");
}

TEST_F(Messages, AValueOfAnotherKind) {
  const std::string jobs = "; expected a whole number from 1 to 1024";
  refused("converge ok.yaml -j x", "gaitlab converge: error: -j is 'x'" + jobs);
  refused("converge ok.yaml --jobs=0", "gaitlab converge: error: --jobs is '0'" + jobs);
  refused("converge ok.yaml --jobs -3", "gaitlab converge: error: --jobs is '-3'" + jobs);
  refused("converge ok.yaml --jobs 1.5", "gaitlab converge: error: --jobs is '1.5'" + jobs);
  refused("new log motions --speed nan", "gaitlab new log: error: --speed is 'nan'; expected a number from 0.1 to 1000");
  refused("run ok.yaml --format hd5", "gaitlab run: error: --format is 'hd5'; expected h5 or csv; did you mean 'h5'?");
  refused("test '' ok.yaml",
          "gaitlab test: error: SCENARIO is empty; expected scenario files, names of `gaitlab list scenarios`, or folders "
          "(default: scenarios)");
  refused("report ''",
          "gaitlab report: error: RUN is empty; expected run folder, or two, A and B: the page compare.html in folder A shows "
          "B over A");
  refused("run ok.yaml --quiet=5x", "gaitlab run: error: --quiet is given '5x'; expected no value");
}

TEST_F(Messages, AnOptionWithoutItsValueTwiceOrBesideAnother) {
  const std::string folder = "expected one after it: run folder (default runs/NAME, then NAME-2 ...); new or empty";
  refused("run ok.yaml --out", "gaitlab run: error: --out has no value; " + folder);
  refused("run ok.yaml --out --quiet", "gaitlab run: error: --out has no value but the option '--quiet'; " + folder);
  refused("run ok.yaml --out a --out b", "gaitlab run: error: --out is given 2 times; expected once");
  refused("converge ok.yaml -j",
          "gaitlab converge: error: -j has no value; expected one after it: a whole number from 1 to 1024");
  refused("rerun x --verify --out y", "gaitlab rerun: error: found --out and --verify together; expected only one of them");
}

TEST_F(Messages, ATabInTheIndentation) {
  refused_text("gaitlab: 1\nrobot:\n\tmodules: mtran\n",
               "s.yaml:3:1: error: found a tab in the indentation; YAML is indented with blanks");
  refused_text("gaitlab: 1\nrobot:\n  modules: mtran\n  \tbuild: x\n",
               "s.yaml:4:3: error: found a tab in the indentation; YAML is indented with blanks");
}

TEST_F(Messages, ARingOfModules) {
  const std::string chain = "gaitlab: 1\nrobot: {modules: mtran, docks: [";
  const std::string end = "]}\nduration: 1\n";
  const std::string ring =
      "error: this dock closes a ring: module 0 and module {} are already connected by other docks; docks must form a tree, "
      "closed chains are not supported";
  refused_text(chain + "[1, 1, 4, 0, 0], [1, 2, 4, 1, 0], [1, 0, 4, 2, 0]" + end,
               "s.yaml:2:67: " + fmt::format(fmt::runtime(ring), 2));
  refused_text(chain + "[1, 0, 4, 1, 0], [1, 1, 4, 2, 0], [1, 2, 4, 0, 0]" + end,
               "s.yaml:2:33: " + fmt::format(fmt::runtime(ring), 1));
}

TEST_F(Messages, ACommaThatEndsAnEquation) {
  refused_text(
      "gaitlab: 1\nrobot: {modules: mtran}\nduration: 1\n"
      "cpg: {type: equations, model: {states: {a: max(1, 2)}, output: a}}\n",
      "s.yaml:4:44: error: a 'max(1' ends within a bracket: in { } a comma ends the text; put the text in quotes, or on a "
      "separate line");
}

TEST_F(Messages, WhatWasTypedIsNamed) {
  refused("check ok.yaml --seed abc", "--seed: error: seed is 'abc'; expected a whole number");
  refused("swap ok.yaml --cpg ,", "--cpg: error: has an empty name in ','; expected types with commas between");
  const Result result = call("converge ok.yaml --columns zzz");
  EXPECT_EQ(result.code, 2);
  EXPECT_TRUE(result.err.starts_with("--columns: error: 'zzz' matches no column")) << result.err;
}

TEST_F(Messages, AJointOfTheFigure) {
  refused("run ok.yaml --joint m1/activ", "--joint m1/activ: error: no joint 'm1/activ'; did you mean 'm1/active'?");
  refused_text(
      "gaitlab: 1\nrobot: {modules: mtran, docks: [[1, 1, 4, 0, 0]]}\nduration: 0.1\nfigure: {joints: [m0/active, "
      "m7/active]}\n",
      "s.yaml:4:30: error: no joint 'm7/active'; joints are m0/active, m1/active");
  EXPECT_EQ(call("run ok.yaml --joint m1/active --joint m0/passive --quiet --out run").code, 0);
  const std::string figure = read(folder_.path() / "run/figure.svg");
  EXPECT_LT(figure.find("joint 2 (m1/active)"), figure.find("joint 1 (m0/passive)"));
  EXPECT_TRUE(contains(read(folder_.path() / "run/scenario.resolved.yaml"), "\nfigure:\n  joints: [m1/active, m0/passive]\n"));
  EXPECT_EQ(call("report run --out again --joint m1/passive").code, 0);
  EXPECT_TRUE(contains(read(folder_.path() / "again/figure.svg"), "joint 3 (m1/passive)"));
  EXPECT_FALSE(contains(read(folder_.path() / "again/figure.svg"), "m1/active"));
}

TEST_F(Messages, WhereAPageIsWritten) {
  const std::string where = "  page      ";
  ASSERT_EQ(call("run ok.yaml --out run --no-report").code, 0);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "run/report.html"));
  refused("report run --page ok.yaml", "ok.yaml: error: exists; nothing was written");
  refused("report run --page run", "run: error: exists; nothing was written");
  refused("report run --page none/p.html", "none/p.html: error: cannot be written: its folder does not exist");
  refused("report run --page ''",
          "gaitlab report: error: --page is empty; expected file for only the page: a new file, or the run's report.html (for "
          "two runs compare.html)");
  refused("check ok.yaml --page ok.yaml", "ok.yaml: error: exists; nothing was written");
  refused("run ok.yaml --no-reports", "gaitlab run: error: unknown option '--no-reports'; did you mean '--no-report'?");
  EXPECT_TRUE(call("report run --page p.html").out.ends_with(where + "p.html\n"));
  EXPECT_TRUE(call("check ok.yaml --page c.html").out.ends_with(where + "c.html\n"));
  EXPECT_TRUE(contains(read(folder_ / "c.html"), "\"outcome\":\"not run\""));
  // The page of the run may be written again, with the same content.
  folder_.write("run/report.html", "old");
  EXPECT_EQ(call("report run --page run/../run/report.html").code, 0);
  EXPECT_TRUE(read(folder_ / "run/report.html") == read(folder_ / "p.html"));
  ASSERT_EQ(call("run ok.yaml --out again").code, 0);
  EXPECT_TRUE(read(folder_ / "again/report.html") == read(folder_ / "p.html"));
  EXPECT_EQ(call("rerun again --out third --quiet").code, 0);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "third/report.html")) << "asked for with gaitlab report";
}

TEST_F(Messages, AnItemOfAList) {
  refused("check ok.yaml --set robot.docks[0][1]=2",
          "--set robot.docks[0][1]=2: error: unknown key 'docks[0][1]'; an item of a list is addressed by its number: "
          "docks.0.1");
  EXPECT_EQ(call("check ok.yaml --set robot.docks.0.1=1").code, 0);
}

TEST_F(Messages, TheNameOfARobotIsAFileOfIt) {
  folder_.write("s.yaml", "gaitlab: 1\nrobot: {modules: mtran, build: hexapod}\nduration: 1\n");
  const Result result = call("check s.yaml");
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_TRUE(contains(result.out, "11 modules")) << result.out;
}

TEST_F(Messages, AControllerForTheTorqueActuator) {
  const Result result = call("check ok.yaml --set actuator.type=torque");
  EXPECT_EQ(result.code, 2);
  EXPECT_TRUE(contains(result.err, "add for example controller: {unit: N m, Kp: ...}")) << result.err;
}

TEST_F(Messages, AFolderIsNotARobotToExport) {
  ASSERT_EQ(call("run ok.yaml --quiet --out run").code, 0);
  refused("export run --to mjcf a.xml",
          "run: error: is a folder, but --to mjcf needs a scenario file; a run folder contains scenario.resolved.yaml");
}

TEST_F(Messages, OnlyMjcfIsStrict) {
  refused("export ok.yaml --strict --to urdf a.urdf", "--strict: error: found --to urdf; expected --to mjcf");
}

TEST_F(Messages, ContactsThatMjcfCannotHold) {
  const std::string robot = " --to mjcf a.xml --set contact.stiffness=";
  const Result soft = call("export '" + kScenarios + "hexapod.yaml'" + robot + "1");
  EXPECT_EQ(soft.code, 2);
  EXPECT_TRUE(
      soft.err.ends_with("--set contact.stiffness=1: error: 1 N/m is too soft to carry the robot of 43.2 N; "
                         "expected stiffer contacts, or --strict\n"))
      << soft.err;
  const Result deep = call("export '" + kScenarios + "library/linkbot-drive.yaml'" + robot + "1000 --set contact.exponent=3");
  EXPECT_EQ(deep.code, 2);
  EXPECT_TRUE(contains(deep.err, "error: spheres of 0.01 m sink 0.108 m into the ground")) << deep.err;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "a.xml"));
}

TEST_F(Messages, WhatTheMachineCannotHold) {
  for (const char* command : {"check", "run"}) {
    const Result result = call(std::string(command) + " ok.yaml --set duration=1e6 --set trace.period=2.5e-5");
    EXPECT_EQ(result.code, 2);
    EXPECT_TRUE(result.err.starts_with("--set duration=1e6: error: the run would record 4e+10 rows of ")) << result.err;
  }
  EXPECT_TRUE(contains(call("check ok.yaml").out, "records 22 rows of ")) << call("check ok.yaml").out;
  // The process has a memory limit. One run needs more than the limit, and one needs less, but not with the memory of the
  // program.
  const std::string program =
      "'" + std::string(gaitlab::test::build_folder()) + "/bin/gaitlab' check ok.yaml --set trace.period=1e-4 2>err";
  for (const auto& [duration, there_is] :
       {std::pair("350", "ulimit -v allows 1.02 GB of memory"), {"227", "that much memory is not available"}}) {
    const int status = std::system(
        fmt::format("cd '{}' && ulimit -v 1000000 && {} --set duration={}", folder_.path().string(), program, duration)
            .c_str());
    if (WEXITSTATUS(status) != 2 && read(folder_ / "err").find("Sanitizer") != std::string::npos) continue;  // takes more
    EXPECT_EQ(WEXITSTATUS(status), 2) << duration;
    EXPECT_TRUE(contains(read(folder_ / "err"), std::string(", but ") + there_is + ": take a longer trace.period"))
        << read(folder_ / "err");
  }
}

/// The program estimates the computing time before the run, from seconds to years.
TEST_F(Messages, HowLongARunTakes) {
  EXPECT_EQ(app::about(0.05), "less than 0.1 s");
  EXPECT_EQ(app::about(14.2), "about 14 s");
  EXPECT_EQ(app::about(1.8e8), "about 5.7 years");
  const Result soon = call("check ok.yaml");
  EXPECT_TRUE(contains(soon.out, "\n  takes less than 0.1 s\n") || contains(soon.out, "\n  takes about ")) << soon.out;
  const std::string endless = "check ok.yaml --set physics.step=1e-9 --set duration=1e6";
  const Result never = call(endless + " --set trace.period=30");
  EXPECT_EQ(never.code, 0) << never.err;
  EXPECT_TRUE(contains(never.out, "\n  takes about ")) << never.out;
  EXPECT_TRUE(contains(never.out, " years")) << never.out;
  const Result refused = call(endless + " --set trace.period=3e-5");
  EXPECT_EQ(refused.code, 2);
  EXPECT_TRUE(contains(refused.err, " (TMPDIR), but that has ")) << refused.err;
  EXPECT_TRUE(contains(refused.err, "\nok.yaml: note: the run takes about ")) << refused.err;
  EXPECT_TRUE(contains(refused.err, " years")) << refused.err;
}

TEST_F(Messages, ALongRunSaysSoBeforeItStarts) {
  const std::string run = "'" + std::string(gaitlab::test::build_folder()) + "/bin/gaitlab' run ok.yaml --set duration=3000";
  // The call with --quiet is ended after 1 s of CPU time, when its run has begun.
  folder_.write("run.sh", run +
                              " --out slow 2>slow.err &\n"
                              "until grep -q takes slow.err || ! kill -0 $! 2>/dev/null; do sleep 0.01; done\n"
                              "kill $!\nwait $!\n"
                              "ulimit -t 1\n" +
                              run + " --quiet --out quiet 2>quiet.err\n");
  ASSERT_EQ(std::system(("cd '" + (folder_ / "") + "' && sh run.sh >out; true").c_str()), 0);
  const std::string slow = read(folder_ / "slow.err");
  EXPECT_TRUE(slow.starts_with("ok.yaml: note: records 6e+05 rows of ")) << slow;
  EXPECT_TRUE(contains(slow, "\nok.yaml: note: takes about ")) << slow;
  EXPECT_FALSE(contains(read(folder_ / "quiet.err"), "takes")) << read(folder_ / "quiet.err");
  EXPECT_FALSE(contains(call("run ok.yaml --out short").err, "takes"));
}

TEST_F(Messages, ARunThatFailsInItsFirstSteps) {
  folder_.write("wild.yaml",
                "gaitlab: 1\nrobot: {modules: mtran}\nduration: 1\n"
                "cpg: {type: equations, model: {states: {phi: exp(700)*exp(700)}, output: phi}}\n");
  const Result result = call("check wild.yaml");
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_TRUE(contains(result.out, "\n  fails early: diverged at step ")) << result.out;
}

/// Manuals fit a terminal of 80 columns, except for equations and YAML.
TEST_F(Messages, ManualsFitATerminal) {
  for (const char* command :
       {"explain", "explain cpg hopf", "explain cpg equations", "explain cpg van_der_pol", "explain cpg tripod",
        "explain actuator dc_motor", "explain engine bullet", "explain engine articulated"}) {
    const std::string out = call(command).out;
    for (std::size_t begin = 0; begin < out.size();) {
      const std::size_t end = out.find('\n', begin);
      const std::string line = out.substr(begin, end - begin);
      begin = end + 1;
      EXPECT_LE(line.size(), 80U) << command << ": " << line;
    }
  }
}

}  // namespace
}  // namespace gaitlab::test
