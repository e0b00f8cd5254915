// `gaitlab identify`: the numbers of a servo from logs of a bench.
#include "identify/identify.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "app/look/cells.h"
#include "app/shell/commands.h"
#include "app/shell/progress.h"
#include "app/shell/stop_on_signal.h"
#include "core/files/atomic_file.h"
#include "core/settings/wording.h"
#include "core/simulation/batch_limits.h"
#include "identify/findings.h"
#include "identify/log_check.h"
#include "identify/page.h"
#include "identify/servo_text.h"
#include "identify/tables.h"

namespace gaitlab::app {

namespace {

namespace fs = std::filesystem;

using identify::BenchLog;
using identify::Identified;
using identify::IdentifiedKey;
using identify::Key;

struct IdentifyArguments {
  std::string file;
  std::vector<std::string> logs, sets, fit, held_out;
  double share = 0.25;
  std::vector<std::string> quantities;
  std::string to, page;
  std::int64_t seed = 1;
  int jobs = 1;
  bool drop_spikes = false;
  bool quiet = false;
};

/// The fitted values as options.
std::string settings_text(const Identified& made, const std::vector<Key>& keys) {
  std::string text;
  for (const IdentifiedKey& one : made.keys) {
    if (one.fitted) text += fmt::format("--set {}={}\n", keys[one.key].name, number_text(one.value));
  }
  return text;
}

std::vector<std::string> names_of_quantities() {
  std::vector<std::string> names;
  for (const LoggedKind& kind : logged_kinds()) names.emplace_back(kind.key);
  return names;
}

/// The quantities with these names; without a name the angle, and the duty if all logs have it.
std::vector<Logged> compared_kinds(const std::vector<std::string>& names, const std::vector<BenchLog>& logs) {
  std::vector<Logged> kinds;
  for (const LoggedKind& kind : logged_kinds()) {
    if (std::ranges::find(names, kind.key) != names.end()) kinds.push_back(kind.kind);
  }
  if (!names.empty()) return kinds;
  kinds = {Logged::angle};
  if (std::ranges::all_of(logs, &BenchLog::has_duty)) kinds.push_back(Logged::duty);
  return kinds;
}

int identify_servo(const IdentifyArguments& a) {
  for (const std::string& file : {a.to, a.page}) {
    if (!file.empty()) check_new(file);
  }
  const auto place = [](const std::string& file) { return fs::weakly_canonical(fs::absolute(file)); };
  if (!a.to.empty() && !a.page.empty() && place(a.to) == place(a.page))
    throw InputError(SourceLocation{"--page"}, "is the file of --to; expected another one");
  Catalog catalog = standard_catalog();
  std::vector<BenchLog> logs = identify::read_bench(a.file, a.sets, a.logs, catalog, a.drop_spikes);
  identify::check_logs(logs);
  identify::hold_out(logs, a.held_out, a.share, a.seed);
  const std::vector<Key> keys = identify::fitted_keys(logs[0].scenario, a.fit);
  const std::vector<Logged> kinds = compared_kinds(a.quantities, logs);
  for (const Logged kind : kinds) identify::check_fit(logs, kind, keys);
  const auto odd = std::ranges::find_if_not(keys, identify::holds_in_servo_file);
  if (!a.to.empty() && odd != keys.end()) {
    throw InputError(SourceLocation{"--to"},
                     fmt::format("a servo file cannot state {}; without --to its value is printed", odd->name));
  }
  const StopOnSignal stop(StopOnSignal::Second::ends_the_process);
  Identified made;
  try {
    identify::ErrorModels models(logs, keys, kinds, a.jobs, stopped());
    identify::IdentifySettings settings{.seed = a.seed, .choose = a.fit.empty()};
    settings.told = [&](const std::string& stage) {
      if (!a.quiet) say(fmt::format("{} runs; {}\n", models.runs(), stage));
    };
    made = identify::identify(models, settings);
  } catch (const identify::Stopped&) {
    say("gaitlab identify", "error", "interrupted; nothing was written");
    return 1;
  }
  const std::string name = fs::path(a.to.empty() ? "servo" : a.to).stem().string();
  const std::string result =
      odd == keys.end() ? identify::servo_text(name, a.file, a.sets, made, logs, keys) : settings_text(made, keys);
  const std::vector<std::string> limits = identify::findings(made, logs, keys);
  if (!a.to.empty()) write_file(a.to, result, Existing::refused);
  if (!a.page.empty()) write_file(a.page, identify::identify_page(made, logs, keys, limits, result), Existing::refused);
  if (a.quiet) {
    if (a.to.empty()) fmt::print("{}", result);
    return 0;
  }
  std::string text =
      fmt::format("{}; {} of {} starts end within 2 % of the best\n\n{}\n{}\n", counted(made.runs, "run"), made.agreed,
                  made.starts, cells_text(identify::error_rows(made, logs)), cells_text(identify::key_rows(made, keys)));
  if (!limits.empty()) {
    text += "limits of these logs\n";
    for (const std::string& one : limits) text += "  " + wrapped(one, 4, 98).substr(2);
  }
  text += "\n" + cells_text(identify::log_rows(made, logs)) + "\n";
  if (!a.page.empty()) text += "the page is in " + a.page + "\n";
  text += a.to.empty() ? result : "the servo is in " + a.to + "\n";
  fmt::print("{}", text);
  return 0;
}

}  // namespace

void add_identify(Commands& commands) {
  add_command<IdentifyArguments>(
      commands, "identify", "Fit the numbers of a servo to logs of a bench, with intervals and the error on logs held out.",
      identify_servo, [](CLI::App& command, IdentifyArguments& a) {
        command.add_option("BENCH", a.file, "scenario with a section `measured`, whose log each of the logs replaces")
            ->required()
            ->transform(named_file);
        command
            .add_option("LOGS", a.logs,
                        "logs (CSV), or tables of logs: a column `file`, `group`, and settings with a value per log")
            ->required();
        command.add_option("--set", a.sets, "setting KEY=VALUE of all logs")->allow_extra_args(false);
        command
            .add_option(
                "--fit", a.fit,
                "fit this key, KEY or KEY=LOW:HIGH, once per key; without it, the usual keys, of which those stay that earn "
                "5 % of the error of left-out logs")
            ->allow_extra_args(false);
        command
            .add_option("--hold-out", a.held_out,
                        "logs for the held-out error alone, by a pattern of their names; once per pattern")
            ->allow_extra_args(false);
        command.add_option("--share", a.share, "share of the groups to hold out without --hold-out (default 0.25)")
            ->check(within(0, 1));
        command
            .add_option("--of", a.quantities,
                        "compared quantity, once per quantity (default angle, and duty if all logs have it)")
            ->check(CLI::IsMember(names_of_quantities()))
            ->allow_extra_args(false);
        command.add_flag("--drop-spikes", a.drop_spikes,
                         "leave out rows whose angle jumps to and fro faster than 4 times the speed of the motor");
        command.add_option("--to", a.to, "write the servo to this new file");
        command
            .add_option("--page", a.page, "page (HTML) to write, with tables, limits and a figure of every log; must not exist")
            ->check(not_empty);
        command.add_option("--seed", a.seed, "seed of drawn starts and of the logs held out (default 1)");
        command.add_option("-j,--jobs", a.jobs, "threads (default 1)")->check(CLI::Range(1, kMostThreads));
        command.add_flag("--quiet", a.quiet, "print only errors");
      });
}

}  // namespace gaitlab::app
