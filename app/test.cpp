// Runs scenarios and compares them with their goldens: a table, the columns that strayed, a figure of them, JUnit XML.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "app/app.h"
#include "app/golden_cases.h"
#include "app/golden_report.h"
#include "core/errors.h"
#include "core/trace/atomic_file.h"
#include "core/trace/run_folder.h"
#include "report/overlay.h"
#include "report/svg.h"

namespace gaitlab::app {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kPanels = 4;  // of a figure: what strayed first explains the rest

// ---- the table

std::string row(const std::vector<std::size_t>& widths, const std::vector<std::string>& cells) {
  return fmt::format("{:<{}}  {:<{}} {:>9}  {:<{}} {:>11}  {}\n", cells[0], widths[0], cells[1], widths[1], cells[2], cells[3],
                     widths[2], cells[4], cells[5]);
}

std::vector<std::string> cells(const GoldenCase& c) {
  const ColumnCheck* column = c.difference.worst_column();
  const NumberCheck* number = c.difference.worst_number();
  return {c.file,
          column == nullptr ? "-" : column->name,
          column == nullptr ? "-" : bands(column->ratio()),
          number == nullptr ? "-" : number->name,
          number == nullptr ? "-" : bands(number->ratio()),
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

std::size_t count(const std::vector<GoldenCase>& cases, Verdict verdict) {
  return static_cast<std::size_t>(
      std::count_if(cases.begin(), cases.end(), [&](const GoldenCase& c) { return c.verdict == verdict; }));
}

std::string counts(const std::vector<GoldenCase>& cases) {
  std::string text = fmt::format("{} passed, {} failed", count(cases, Verdict::passed), count(cases, Verdict::regression));
  const auto add = [&](Verdict verdict, const char* what) {
    if (const std::size_t n = count(cases, verdict); n > 0) text += fmt::format(", {} {}", n, what);
  };
  add(Verdict::run_failed, "broke off");
  add(Verdict::bad_input, "not tested");
  add(Verdict::skipped, "skipped");
  return text;
}

// ---- what failed

template <class Check>
std::size_t failing(const std::vector<Check>& checks) {
  return static_cast<std::size_t>(std::count_if(checks.begin(), checks.end(), [](const Check& c) { return !c.passed(); }));
}

/// One line, the same on screen and in XML.
std::string outside(const GoldenDifference& d) {
  return fmt::format("{} of {} and {} of {} outside their bands", failing(d.columns), plural(d.columns.size(), "column"),
                     failing(d.numbers), plural(d.numbers.size(), "number")) +
         (d.findings.empty() ? "" : ", and a run of another form");
}

std::vector<OverlayPanel> panels(const GoldenCase& c) {
  std::vector<const ColumnCheck*> first;
  for (const ColumnCheck& check : c.difference.columns) {
    if (!check.passed()) first.push_back(&check);
  }
  const double never = c.scenario->duration + 1;
  std::stable_sort(first.begin(), first.end(), [&](const ColumnCheck* a, const ColumnCheck* b) {
    const double from_a = a->outside.value_or(never);
    const double from_b = b->outside.value_or(never);
    return from_a != from_b ? from_a < from_b : a->ratio() > b->ratio();
  });
  first.resize(std::min(first.size(), kPanels));
  std::vector<OverlayPanel> panels;
  for (const ColumnCheck* check : first) {
    OverlayPanel panel{check->name, check->unit};
    const Trace& golden = c.golden->run.trace;
    for (std::size_t k = 0; k < std::min(golden.rows(), c.run.trace.rows()); ++k) {
      panel.time.push_back(golden.at(k, 0));
      panel.reference.push_back(golden.at(k, golden.find(check->name)));
      panel.now.push_back(c.run.trace.at(k, c.run.trace.find(check->name)));
    }
    panel.tolerance = kOutside * check->band * check->scale;
    panel.outside = check->outside;
    panels.push_back(std::move(panel));
  }
  return panels;
}

/// Where figures go: one folder for all with --out, else one a scenario.
class Figures {
 public:
  explicit Figures(const std::optional<std::string>& out) {
    if (out) common_.emplace(*out, "");
  }

  /// The file's name, or "" where there is nothing to draw.
  std::string write(const GoldenCase& c) {
    const std::vector<OverlayPanel> shown = panels(c);
    if (shown.empty()) return "";
    const std::string title = fmt::format("{}: {} outside their bands, the first to stray on top", c.scenario->name,
                                          plural(failing(c.difference.columns), "column"));
    if (!common_) {
      RunFolder own({}, "test-" + c.scenario->name);
      return put(own, own.path() / "overlay.svg", overlay_svg(title, shown));
    }
    fs::path file = common_->path() / (c.scenario->name + ".svg");
    for (int k = 2; fs::exists(file); ++k) file.replace_filename(fmt::format("{}-{}.svg", c.scenario->name, k));
    return put(*common_, file, overlay_svg(title, shown));
  }

 private:
  static std::string put(RunFolder& folder, const fs::path& file, const std::string& svg) {
    write_file(file, svg);
    folder.keep();
    return file.string();
  }

  std::optional<RunFolder> common_;
};

void print_failure(const GoldenCase& c, Figures& figures) {
  fmt::print("\n{}: {}\n{}", c.file, outside(c.difference), differences(c.difference, Shown::failing));
  const std::string figure = figures.write(c);
  if (!figure.empty()) fmt::print("  figure: {}\n", figure);
}

/// That it was approved from another text explains a failure, and is no failure.
void print_notes(const std::vector<GoldenCase>& cases) {
  for (const GoldenCase& c : cases) {
    const bool compared = c.verdict == Verdict::passed || c.verdict == Verdict::regression;
    if (!compared || c.other_engine || hash(resolved(*c.scenario)) == c.golden->origin.scenario) continue;
    fmt::print(stderr, "{}: note: its resolved text is no longer that of the golden\n", c.file);
  }
}

// ---- JUnit XML, as CI servers read it; without times, so that equal results are equal files

std::string junit(const std::vector<GoldenCase>& cases) {
  const std::size_t errors = count(cases, Verdict::bad_input) + count(cases, Verdict::run_failed);
  std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n";
  text += fmt::format("<testsuite name=\"gaitlab test\" tests=\"{}\" failures=\"{}\" errors=\"{}\" skipped=\"{}\">\n",
                      cases.size(), count(cases, Verdict::regression), errors, count(cases, Verdict::skipped));
  for (const GoldenCase& c : cases) {
    text += fmt::format("<testcase classname=\"golden\" name=\"{}\">", xml_escaped(c.file));
    const auto element = [&](const char* name, const std::string& message, const std::string& content) {
      text += fmt::format("<{0} message=\"{1}\">{2}</{0}>", name, xml_escaped(message), content);
    };
    // Line by line, because an escaped line break is a space.
    const auto lines = [](const std::string& content) {
      std::string escaped;
      for (std::size_t at = 0; at < content.size();) {
        const std::size_t end = std::min(content.find('\n', at), content.size());
        escaped += xml_escaped(content.substr(at, end - at)) + "\n";
        at = end + 1;
      }
      return escaped;
    };
    if (c.verdict == Verdict::regression)
      element("failure", outside(c.difference), lines(differences(c.difference, Shown::failing)));
    if (c.verdict == Verdict::bad_input || c.verdict == Verdict::run_failed)
      element("error", to_string(c.verdict), lines(c.problem));
    if (c.verdict == Verdict::skipped) element("skipped", "no golden", "");
    text += "</testcase>\n";
  }
  return text + "</testsuite>\n</testsuites>\n";
}

int exit_code(const std::vector<GoldenCase>& cases) {
  if (count(cases, Verdict::regression) > 0) return 4;
  if (count(cases, Verdict::run_failed) > 0) return 1;
  return count(cases, Verdict::bad_input) > 0 || count(cases, Verdict::passed) == 0 ? 2 : 0;
}

}  // namespace

int test_goldens(const TestArguments& arguments) {
  Figures figures(arguments.out);
  Catalog catalog = standard_catalog();
  std::vector<GoldenCase> cases = golden_cases(arguments, catalog);
  run_cases(cases, arguments.jobs);
  print_table(cases);
  print_notes(cases);
  for (const GoldenCase& c : cases) {
    if (c.verdict == Verdict::regression) print_failure(c, figures);
    if (!c.problem.empty()) fmt::print(stderr, "{}\n", c.problem);
  }
  fmt::print("\n{}\n", counts(cases));
  if (arguments.junit) write_file(*arguments.junit, junit(cases));
  if (cases.size() == count(cases, Verdict::skipped))
    fmt::print(stderr, "gaitlab: error: nothing was tested: no scenario has a golden; make one with gaitlab approve\n");
  return exit_code(cases);
}

}  // namespace gaitlab::app
