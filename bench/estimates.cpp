// Table of docs/benchmarks.md: estimated and measured CPU time of `gaitlab run`, for robots of many sizes.
//     estimates [--calls N]
#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/app.h"
#include "core/scenario/read_scenario.h"
#include "core/settings/shipped_files.h"
#include "core/simulation/simulation.h"
#include "kit/run_time.h"
#include "tests/folder.h"

namespace {

using namespace gaitlab;

/// A cart with two wheels; {} is the drive of its hinges.
constexpr const char* kCart = R"(gaitlab_module: 1
name: cart
source: "chosen"
bodies:
  body: {{mass: 0.3, com: [0, 0, 0], inertia: [3e-4, 3e-4, 3e-4, 0, 0, 0], shape: [{{box: [0.08, 0.06, 0.04]}}]}}
  left: {{mass: 0.02, com: [0, 0, 0], inertia: [5e-6, 1e-5, 5e-6, 0, 0, 0], shape: [{{cylinder: [0.04, 0.01]}}]}}
  right: {{mass: 0.02, com: [0, 0, 0], inertia: [5e-6, 1e-5, 5e-6, 0, 0, 0], shape: [{{cylinder: [0.04, 0.01]}}]}}
hinges:
  - {{name: left, parent: body, child: left, origin: [0, 0.04, 0], axis: [0, 1, 0], range: free{0}}}
  - {{name: right, parent: body, child: right, origin: [0, -0.04, 0], axis: [0, 1, 0], range: free{0}}}
connectors: {{c: {{source: "chosen"}}}}
faces:
  - {{id: 1, body: body, gender: none, connector: c, origin: [-0.045, 0, 0], normal: [-1, 0, 0], reference: [0, 0, 1]}}
  - {{id: 2, body: body, gender: none, connector: c, origin: [0.045, 0, 0], normal: [1, 0, 0], reference: [0, 0, 1]}}
contacts:
  source: "chosen"
  all: [{{body: left, sphere: [0, 0, 0], radius: 0.04}}, {{body: right, sphere: [0, 0, 0], radius: 0.04}}]
actuator: {{type: servo, voltage: 7.4, stall_torque: 2, no_load_speed: 4.2}}
controller: {{type: pid, Kp: 82, Kd: 0}}
)";

struct SizedRobot {
  std::string name, scenario;                        ///< text of the scenario; a shipped name if empty
  std::vector<std::pair<std::string, double>> runs;  ///< engine, duration in s
};

/// Text of a robot of equal modules in a row.
std::string row(int modules, const std::string& module, const char* faces, const std::string& gait) {
  std::string docks;
  for (int k = 1; k < modules; ++k)
    docks += fmt::format("{}[{}]", k == 1 ? "" : ", ", fmt::format(fmt::runtime(faces), k, k - 1));
  return fmt::format("gaitlab: 1\nrobot: {{modules: {}, docks: [{}]}}\ncontact: {{on: all}}\n{}duration: 1\n", module, docks,
                     gait);
}

SizedRobot chain(int modules, double articulated, double bullet) {
  const std::string gait = "cpg: {type: phase_oscillator, frequency: 0.25, amplitude: 0.6, phase_lag: 1.2}\n";
  return {fmt::format("chain of {}", modules),
          row(modules, "mtran", "1, {}, 4, {}, 0", gait),
          {{"articulated", articulated}, {"bullet", bullet}}};
}

SizedRobot carts(int modules, bool driven) {
  const std::string gait = driven ? "cpg: {type: equations, model: {states: {turned: 1}, output: turned}}\n" : "";
  return {fmt::format("{} {} wheels", 2 * modules, driven ? "driven" : "free"),
          row(modules, driven ? "cart.yaml" : "free.yaml", "1, {}, 2, {}, 0", gait + "initial: {base_velocity: [0.2, 0, 0]}\n"),
          {{"articulated", 2}, {"bullet", 1}}};
}

std::vector<SizedRobot> robots() {
  std::vector<SizedRobot> all{chain(10, 2, 0.5),    chain(30, 2, 0.3),      chain(100, 1, 0.2),
                              chain(300, 0.3, 0.1), chain(1000, 0.1, 0.03), chain(3000, 0.02, 0.005)};
  for (const int modules : {2, 8, 32}) {
    all.push_back(carts(modules, true));
    all.push_back(carts(modules, false));
  }
  for (const char* name : {"caterpillar", "hexapod"}) all.push_back({name, "", {{"articulated", 20}, {"bullet", 2}}});
  for (const char* name : {"y1-rolling", "linkbot-drive"}) all.push_back({name, "", {{"articulated", 20}}});
  return all;
}

/// CPU time of all calls of other programs so far, s.
double cpu_of_children() {
  rusage used{};
  getrusage(RUSAGE_CHILDREN, &used);
  return static_cast<double>(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
         1e-6 * static_cast<double>(used.ru_utime.tv_usec + used.ru_stime.tv_usec);
}

/// Least CPU time of `calls` calls of a command, s.
double measured(const std::string& command, int calls) {
  double least = 0;
  for (int k = 0; k < calls; ++k) {
    const double before = cpu_of_children();
    if (std::system(command.c_str()) != 0) fmt::print(stderr, "failed: {}\n", command);
    const double took = cpu_of_children() - before;
    least = k == 0 ? took : std::min(least, took);
  }
  return least;
}

void print_robot(const SizedRobot& robot, const test::Folder& folder, const std::string& program, int calls, Catalog& catalog) {
  const std::string file =
      robot.scenario.empty() ? shipped_files("scenario").at(robot.name) : folder.write("robot.yaml", robot.scenario);
  for (const auto& [engine, duration] : robot.runs) {
    const std::vector<std::string> sets{"physics.engine=" + engine, fmt::format("duration={}", duration)};
    const Scenario s = read_scenario(file, sets, catalog);
    const double estimate = kit::estimated_seconds(s, Simulation({&s, 1}).rows_needed(0));
    const double took = measured(fmt::format("'{}' run '{}' --set {} --set {} --out '{}' >/dev/null 2>&1; rm -r '{}'", program,
                                             file, sets[0], sets[1], folder / "run", folder / "run"),
                                 calls);
    fmt::print("| {} | {} | {} | {:.2g} | {:.2g} | {:.2f} |\n", robot.name, engine, duration, estimate, took, took / estimate);
    std::fflush(stdout);
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const std::span words(argv, static_cast<std::size_t>(argc));
    const int calls = words.size() == 3 && std::string_view(words[1]) == "--calls" ? std::stoi(words[2]) : 2;
    const std::string program = (std::filesystem::canonical(words[0]).parent_path() / "gaitlab").string();
    const test::Folder folder;
    folder.write("cart.yaml", fmt::format(kCart, ""));
    folder.write("free.yaml", fmt::format(kCart, ", drive: none"));
    Catalog catalog = app::standard_catalog();
    fmt::print(
        "| robot | engine | duration, s | estimated, CPU s | measured | measured / estimated |\n|---|---|--:|--:|--:|--:|\n");
    for (const SizedRobot& robot : robots()) print_robot(robot, folder, program, calls, catalog);
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "estimates: {}\n", error.what());
    return 2;
  }
}
