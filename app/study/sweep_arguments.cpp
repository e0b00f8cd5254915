#include "app/study/sweep_arguments.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "core/files/file_kind.h"
#include "core/settings/shell_word.h"
#include "core/settings/wording.h"
#include "studies/study/parameter_file.h"
#include "studies/study/study_file.h"

namespace gaitlab::app {

using studies::Study;

namespace {

void refuse_beside_a_study(const SweepArguments& a, Problems& problems) {
  const auto refuse = [&](bool given, const char* option, const char* key) {
    if (given)
      problems.add(SourceLocation{option}, fmt::format("cannot be combined with a study file; write {} in that file", key));
  };
  refuse(!a.grids.empty(), "--grid", "parameters");
  refuse(!a.randoms.empty(), "--random", "parameters");
  refuse(a.sobol, "--sobol", "method: {type: sobol}");
  refuse(!a.sets.empty(), "--set", "set: [KEY=VALUE]");
  refuse(a.replicates > 0, "--seeds", "replicates: {count: N}");
  refuse(a.seed.has_value(), "--seed", "seed: N");
}

/// Study that the options of the command line describe.
Study typed_study(const SweepArguments& a, Problems& problems) {
  Study study;
  study.scenario = a.file;
  study.place = SourceLocation{"gaitlab sweep"};
  study.sets = a.sets;
  study.replicates.count = a.replicates;
  for (const std::string& grid : a.grids) study.parameters.push_back(studies::read_parameter("--grid", grid, false, problems));
  for (const std::string& random : a.randoms)
    study.parameters.push_back(studies::read_parameter("--random", random, true, problems));
  if (a.seed) {
    const auto digits = [](char c) { return c >= '0' && c <= '9'; };
    const bool whole = !a.seed->empty() && a.seed->size() < 16 && std::ranges::all_of(*a.seed, digits);
    if (!whole) problems.add(SourceLocation{"--seed"}, "is " + in_quotes(*a.seed) + "; expected a whole number from 0");
    if (whole) study.seed = std::atoll(a.seed->c_str());
  }
  if (!a.grids.empty() && !a.randoms.empty())
    problems.add(SourceLocation{"--random"}, "cannot be combined with --grid; expected only one of the two");
  if (study.parameters.empty() && a.replicates == 0) {
    problems.add(SourceLocation{"gaitlab sweep"},
                 "nothing changes from run to run; expected --grid KEY=A:B:N, --random KEY=A:B or --seeds N");
  }
  if (!a.randoms.empty()) {
    study.method = a.sobol ? studies::Method::sobol : studies::Method::random;
    study.runs = a.runs;
    if (a.runs == 0) problems.add(SourceLocation{"--runs"}, "is missing; --random needs a number of runs");
  } else {
    if (a.runs > 0)
      problems.add(SourceLocation{"--runs"}, "is only for --random; a grid runs every combination of its values; leave it out");
    if (a.sobol) problems.add(SourceLocation{"--sobol"}, "chooses points of --random; expected --random KEY=A:B --runs N");
  }
  for (std::size_t k = 0; k < study.parameters.size(); ++k) {
    for (std::size_t other = 0; other < k; ++other) {
      if (study.parameters[k].key == study.parameters[other].key)
        problems.add(study.parameters[k].place, study.parameters[k].key + " is given twice");
    }
  }
  if (problems.empty()) check_study(study, problems);
  return study;
}

}  // namespace

Study wanted_study(const SweepArguments& a) {
  Problems problems;
  Study study;
  if (studies::is_study(a.file)) {
    refuse_beside_a_study(a, problems);
    problems.raise();
    study = studies::read_study(a.file);
    if (studies::is_search(study.method)) {
      throw InputError(SourceLocation{a.file}, fmt::format("its method {} searches; use gaitlab optimize {}",
                                                           name_of(study.method), shell_word(a.file)));
    }
    if (a.runs > 0 && study.method == studies::Method::grid) {
      problems.add(SourceLocation{"--runs"},
                   "has no effect on a grid, which runs every combination of its values; leave it out");
    }
    if (a.runs > 0) study.runs = a.runs;
    if (a.runs > 0) study.place = SourceLocation{"--runs"};
  } else {
    expect_kind(a.file, FileKind::scenario);
    study = typed_study(a, problems);
  }
  problems.raise();
  for (const std::string& pattern : a.quantities) study.quantities.push_back(pattern);
  return study;
}

namespace {

/// Value of an environment variable that Slurm sets in a job array. `otherwise` is the default if the variable may be missing.
std::uint64_t array_number(const char* name, Problems& problems, std::optional<std::uint64_t> otherwise = {}) {
  const char* text = std::getenv(name);
  if (text == nullptr && otherwise) return *otherwise;
  const std::string found = text == nullptr ? "" : text;
  const bool whole = !found.empty() && found.size() < 8 && found.find_first_not_of("0123456789") == std::string::npos;
  if (text == nullptr) problems.add(SourceLocation{"--shard auto"}, std::string(name) + " is not set; a Slurm array sets it");
  if (text != nullptr && !whole)
    problems.add(SourceLocation{"--shard auto"}, fmt::format("{} is {}; expected a number", name, in_quotes(found)));
  return whole ? std::strtoull(found.c_str(), nullptr, 10) : 0;
}

/// Shard of a task of a Slurm job array. If the folder contains shards of another count, the array repeats some of them, and
/// the task number is the number of the shard.
studies::Shard array_shard(const std::optional<std::string>& out, Problems& problems) {
  const std::uint64_t id = array_number("SLURM_ARRAY_TASK_ID", problems);
  const std::uint64_t first = array_number("SLURM_ARRAY_TASK_MIN", problems);
  const std::uint64_t count = array_number("SLURM_ARRAY_TASK_COUNT", problems);
  const std::uint64_t step = std::max<std::uint64_t>(1, array_number("SLURM_ARRAY_TASK_STEP", problems, 1));
  if (!problems.empty()) return {};
  const studies::Shards there = out ? studies::shards_in(*out) : studies::Shards{};
  const bool again = there.count != 0 && there.count != count;
  const studies::Shard shard = again ? studies::Shard{id, there.count} : studies::Shard{(id - first) / step, count};
  if (shard.index < shard.count && (again || (id - first) % step == 0)) return shard;
  problems.add(SourceLocation{"--shard auto"},
               again ? fmt::format("task {} is not one of the {} shards in {}", id, there.count, clipped(*out))
                     : fmt::format("task {} is not one of an array of {} from {} in steps of {}; expected an array A-B or "
                                   "A-B:STEP, or some tasks of an array whose shards are in the folder",
                                   id, count, first, step));
  return {};
}

}  // namespace

studies::Shard wanted_shard(const SweepArguments& a) {
  studies::Shard shard;
  if (a.shard.empty()) return shard;
  Problems problems;
  if (a.shard == "auto") {
    shard = array_shard(a.out, problems);
  } else {
    const std::size_t slash = a.shard.find('/');
    const auto number = [&](const std::string& text) {
      const bool whole = !text.empty() && text.size() < 8 && text.find_first_not_of("0123456789") == std::string::npos;
      return whole ? std::strtoll(text.c_str(), nullptr, 10) : -1;
    };
    const long long index = number(a.shard.substr(0, slash));
    const long long count = slash == std::string::npos ? -1 : number(a.shard.substr(slash + 1));
    if (index < 0 || count < 1 || index >= count) {
      problems.add(SourceLocation{"--shard"}, "is " + in_quotes(a.shard) + "; expected I/N with I from 0 to N - 1, or auto");
    } else {
      shard = {static_cast<std::uint64_t>(index), static_cast<std::uint64_t>(count)};
    }
  }
  if (!a.out) problems.add(SourceLocation{"--out"}, "is missing; expected the folder to which all shards of the study write");
  problems.raise();
  return shard;
}

std::string goes_on(const SweepArguments& a, const std::filesystem::path& folder) {
  std::vector<std::string> words{"gaitlab", "sweep", told_path(a.file)};
  const auto add = [&](const char* option, const std::string& value) {
    words.emplace_back(option);
    words.push_back(value);
  };
  for (const std::string& grid : a.grids) add("--grid", grid);
  for (const std::string& random : a.randoms) add("--random", random);
  if (a.sobol) words.emplace_back("--sobol");
  if (a.runs > 0) add("--runs", std::to_string(a.runs));
  if (a.replicates > 0) add("--seeds", std::to_string(a.replicates));
  for (const std::string& set : a.sets) add("--set", set);
  for (const std::string& pattern : a.quantities) add("--show", pattern);
  if (a.seed) add("--seed", *a.seed);
  for (const std::string& answers : a.answers) add("--answers", told_path(answers));
  if (!a.shard.empty()) add("--shard", a.shard);
  add("--out", told_path(folder.string()));
  std::string line;
  for (const std::string& word : words) line += (line.empty() ? "" : " ") + shell_word(word);
  return line;
}

}  // namespace gaitlab::app
