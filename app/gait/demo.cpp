// `gaitlab demo`, a first run without a file: the shipped hexapod on the fast engine.
#include <fmt/format.h>

#include <cerrno>  // program_invocation_name of glibc
#include <filesystem>
#include <optional>
#include <string>

#include "app/shell/commands.h"
#include "core/settings/data_folder.h"
#include "core/settings/shell_word.h"

namespace gaitlab::app {

namespace {

constexpr const char* kName = "hexapod";
constexpr const char* kEngine = "physics.engine=articulated";

struct DemoArguments {
  std::optional<std::string> out;
};

int demo(const DemoArguments& demo) {
  RunArguments arguments;
  arguments.file = (std::filesystem::path(data_folder()) / kName).string() + ".yaml";
  arguments.sets = {kEngine};
  arguments.out = demo.out;
  // The printed command calls this program by the same name as the user did, so that it works even if PATH lacks it (./lab
  // demo).
  const std::string again = fmt::format("{} run {} --set {}", shell_word(program_invocation_name), kName, kEngine);
  fmt::print("{}\n", again);
  const int code = run(arguments);
  if (code == 0) {
    fmt::print(
        "\nOpen the page in a browser to see the robot walk, with the torque of every joint. Faster, or with weak motors:\n"
        "  {0} --set cpg.frequency=1\n  {0} --set actuator.i_max=0.35\n",
        again);
  }
  return code;
}

}  // namespace

void add_demo(Commands& commands) {
  add_command<DemoArguments>(commands, "demo", "Simulate a walking hexapod and print the path of its page.", demo,
                             [](CLI::App& command, DemoArguments& arguments) {
                               command.add_option("--out", arguments.out,
                                                  "run folder (default runs/hexapod, then hexapod-2 ...); new or empty");
                             });
}

}  // namespace gaitlab::app
