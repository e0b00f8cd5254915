// `gaitlab test`, which runs scenarios and compares them with their goldens. It prints a table and the columns outside their
// bands, and writes a figure and a page of these columns, and JUnit XML.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <filesystem>
#include <functional>
#include <system_error>

#include "app/keep/failure_page.h"
#include "app/shell/commands.h"
#include "app/shell/progress.h"
#include "core/errors.h"
#include "core/files/atomic_file.h"
#include "core/recording/run_folder.h"
#include "core/scenario/resolved.h"
#include "core/simulation/batch_limits.h"
#include "golden/advice.h"
#include "golden/cases.h"
#include "golden/report.h"
#include "report/figures/paper/paper_figure.h"
#include "report/plot/svg.h"
#include "report/plot/ticks.h"

namespace gaitlab::app {

using namespace golden;

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostDrawn = 6;      // largest number of columns in a figure
constexpr const char* kBands = "3 bands";  // name of the line at kOutside bands

// ---- the table

std::string row(const std::vector<std::size_t>& widths, const std::vector<std::string>& cells) {
  return fmt::format("{:<{}}  {:<{}}  {:>8}  {:<{}}  {:>11}  {}\n", cells[0], widths[0], cells[1], widths[1], cells[2],
                     cells[3], widths[2], cells[4], cells[5]);
}

std::vector<std::string> cells(const GoldenCase& c) {
  const ColumnCheck* column = c.difference.worst_column();
  std::pair<std::string, std::string> number{"-", "-"};
  if (const NumberCheck* worst = c.difference.worst_number(); worst != nullptr) number = {worst->label, bands(worst->ratio())};
  const BoundCheck* bound = c.difference.worst_bound();
  if (bound != nullptr && (number.first == "-" || !bound->passed())) number = {bound->name, bands(bound->ratio())};
  return {c.file,
          column == nullptr ? "-" : column->label,
          column == nullptr ? "-" : bands(column->ratio()),
          number.first,
          number.second,
          to_string(c.verdict)};
}

void print_table(const std::vector<GoldenCase>& cases) {
  const std::vector<std::string> head{"scenario", "worst column", "RMS/band", "worst number", "change/band", "verdict"};
  std::vector<std::size_t> widths{head[0].size(), head[1].size(), head[3].size()};
  for (const GoldenCase& c : cases) {
    const std::vector<std::string> all = cells(c);
    widths = {std::max(widths[0], all[0].size()), std::max(widths[1], all[1].size()), std::max(widths[2], all[3].size())};
  }
  fmt::print("{}", row(widths, head));
  for (const GoldenCase& c : cases) fmt::print("{}", row(widths, cells(c)));
}

std::size_t count(const std::vector<GoldenCase>& cases, CaseVerdict verdict) {
  return static_cast<std::size_t>(
      std::count_if(cases.begin(), cases.end(), [&](const GoldenCase& c) { return c.verdict == verdict; }));
}

std::string counts(const std::vector<GoldenCase>& cases) {
  std::string text =
      fmt::format("{} passed, {} failed", count(cases, CaseVerdict::passed), count(cases, CaseVerdict::regression));
  const auto add = [&](CaseVerdict verdict, const char* what) {
    if (const std::size_t n = count(cases, verdict); n > 0) text += fmt::format(", {} {}", n, what);
  };
  add(CaseVerdict::infeasible, "infeasible");
  add(CaseVerdict::run_failed, "broke off");
  add(CaseVerdict::bad_input, "not tested");
  add(CaseVerdict::skipped, "skipped");
  return text;
}

// ---- what failed

/// A column that is drawn, and the number of others that are late by the same time.
struct Strayed {
  const ColumnCheck* check;
  std::size_t others = 0;
};

/// The columns that exceed their bands most, at most kMostDrawn, in the order of leaving their bands. If only numbers are
/// outside their bands, it is the column nearest to the limit of its band.
std::vector<Strayed> strayed(const GoldenCase& c) {
  std::vector<const ColumnCheck*> found;
  for (const ColumnCheck& check : c.difference.columns) {
    if (!check.passed()) found.push_back(&check);
  }
  if (const ColumnCheck* worst = c.difference.worst_column(); found.empty() && worst != nullptr) found.push_back(worst);
  std::stable_sort(found.begin(), found.end(),
                   [](const ColumnCheck* a, const ColumnCheck* b) { return a->ratio() > b->ratio(); });
  // Columns of the whole robot that are late by the same time show the same fact, so that only the worst of them is drawn.
  std::vector<Strayed> groups;
  for (const ColumnCheck* check : found) {
    const auto same = [&](const Strayed& group) {
      constexpr double kEqual = 0.02;  // share of the shift; tolerates errors of its estimate
      const double shift = group.check->time_shift;
      return shift != 0 && std::abs(check->time_shift - shift) <= kEqual * std::abs(shift);
    };
    if (const auto group = std::ranges::find_if(groups, same); group != groups.end()) {
      ++group->others;
    } else {
      groups.push_back({check});
    }
  }
  groups.resize(std::min(groups.size(), kMostDrawn));
  const double never = c.scenario->duration + 1;
  std::ranges::stable_sort(groups, {}, [&](const Strayed& group) { return group.check->outside.value_or(never); });
  return groups;
}

/// A column of the golden and of the run over their common rows, and their difference as a multiple of kOutside bands, which is
/// often a thousandth of the column.
Recording compared(const GoldenCase& c, const ColumnCheck& check) {
  constexpr double kLeast = 0.01, kMost = 1e9;  // multiples that are drawn
  const Trace& golden = c.golden->run.trace;
  const Trace& run = c.run.trace;
  Recording both;
  both.trace.columns = std::vector<Column>{
      {"t", "s", ""}, {"golden", check.unit, ""}, {"now", check.unit, ""}, {"difference", "", ""}, {kBands, "", ""}};
  for (std::size_t k = 0; k < std::min(golden.rows(), run.rows()); ++k) {
    const double before = golden.at(k, golden.find(check.name));
    const double now = run.at(k, run.find(check.name));
    const double apart = std::abs(now - before);
    const double bands = apart == 0 ? kLeast : std::clamp(apart / (kOutside * check.band * check.scale), kLeast, kMost);
    both.simulated = golden.at(k, 0);
    both.trace.values.insert(both.trace.values.end(), {both.simulated, before, now, bands, 1});
  }
  return both;
}

/// Figure of columns with, below each of them, the difference of its curves.
std::string overlay(const GoldenCase& c, const std::string& title, const std::vector<Strayed>& shown) {
  report::Recipe recipe = report::screen_recipe(title);
  std::vector<Recording> recordings;
  recordings.reserve(shown.size());
  std::vector<report::PaperRun> runs;
  for (const auto& [check, others] : shown) {
    runs.push_back({check->label, *c.scenario, recordings.emplace_back(compared(c, *check))});
    if (recordings.back().rows() < 2) continue;
    report::PanelRecipe panel;
    panel.runs = {check->label};
    panel.title = check->label + (check->unit.empty() ? "" : " (" + check->unit + ")");
    if (others > 0) {
      panel.title +=
          fmt::format(" and {} more, late by {} s", others, report::with_minus(fmt::format("{:.2g}", check->time_shift)));
    }
    if (check->outside) {
      panel.title += fmt::format(", outside from {:.6g} s (dotted line)", *check->outside);
      panel.marks = {*check->outside};
    }
    panel.left = {.columns = {"golden", "now"}, .label = check->unit.empty() ? check->label : check->unit};
    panel.height = 40;
    recipe.panels.push_back(panel);
    panel.title.clear();
    panel.left = {.columns = {"difference", kBands}, .label = "\u00D7 3 bands", .log = true};
    panel.height = 22;
    recipe.panels.push_back(panel);
  }
  return report::figure_svg(recipe, runs);
}

/// Folder of the figures. If --out does not name one, it is created with the first figure.
class Figures {
 public:
  explicit Figures(const std::optional<std::string>& out) {
    if (out) folder_.emplace(*out, "");
  }

  /// Writes figure and page of a case, and stores their names in the case. Does nothing if there is nothing to draw.
  void write(GoldenCase& c) {
    const std::vector<Strayed> shown = strayed(c);
    if (shown.empty()) return;
    if (!folder_) folder_.emplace(std::nullopt, "test");
    fs::path file = folder_->path() / (c.scenario->name + ".svg");
    for (int k = 2; fs::exists(file); ++k) file.replace_filename(fmt::format("{}-{}.svg", c.scenario->name, k));
    const std::size_t all = strayed_columns(c.difference);
    const std::string title =
        all == 0 ? fmt::format("{}: no column outside its band; the closest column is shown", c.scenario->name)
                 : fmt::format("{}: {}{} of {} outside their bands, the first to leave its band on top", c.scenario->name,
                               all > shown.size() ? "the worst " : "", shown.size(), plural(all, "column"));
    write_file(file, overlay(c, title, shown));
    folder_->keep();
    c.figure = file.string();
    file.replace_extension(".failure.html");
    write_file(file, failure_page(c));
    c.page = file.string();
  }

 private:
  std::optional<RunFolder> folder_;
};

/// Message about a failed case: changes, largest deviations, and the files with further data.
std::string failure(const GoldenCase& c, bool all) {
  if (!c.golden) return differences(c.difference, Shown::strayed);
  const GoldenProvenance now = golden_origin(*c.scenario);
  const std::string changes = origin_changes(c.golden->origin, now, all ? kAllSettings : kFewSettings);
  std::string text = since_approval(*c.golden) + (changes.empty() ? "  build and scenario are the same\n" : changes) +
                     verdict_change(*c.golden, c.run) + differences(c.difference, all ? Shown::strayed : Shown::brief);
  const std::size_t more = all ? 0 : left_out(c.difference);
  const std::string page = c.page.empty() ? "" : "page: " + c.page;
  if (more > 0) {
    text += fmt::format("  and {} more: --all shows them{}{}\n", more, page.empty() ? "" : "; ", page);
  } else if (!page.empty()) {
    text += "  " + page + "\n";
  }
  return text + (c.figure.empty() ? "" : "  figure: " + c.figure + "\n");
}

/// Prints notes on cases that passed: numbers with wide bands, a changed verdict, and a changed resolved scenario.
void print_notes(const std::vector<GoldenCase>& cases) {
  for (const GoldenCase& c : cases) {
    if (c.verdict != CaseVerdict::passed || !c.golden) continue;
    if (const std::string names = wide_number_names(*c.golden); !names.empty()) {
      say(c.file, "note",
          fmt::format("numbers with bands above {}, which hide smaller changes: {}", percent(kWideNumber), names));
    }
    if (c.run.verdict && c.golden->verdict != *c.run.verdict) {
      say(c.file, "note",
          fmt::format("the verdict was {} when it was approved, and is {}: {}", name_of(c.golden->verdict),
                      name_of(*c.run.verdict), c.run.why));
    }
    if (c.other_engine || hash(resolved(*c.scenario)) == c.golden->origin.scenario) continue;
    say(c.file, "note", "the resolved scenario has changed since the golden was approved");
  }
}

// ---- JUnit XML, as CI servers read it, without times, so that equal results give equal files

std::string junit(const std::vector<GoldenCase>& cases) {
  const std::size_t errors = count(cases, CaseVerdict::bad_input) + count(cases, CaseVerdict::run_failed);
  double seconds = 0;  // sum over all runs, some of which may have been simulated at the same time
  for (const GoldenCase& c : cases) seconds += c.seconds;
  std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n";
  text += fmt::format(
      "<testsuite name=\"gaitlab test\" tests=\"{}\" failures=\"{}\" errors=\"{}\" skipped=\"{}\" time=\"{:.3f}\">\n",
      cases.size(), count(cases, CaseVerdict::regression) + count(cases, CaseVerdict::infeasible), errors,
      count(cases, CaseVerdict::skipped), seconds);
  for (const GoldenCase& c : cases) {
    text += fmt::format("<testcase classname=\"golden\" name=\"{}\" time=\"{:.3f}\">", report::xml_escaped(c.file), c.seconds);
    const auto element = [&](const char* name, const std::string& message, const std::string& content) {
      text += fmt::format("<{0} message=\"{1}\">{2}</{0}>", name, report::xml_escaped(message), content);
    };
    // Written line by line, because XML readers turn an escaped line break into a space.
    const auto lines = [](const std::string& content) {
      std::string escaped;
      for (std::size_t at = 0; at < content.size();) {
        const std::size_t end = std::min(content.find('\n', at), content.size());
        escaped += report::xml_escaped(content.substr(at, end - at)) + "\n";
        at = end + 1;
      }
      return escaped;
    };
    if (c.verdict == CaseVerdict::regression) element("failure", outside(c.difference), lines(failure(c, false)));
    if (c.verdict == CaseVerdict::infeasible) element("failure", to_string(c.verdict), lines(c.problem));
    if (c.verdict == CaseVerdict::bad_input || c.verdict == CaseVerdict::run_failed)
      element("error", to_string(c.verdict), lines(c.problem));
    if (c.verdict == CaseVerdict::skipped) element("skipped", "no golden", "");
    text += "</testcase>\n";
  }
  return text + "</testsuite>\n</testsuites>\n";
}

/// Checks the path of --junit before the runs, so that a wrong path costs no time. Throws InputError if the path is an existing
/// file that is not XML, or if its folder is not writable.
void check_report(const std::string& path) {
  const SourceLocation place{"--junit " + path};
  const fs::file_type kind = kind_of(path);
  if (kind == fs::file_type::directory) throw InputError(place, "is a folder");
  if (kind == fs::file_type::regular && size_of(path) > 0 && !read_start(path, 5).starts_with("<?xml"))
    throw InputError(place, "exists and is not XML, so it is not overwritten; expected another file");
  const fs::path folder = fs::path(path).parent_path();
  if (::access(folder.empty() ? "." : folder.c_str(), W_OK | X_OK) != 0)
    throw InputError(place, "cannot be written: " + std::generic_category().message(errno));
}

int exit_code(const std::vector<GoldenCase>& cases) {
  if (count(cases, CaseVerdict::bad_input) > 0) return 2;
  if (count(cases, CaseVerdict::run_failed) > 0) return 1;
  if (count(cases, CaseVerdict::regression) > 0) return 4;
  if (count(cases, CaseVerdict::infeasible) > 0) return 3;
  return count(cases, CaseVerdict::passed) == 0 ? 2 : 0;
}

int test_goldens(const TestArguments& arguments) {
  Figures figures(arguments.out);
  if (arguments.junit) check_report(*arguments.junit);
  Catalog catalog = standard_catalog();
  std::vector<GoldenCase> cases = golden_cases(arguments, catalog);
  {
    Progress progress(false);
    run_cases(cases, arguments, std::ref(progress));
  }
  bool written = true;
  const auto write = [&](const std::function<void()>& file) {  // continues after a file that cannot be written, because the
                                                               // results matter more
    try {
      file();
    } catch (const std::runtime_error& error) {  // InputError: the folder cannot be created
      say("gaitlab", "error", error.what());
      written = false;
    }
  };
  print_table(cases);
  print_notes(cases);
  for (GoldenCase& c : cases) {
    if (c.verdict == CaseVerdict::regression) {
      write([&] { figures.write(c); });
      fmt::print("\n{}: {}\n{}", c.file, outside(c.difference), failure(c, arguments.all));
    }
    if (!c.problem.empty()) say(c.problem + "\n");
  }
  fmt::print("\n{}\n", counts(cases));
  if (arguments.junit) write([&] { write_file(*arguments.junit, junit(cases)); });
  if (cases.size() == count(cases, CaseVerdict::skipped))
    say("gaitlab", "error", "nothing was tested: no scenario has a golden; make one with gaitlab approve");
  const int code = exit_code(cases);
  return code == 0 && !written ? 1 : code;
}

}  // namespace

void add_test(Commands& commands) {
  add_command<TestArguments>(
      commands, "test", "Run scenarios and compare them with their goldens; exit code 4: a torque drifted.", test_goldens,
      [](CLI::App& command, TestArguments& arguments) {
        offering(command.add_option("SCENARIO", arguments.scenarios),
                 "scenario files, names of {}, or folders (default: scenarios)", {.kinds = {"scenarios"}})
            ->check(not_empty)
            ->transform(named_file_or_folder);
        command.add_option("-j,--jobs", arguments.jobs, "threads (default 1)")->check(CLI::Range(1, kMostThreads));
        command.add_option("--junit", arguments.junit, "also write the result as JUnit XML to this file")->check(not_empty);
        command.add_option("--engine", arguments.engine,
                           "run with this engine, at the golden's step (articulated: extrapolated); torque peaks, which depend "
                           "on the method, are left out");
        command.add_option("--golden", arguments.golden, "golden folder for one scenario, instead of its own golden")
            ->check(not_empty);
        command.add_option("--out", arguments.out, "folder for figures and pages of failed tests (default runs/test)");
        command.add_flag("--fail-infeasible", arguments.fail_infeasible,
                         "exit code 3 if a run with motors is not feasible and nothing else failed");
        command.add_flag("--all", arguments.all,
                         "show all columns, numbers and settings of failed tests, not only the worst ones");
        command.add_flag("--strict", arguments.strict, "a scenario without a golden is an error, also in a folder");
      });
}

}  // namespace gaitlab::app
