// Table of docs/mujoco.md: walks of exported robots in MuJoCo and in gaitlab, with gaitlab's set points as controls.
//     walks [--seconds S] [SCENARIO...]
#include <fmt/format.h>

#include <filesystem>

#include "app/app.h"
#include "bench/mujoco_model.h"
#include "bench/mujoco_plant.h"
#include "core/scenario/read_scenario.h"
#include "core/simulation/simulation.h"
#include "interchange/mjcf.h"

namespace {

using namespace gaitlab;

constexpr double kFrom = 2;  // s; the robot has then settled on the ground and the amplitudes have risen

constexpr double kNothing = 1e-3;  // m, N m; no ratio is shown for less

std::string percent(double theirs, double ours) {
  return ours < kNothing ? "-" : fmt::format("{:+.1f} %", 100 * (theirs / ours - 1));
}

std::string row(const std::string& file, double seconds, Catalog& catalog) {
  const Scenario s = read_scenario(
      file, {fmt::format("duration={}", seconds), "trace.columns=[joint.*,com.*]", "physics.estimate=off"}, catalog);
  Simulation simulation({&s, 1});
  simulation.run();
  const Recording record = simulation.take_recording(0);
  const versus::Walk ours = versus::recorded_walk(record, kFrom);
  const versus::Walk theirs = versus::walk_in_mujoco(interchange::to_mjcf(s, interchange::MjcfModel::walking), s, record, kFrom,
                                                     versus::BetweenTicks::line);
  std::size_t worst = 0;
  for (std::size_t j = 0; j < ours.rms.size(); ++j) {
    if (std::abs(theirs.rms[j] - ours.rms[j]) > std::abs(theirs.rms[worst] - ours.rms[worst])) worst = j;
  }
  return fmt::format("| {} | {:.3f} | {:.3f} | {} | {:.3f} | {:.3f} | {} | {} {:.3f} / {:.3f} |", s.name, ours.travel,
                     theirs.travel, percent(theirs.travel, ours.travel), ours.torque, theirs.torque,
                     percent(theirs.torque, ours.torque), s.robot->joints[worst].name, ours.rms[worst], theirs.rms[worst]);
}

}  // namespace

int main(int count, char** words) {
  try {
    Catalog catalog = app::standard_catalog();
    double seconds = 20;
    std::vector<std::string> files;
    for (int i = 1; i < count; ++i) {
      if (std::string_view(words[i]) == "--seconds" && i + 1 < count) {
        seconds = std::stod(words[++i]);
      } else {
        files.emplace_back(words[i]);
      }
    }
    fmt::print("MuJoCo {}\n\n", mujoco_version());
    fmt::print(
        "| scenario | travel, m | in MuJoCo | difference | RMS torque, N m | in MuJoCo | difference | worst joint |\n"
        "|---|---|---|---|---|---|---|---|\n");
    for (const std::string& file : files) {
      try {
        fmt::print("{}\n", row(file, seconds, catalog));
      } catch (const std::exception& error) {
        fmt::print("| {} | {} |\n", file, error.what());
      }
      std::fflush(stdout);
    }
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "walks: {}\n", error.what());
    return 2;
  }
}
