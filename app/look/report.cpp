// `gaitlab report`, which prints and writes the results of one or two runs from their folders alone.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "app/gait/judged_run.h"
#include "app/shell/commands.h"
#include "core/errors.h"
#include "core/files/atomic_file.h"
#include "core/recording/run_files.h"
#include "core/recording/run_folder.h"
#include "core/scenario/resolved.h"
#include "core/settings/changed_settings.h"
#include "kit/stored_scenario.h"
#include "report/analysis/summary.h"
#include "report/figures/paper/run_figure.h"
#include "report/page/page.h"
#include "report/page/page_overlay.h"
#include "report/verdict/demand.h"
#include "report/verdict/numbers/summary_text.h"

namespace gaitlab::app {

namespace {

namespace fs = std::filesystem;

constexpr const char* kPairFile = "compare.html";  ///< name of the page in the folder of the first of two runs

struct ReportArguments {
  std::vector<std::string> runs;    ///< one run folder or two
  std::optional<std::string> out;   ///< folder for summary.json, verdict.json, figure.svg and report.html
  std::optional<std::string> page;  ///< file for the page, if only a page is written
  SummaryOptions shown;
  std::vector<std::string> joints;  ///< names of the joints in the figure
  PluginArguments plugins;
};

int report_one(const ReportArguments& arguments) {
  const std::string& name = arguments.runs.front();
  Existing existing = Existing::refused;
  if (arguments.page) existing = check_page(*arguments.page, trace_file(name).parent_path() / kPageFile);
  Catalog catalog = careful_catalog(arguments.plugins);
  const JudgedRun run = judged_run(name, catalog, arguments.joints, arguments.shown);
  const Scenario& scenario = run.read.scenario;
  const std::vector<std::string>& missing = run.read.stored.missing;
  if (arguments.out && !missing.empty()) {
    throw InputError(SourceLocation{name}, fmt::format("summary and figure cannot be computed again: {}; write only the page, "
                                                       "--page FILE, or simulate again: gaitlab rerun {}",
                                                       fmt::join(missing, "; "), name));
  }
  std::string page;
  if (arguments.out || arguments.page) page = report::page(run.page_data());
  if (arguments.page) write_file(*arguments.page, page, existing);
  if (arguments.out) {
    RunFolder out(*arguments.out, scenario.name);
    write_file(out.path() / "figure.svg", report::run_figure(scenario, run.recording(), run.summary));
    write_file(out.path() / "verdict.json", report::to_json(run.verdict));
    write_file(out.path() / kPageFile, page);
    write_file(out.path() / "summary.json", report::to_json(run.summary, scenario, run.recording()));
    out.keep();
  }
  print_summary(scenario, run.recording(), run.summary, run.verdict, arguments.shown);
  if (arguments.out) {
    fmt::print("  {:<13} {}: summary.json, verdict.json, figure.svg\n", "files", one_line(*arguments.out));
    print_page(fs::path(*arguments.out) / kPageFile);
  }
  if (arguments.page) print_page(*arguments.page);
  warn(run);
  return exit_code(run.verdict, arguments.shown);
}

/// Names of two run folders; with the folders around them if the names are equal. A page does not contain whole paths.
std::array<std::string, 2> folder_names(const std::vector<std::string>& runs) {
  const auto path = [&](std::size_t k) { return fs::weakly_canonical(trace_file(runs[k]).parent_path()); };
  const fs::path a = path(0), b = path(1);
  if (a.filename() != b.filename()) return {a.filename().string(), b.filename().string()};
  const auto longer = [](const fs::path& one) { return (one.parent_path().filename() / one.filename()).string(); };
  return {longer(a), longer(b)};
}

int report_two(const ReportArguments& arguments) {
  const fs::path own = trace_file(arguments.runs[0]).parent_path() / kPairFile;
  const std::string file = arguments.page.value_or(own.string());
  const Existing existing = check_page(file, own);
  std::array<Catalog, 2> catalogs{careful_catalog(arguments.plugins), careful_catalog(arguments.plugins)};
  const JudgedRun a = judged_run(arguments.runs[0], catalogs[0], {}, arguments.shown);
  const JudgedRun b = judged_run(arguments.runs[1], catalogs[1], {}, arguments.shown);
  report::PageOverlay overlay;
  overlay.folders = folder_names(arguments.runs);
  overlay.differs = changed_settings(resolved(a.read.scenario), resolved(b.read.scenario), 6);
  constexpr std::size_t kEach = report::kMostData / 2;
  write_file(file, report::page(report::overlaid(a.page_data(kEach), b.page_data(kEach), overlay)), existing);
  int code = 0;
  for (const auto& [label, run] : {std::pair{"A", &a}, std::pair{"B", &b}}) {
    fmt::print("{}: ", label);
    print_summary(run->read.scenario, run->recording(), run->summary, run->verdict, arguments.shown);
    warn(*run);
    const int own_code = exit_code(run->verdict, arguments.shown);
    code = code == 1 || own_code == 1 ? 1 : std::max(code, own_code);  // a failed run takes precedence over an infeasible one
  }
  print_page(file);
  return code;
}

int report(const ReportArguments& arguments) {
  if (arguments.runs.size() == 1) return report_one(arguments);
  if (arguments.out)
    throw InputError(SourceLocation{"--out " + *arguments.out}, "is only for one run; for two runs write a page: --page FILE");
  return report_two(arguments);
}

}  // namespace

void add_report(Commands& commands) {
  add_command<ReportArguments>(
      commands, "report",
      "Print the summary of a run folder again, without simulating; for two folders, also write a page with both.", report,
      [](CLI::App& command, ReportArguments& arguments) {
        command
            .add_option("RUN", arguments.runs, "run folder, or two, A and B: the page compare.html in folder A shows B over A")
            ->required()
            ->expected(1, 2)
            ->check(not_empty);
        command.add_option("--out", arguments.out,
                           "new or empty folder for summary.json, verdict.json, figure.svg and report.html, computed again");
        command
            .add_option("--page", arguments.page,
                        "file for only the page: a new file, or the run's report.html (for two runs compare.html)")
            ->check(not_empty);
        add_trust(command, arguments.plugins);
        add_joint(command, arguments.joints);
        command.get_option("--joint")->needs("--out");
        add_shown(command, arguments.shown);
      });
}

}  // namespace gaitlab::app
