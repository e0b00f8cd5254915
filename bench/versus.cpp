// `./lab bench --versus`, which compares gaitlab's engines, Bullet and MuJoCo in time and in torques.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>

#include "app/app.h"
#include "bench/mujoco_plant.h"
#include "bench/results.h"
#include "core/build_id.h"
#include "core/files/atomic_file.h"
#include "physics_bullet/engine.h"

namespace {

using namespace gaitlab;

int versus_of(int argc, char** argv) {
  CLI::App app{
      "Runs scenarios under every engine and set-up, interleaved, on one thread. Prints what a simulated second costs and how\n"
      "far torques are from the engine's own converged run; writes versus.json and versus.svg."};
  versus::RaceSettings settings;
  std::string out = "runs/versus";
  std::string page;
  bool markdown = false;
  app.add_option("SCENARIO", settings.scenarios, "scenario files (default: the shipped hexapod and caterpillar)");
  app.add_option("--set", settings.sets, "override a key of every scenario, as key.path=value; may be repeated")
      ->expected(1)
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  app.add_option("--seconds", settings.seconds, "simulated; errors are of the second half (default 8)")
      ->check(CLI::Range(0.02, 1e4));
  app.add_option("--rounds", settings.rounds, "every contender runs once a round (default 5)")->check(CLI::Range(1, 1000));
  app.add_option("--least", settings.least, "seconds that a contender runs in a round at least (default 0.2)")
      ->check(CLI::Range(0.0, 1e3));
  app.add_option("--only", settings.only, "pattern of the contenders' names, with * and ?; may be repeated (default *)")
      ->expected(1)
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  app.add_option("--out", out, "folder of versus.json and versus.svg (default runs/versus)");
  app.add_option("--renew", page, "page whose tables are written anew, with its plot beside it: docs/benchmarks.md")
      ->check(CLI::ExistingFile);
  app.add_flag("--markdown", markdown, "the tables as Markdown");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  if (settings.scenarios.empty()) {
    for (const char* name : {"hexapod", "caterpillar"}) {
      settings.scenarios.push_back(fmt::format("{}/scenarios/{}.yaml", GAITLAB_SOURCE_DIR, name));
    }
  }
  if (!page.empty()) versus::renewed(read_file(page, kMostPage), "");  // throws before the runs, which take long
  settings.say = [](const std::string& what) { fmt::print(stderr, "versus: {}\n", what); };

  Catalog catalog = app::standard_catalog();
  register_mujoco(catalog);
  const versus::RaceResults results = versus::race(settings, catalog);
  std::filesystem::create_directories(out);
  write_file(out + "/versus.json", versus::json(results, settings));
  write_file(out + "/versus.svg", versus::plot(results));
  const std::string versions = fmt::format("Bullet {}, MuJoCo {}", bullet_version(), mujoco_version());
  std::string rounds = fmt::format("{} rounds, interleaved; {} s simulated, errors from {} s on; medians", settings.rounds,
                                   settings.seconds, settings.seconds / 2);
  if (!settings.sets.empty()) rounds += fmt::format("; {}", fmt::join(settings.sets, ", "));
  if (!page.empty()) {
    const std::string head =
        fmt::format("gaitlab {}. {}. {}, one thread; {}.", build_id(), versions, versus::processor(), rounds);
    write_file(page, versus::renewed(read_file(page, kMostPage), head + "\n\n" + versus::digest(results)));
    write_file(std::filesystem::path(page).replace_extension(".svg"), versus::plot(results));
  }
  fmt::print("gaitlab {}\n{}\n{}\n\n{}", build_id(), versions, rounds, versus::table(results, markdown));
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return versus_of(argc, argv);
  } catch (const InputError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    fmt::print(stderr, "versus: error: {}\n", error.what());
    return 1;
  }
}
