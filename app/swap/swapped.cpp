#include "app/swap/swapped.h"

#include <fmt/format.h>

#include <algorithm>

#include "app/shell/stop_on_signal.h"
#include "app/study/study_progress.h"
#include "core/errors.h"
#include "core/simulation/batch.h"
#include "report/analysis/collisions.h"

namespace gaitlab::app {

namespace {

/// Type of the scenario's own CPG; "" if it has none. --set changes settings of the CPG's model only under this CPG.
std::string own_cpg(const SwapArguments& arguments, Catalog& catalog) {
  auto quiet = static_cast<const ScenarioArguments&>(arguments);
  quiet.quiet = true;
  const Scenario scenario = read(quiet, catalog);
  return scenario.cpg.entry == nullptr ? "" : std::string(scenario.cpg.entry->name);
}

std::vector<std::string> split(const std::string& list) {
  std::vector<std::string> names(1);
  for (const char c : list) {
    if (c == ',') names.emplace_back();
    if (c != ',') names.back() += c;
  }
  for (std::string& name : names) {
    const std::size_t first = std::min(name.find_first_not_of(' '), name.size());
    name = name.substr(first, name.find_last_not_of(' ') + 1 - first);
  }
  return names;
}

/// Adds those problems of an error that have not been added before. Their place `--set cpg.type=CPG` is replaced by --cpg,
/// which the user typed.
void add_new(const InputError& error, const std::string& cpg, std::vector<Problem>& problems) {
  for (Problem problem : error.problems()) {
    if (problem.place.file == "--set cpg.type=" + cpg) problem.place = SourceLocation{"--cpg"};
    const auto alike = [&](const Problem& p) {
      return p.text == problem.text && to_string(p.place) == to_string(problem.place);
    };
    if (std::none_of(problems.begin(), problems.end(), alike)) problems.push_back(problem);
  }
}

/// Sets a CPG other than the scenario's own. Settings `cpg.model...` belong to the own CPG; they are dropped with a note.
void exchange(ScenarioArguments& with, Swapped& swapped) {
  const auto of_model = [](const std::string& set) { return set.starts_with("cpg.model"); };
  for (const std::string& set : with.sets)
    if (of_model(set)) swapped.notes.push_back({{with.file}, fmt::format("{}: dropped --set {}", swapped.cpg, set)});
  std::erase_if(with.sets, of_model);
  with.sets.push_back("cpg.type=" + swapped.cpg);
}

}  // namespace

std::vector<Swapped> read_swapped(const SwapArguments& arguments, Catalog& catalog) {
  std::vector<Swapped> all;
  std::vector<Problem> problems;
  const std::string own = own_cpg(arguments, catalog);
  for (const std::string& cpg : split(arguments.cpgs)) {
    if (cpg.empty()) {
      problems.push_back({SourceLocation{"--cpg"},
                          fmt::format("has an empty name in '{}'; expected types with commas between", arguments.cpgs)});
      break;
    }
    const auto same = [&](const Swapped& other) { return other.cpg == cpg; };
    if (std::any_of(all.begin(), all.end(), same)) {
      problems.push_back({SourceLocation{"--cpg"}, fmt::format("names '{}' twice", cpg)});
      continue;
    }
    Swapped swapped{cpg};
    auto with = static_cast<const ScenarioArguments&>(arguments);
    with.quiet = true;  // notes are printed after all names have been read
    if (cpg != own) exchange(with, swapped);
    try {
      swapped.scenario = read(with, catalog);
      swapped.notes.insert(swapped.notes.end(), swapped.scenario->notes.begin(), swapped.scenario->notes.end());
    } catch (const InputError& error) {
      add_new(error, cpg, problems);
    }
    all.push_back(std::move(swapped));
  }
  if (!problems.empty()) throw InputError(std::move(problems));
  for (const Swapped& swapped : all) {
    for (const Note& note : swapped.notes) {
      if (!arguments.quiet) say(to_string(note.place), "note", note.text);
    }
  }
  return all;
}

std::vector<std::vector<Swapped>> read_matrix(const SwapArguments& arguments, Catalog& catalog) {
  std::vector<std::vector<Swapped>> all;
  std::vector<Problem> problems;
  std::vector<std::pair<std::string, std::string>> names;  // name and file of each scenario
  for (const std::string& file : arguments.files) {
    SwapArguments one = arguments;
    one.file = file;
    try {
      all.push_back(read_swapped(one, catalog));
      const std::string& name = all.back().front().scenario->name;
      const auto same = std::ranges::find(names, name, &std::pair<std::string, std::string>::first);
      if (same != names.end()) {
        problems.push_back(
            {SourceLocation{file}, fmt::format("has the same name, {}, as {}; expected another name:", name, same->second)});
      }
      if (name == "swap.csv" || name == "swap.json") {
        problems.push_back(
            {SourceLocation{file}, "its name, " + name + ", is also the name of an output file; expected another name:"});
      }
      names.emplace_back(name, file);
    } catch (const InputError& error) {
      add_new(error, "", problems);
    }
  }
  if (!problems.empty()) throw InputError(std::move(problems));
  return all;
}

bool run_swapped(const std::vector<Swapped*>& all, int jobs, bool quiet) {
  AgainProgress progress(quiet, "swap");
  std::size_t next = 0;
  std::vector<std::vector<Problem>> refused(all.size());
  const BatchStream stream{.next = [&]() -> std::optional<Rollout> {
                             if (next == all.size()) return {};
                             const std::size_t number = next++;
                             return Rollout{number, *all[number]->scenario};
                           },
                           .end =
                               [&](std::vector<RolloutEnd>&& pack) {
                                 progress.add(pack.size(), all.size());
                                 for (RolloutEnd& end : pack) {
                                   Swapped& one = *all[end.rollout.number];
                                   refused[end.rollout.number] = std::move(end.refused);
                                   if (!refused[end.rollout.number].empty()) continue;
                                   one.record = std::move(end.recording);
                                   one.summary = report::summarise(*one.scenario, one.record, 0);
                                   one.verdict = report::verdict(*one.scenario, one.record, one.summary,
                                                                 report::overlaps(*one.scenario, one.record));
                                 }
                               }};
  const bool whole = run_pulled(stream, {.threads = jobs}, Loads::left_out, stopped(), all.size());
  for (std::vector<Problem>& problems : refused)
    if (!problems.empty()) throw InputError(std::move(problems));
  return whole;
}

}  // namespace gaitlab::app
