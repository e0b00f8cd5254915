#include "core/recording/compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/shell/commands.h"
#include "core/errors.h"
#include "core/model/pattern.h"
#include "core/recording/run_files.h"
#include "core/settings/changed_settings.h"
#include "core/settings/wording.h"
#include "kit/stored_scenario.h"
#include "report/verdict/numbers/numbers.h"

namespace gaitlab::app {

namespace {

struct CompareArguments {
  std::string a, b;                  ///< run folders or trace files
  std::vector<std::string> columns;  ///< patterns of column names; empty for all columns
  bool all = false;                  ///< print all differing columns and settings, not only the first ones
};

using Json = nlohmann::json;

constexpr std::size_t kMostShown = 10;

// Throws InputError for a pattern that matches no column, because the output would look as if there were no difference.
void check_patterns(const CompareOptions& options, const Trace& a, const Trace& b) {
  std::vector<std::string> names;
  for (const Trace* trace : {&a, &b}) {
    for (const Column& column : trace->columns) {
      names.push_back(column.name);
      names.push_back(readable_column(column.name, options.names));
    }
  }
  Problems problems;
  for (const std::string& pattern : options.columns) {
    if (std::any_of(names.begin(), names.end(), [&](const std::string& name) { return glob(pattern, name); })) continue;
    const std::string near = nearest(pattern, names);
    problems.add(SourceLocation{"--columns"}, fmt::format("{} matches no column of either trace{}", in_quotes(pattern),
                                                          near.empty() ? "" : "; did you mean '" + near + "'?"));
  }
  problems.raise();
}

std::string percent(double share) { return fmt::format("{:.3g} %", 100 * share); }

/// Names of joints or contacts (`key`) if both summaries list the same names. Empty otherwise, because column names contain
/// numbers that are then ambiguous.
std::vector<std::string> common_names(const Json& a, const Json& b, const char* key) {
  const auto of = [&](const Json& summary) {
    std::vector<std::string> names;
    if (!summary.contains(key) || !summary[key].is_array()) return names;
    for (const Json& name : summary[key]) names.push_back(name.is_string() ? name.get<std::string>() : "");
    return names;
  };
  std::vector<std::string> names = of(a);
  std::vector<std::string> others = of(b);
  if (names.empty()) return others;
  for (std::size_t i = 0; i < std::min(names.size(), others.size()); ++i) {
    if (names[i] != others[i]) names[i].clear();
  }
  return names;
}

/// Prints a warning if the numbers of joints or contacts have different meanings in the two runs, because columns are compared
/// by number.
void print_robots(const Json& a, const Json& b) {
  for (const char* names : {"joints", "contacts"}) {
    if (a.contains(names) && b.contains(names) && a[names] != b[names]) {
      fmt::print("the robots have different {} ({} and {}); columns are matched only by their numbers\n", names,
                 a[names].size(), b[names].size());
    }
  }
}

/// Prints the settings that differ between the scenarios of the two runs. They are not known if a run is a CSV file alone.
void print_settings(OpenedRun& a, OpenedRun& b, bool all) {
  std::vector<std::string> changed;
  try {
    const std::string then = a.scenario().text;
    changed = changed_settings(then, b.scenario().text, all ? std::string::npos : kMostShown);
  } catch (const InputError&) {
    fmt::print("\nsettings: not compared, because a CSV file contains none\n");
    return;
  }
  fmt::print("\nsettings: {}\n", changed.empty() ? "the same" : "A -> B");
  for (const std::string& setting : changed) fmt::print("  {}\n", setting);
}

/// Prints the columns with the largest differences, and the time when the first column diverges.
void print_columns(const TraceDifference& difference, bool all) {
  std::vector<const ColumnDifference*> apart;
  const ColumnDifference* first = nullptr;
  for (const ColumnDifference& d : difference.columns) {
    if (!d.equal) apart.push_back(&d);
    if (d.first_divergence && (first == nullptr || *d.first_divergence < *first->first_divergence)) first = &d;
  }
  std::stable_sort(apart.begin(), apart.end(), [](const auto* a, const auto* b) { return a->relative_rms > b->relative_rms; });
  const std::size_t shown = all ? apart.size() : std::min(apart.size(), kMostShown);
  std::vector<std::vector<std::string>> rows{{"column", "RMS", "max", "RMS/range", "max/range", "from t =", "late by"}};
  for (std::size_t i = 0; i < shown; ++i) {
    const ColumnDifference& d = *apart[i];
    const auto with_unit = [&](double value) { return fmt::format("{:.3g}{}{}", value, d.unit.empty() ? "" : " ", d.unit); };
    const std::string late =
        d.time_shift == 0 ? "-" : fmt::format("{:+.3g} s, then {}", d.time_shift, percent(d.rms_after_shift / d.scale));
    rows.push_back({d.label, with_unit(d.rms), with_unit(d.maximum), percent(d.relative_rms), percent(d.relative_maximum),
                    d.first_divergence ? fmt::format("{:.6g} s", *d.first_divergence) : "never", late});
  }
  fmt::print("\n");
  if (shown > 0) fmt::print("{}", aligned(rows));
  if (shown < apart.size()) fmt::print("and {} more: --all shows them\n", apart.size() - shown);
  fmt::print("{} of {} columns are bit-equal in the {} rows compared\n", difference.columns.size() - apart.size(),
             difference.columns.size(), difference.rows);
  if (first != nullptr) fmt::print("first column to diverge: {} at t = {:.6g} s\n", first->label, *first->first_divergence);
}

// Value at a JSON pointer, or null if the summary does not contain it.
Json at(const Json& summary, const std::string& pointer) {
  const Json::json_pointer where(pointer);
  return summary.contains(where) ? summary.at(where) : Json();
}

/// Name of the most loaded joint or, in a summary without a judged window, of the joint with the largest torque.
std::string most_loaded_joint(const Json& summary) {
  const Json judged = at(summary, "/judged/joint");
  if (judged.is_string()) return judged.get<std::string>();
  const Json joints = at(summary, "/per_joint");
  std::string found;
  double largest = 0;
  for (const auto& [name, joint] : joints.items()) {
    const Json peak = at(joint, "/torque/peak");
    if (!peak.is_number() || !(peak.get<double>() > largest)) continue;
    largest = peak.get<double>();
    found = name;
  }
  return found;
}

std::string shown(const Json& value) {
  if (value.is_null()) return "-";
  if (value.is_number_float()) return fmt::format("{:.6g}", value.get<double>());
  return value.is_string() ? value.get<std::string>() : value.dump();
}

/// Magnitude below which numbers of a summary, in SI units, are rounding errors. Chosen.
constexpr double kNoise = 1e-9;

// Text of the change from A to B, relative to A if both are numbers.
std::string change(const Json& a, const Json& b) {
  if (a == b) return "equal";
  if (!a.is_number() || !b.is_number()) return "differs";
  const double from = a.get<double>();
  const double by = b.get<double>() - from;
  // A percentage of a number near zero would be meaningless: the difference is printed instead.
  return std::abs(from) < std::max(0.01 * std::abs(by), kNoise) ? fmt::format("{:+.3g}", by)
                                                                : fmt::format("{:+.3g} %", 100 * by / std::abs(from));
}

void print_summaries(const Json& a, const Json& b) {
  const std::string joint = most_loaded_joint(a);  // A's most loaded joint, for numbers that belong to one joint
  std::vector<const report::SummaryNumber*> rows = report::placed(&report::SummaryNumber::compare);
  if (joint.empty()) std::erase_if(rows, [](const report::SummaryNumber* number) { return number->of_joint != nullptr; });
  std::erase_if(rows, [&](const report::SummaryNumber* number) {
    const Json one = at(a, number->pointer(joint));
    const Json other = at(b, number->pointer(joint));
    return (one.is_null() && other.is_null()) || (number->compare.if_different && one == other);
  });
  std::size_t width = 0;
  for (const report::SummaryNumber* number : rows) width = std::max(width, number->row(joint).size());
  fmt::print("\n{:<{}} {:>18} {:>18}  {}\n", "summary", width, "A", "B", "B - A");
  for (const report::SummaryNumber* number : rows) {
    const Json one = at(a, number->pointer(joint));
    const Json other = at(b, number->pointer(joint));
    fmt::print("{:<{}} {:>18} {:>18}  {}\n", number->row(joint), width, shown(one), shown(other), change(one, other));
  }
}

/// Summary of a run folder. Null for a trace file, because a summary.json beside the file may belong to another run.
Json summary_of(const std::string& run) { return std::filesystem::is_directory(run) ? read_summary(run) : Json(); }

int compare(const CompareArguments& arguments) {
  OpenedRun run_a(arguments.a), run_b(arguments.b);
  const Trace& a = run_a.trace().trace;
  const Trace& b = run_b.trace().trace;
  const Json summary_a = summary_of(arguments.a);
  const Json summary_b = summary_of(arguments.b);
  CompareOptions options;
  options.names = {common_names(summary_a, summary_b, "joints"), common_names(summary_a, summary_b, "contacts")};
  if (!arguments.columns.empty()) options.columns = arguments.columns;
  check_patterns(options, a, b);
  const TraceDifference difference = gaitlab::compare(a, b, options);

  fmt::print("A: {} ({} rows)\n", one_line(run_a.trace().file.string()), a.rows());
  fmt::print("B: {} ({} rows)\n", one_line(run_b.trace().file.string()), b.rows());
  for (const std::string& finding : difference.findings) fmt::print("{}\n", finding);
  print_robots(summary_a, summary_b);
  print_settings(run_a, run_b, arguments.all);
  if (!summary_a.is_null() && !summary_b.is_null()) {
    print_summaries(summary_a, summary_b);
  } else {
    fmt::print("\nsummary numbers: not compared, because a trace file contains none\n");
  }
  print_columns(difference, arguments.all);
  return 0;
}

}  // namespace

void add_compare(Commands& commands) {
  add_command<CompareArguments>(
      commands, "compare",
      "Report what differs between two runs: settings, numbers, columns; the exit code is 0 whether or not they differ.",
      compare, [](CLI::App& command, CompareArguments& arguments) {
        command.add_option("RUN_A", arguments.a, "run folder or trace file: the reference")->required();
        command.add_option("RUN_B", arguments.b, "run folder or trace file")->required();
        command
            .add_option("--columns", arguments.columns,
                        "only columns that match this pattern (with * and ?): joint.3.*, or by name '*passive torque'")
            ->expected(1)
            ->allow_extra_args(false)
            ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
        command.add_flag("--all", arguments.all, "print all columns and settings that differ, not only ten of each");
      });
}

}  // namespace gaitlab::app
