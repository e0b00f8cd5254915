#include "studies/run/answers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <utility>

#include "core/settings/wording.h"
#include "studies/plan/definition.h"
#include "studies/study/number.h"

namespace gaitlab::studies {

namespace {

std::string key_of(const std::string& point, const std::string& replicate, const std::string& seed,
                   const std::string& scenario) {
  return point + " " + replicate + " " + seed + " " + scenario;
}

std::string key_of(const Row& row) {
  return key_of(row.point, std::to_string(row.replicate), std::to_string(row.seed), row.scenario);
}

/// The lines of a definition that decide when runs are stopped: by expressions, and as hopeless, with the guards.
struct StopLines {
  std::string rules, hopeless;
};

StopLines stop_lines(const std::string& definition) {
  StopLines lines;
  std::string guards;
  for (std::size_t at = 0; at < definition.size();) {
    const std::size_t end = std::min(definition.find('\n', at), definition.size());
    const std::string line = definition.substr(at, end - at) + "\n";
    const std::string key = line.substr(0, line.find(": "));
    if (key == "guard") guards += line;
    if (key == "stop") (line.find(kHopeless) == key.size() + 2 ? lines.hopeless : lines.rules) += line;
    at = end + 1;
  }
  if (!lines.hopeless.empty()) lines.hopeless += guards;
  return lines;
}

/// Jobs for an executor, with reuse of results.
class Remembering {
 public:
  Remembering(const Work& work, std::vector<Answers>& answers, std::uint64_t* taken)
      : work_(work), answers_(answers), taken_(taken) {}

  std::optional<Job> next() {
    while (std::optional<Job> job = work_.next()) {
      if (std::optional<Row> row = answered(job->row)) {
        if (taken_ != nullptr) ++*taken_;
        give(std::move(*row));
      } else if (!held(*job)) {
        give_all();
        return job;
      }
    }
    give_all();
    return {};
  }

  void end(std::vector<Row>&& rows) {
    std::vector<Row> copies;
    {
      const std::lock_guard lock(mutex_);
      for (const Row& row : rows) {
        const auto at = known_.find(key_of(row));
        if (at == known_.end()) continue;
        at->second.row = row;
        for (Row& waiting : at->second.waiting) copies.push_back(as(waiting, row));
        at->second.waiting.clear();
      }
    }
    work_.end(std::move(rows));
    if (!copies.empty()) work_.end(std::move(copies));
  }

 private:
  struct Known {
    std::optional<Row> row;    ///< nothing until the run has ended
    std::vector<Row> waiting;  ///< rows of the same run, which get its result
  };

  /// Row of another run with the same values, renumbered for the run `wanted`.
  static Row as(const Row& wanted, const Row& known) {
    Row row = known;
    row.run = wanted.run;
    return row;
  }

  std::optional<Row> answered(const Row& wanted) {
    for (Answers& one : answers_) {
      if (std::optional<Row> row = one.find(wanted)) return row;
    }
    return {};
  }

  /// True if a run with the same values provides the row, now or when that run has ended.
  bool held(const Job& job) {
    constexpr std::size_t kMost = 20000;  // most rows in memory; further repetitions are simulated again
    std::optional<Row> row;
    {
      const std::lock_guard lock(mutex_);
      const auto at = known_.find(key_of(job.row));
      if (at == known_.end()) {
        if (known_.size() < kMost) known_[key_of(job.row)] = {};
        return false;
      }
      if (!at->second.row) {
        at->second.waiting.push_back(job.row);
        return true;
      }
      row = as(job.row, *at->second.row);
    }
    give(std::move(*row));
    return true;
  }

  void give(Row&& row) {
    given_.push_back(std::move(row));
    constexpr std::size_t kMany = 64;
    if (given_.size() >= kMany) give_all();
  }

  void give_all() {
    if (!given_.empty()) work_.end(std::exchange(given_, {}));
  }

  const Work& work_;
  std::vector<Answers>& answers_;
  std::uint64_t* taken_;
  std::vector<Row> given_;  ///< rows found by next(), which only one thread at a time calls
  std::mutex mutex_;        ///< guards the following members
  std::map<std::string, Known> known_;
};

}  // namespace

Answers::Answers(const Plan& plan, std::filesystem::path file, const std::string& build, Journal::Build taken) : plan_(plan) {
  std::error_code none;
  if (std::filesystem::is_directory(file, none)) file /= kJournalFile;
  if (!std::filesystem::exists(file, none))
    throw InputError(SourceLocation{file.string()}, "does not exist; expected the study.db of a study");
  journal_ = std::make_unique<Journal>(file);
  const JournalHead& head = journal_->head();
  const auto refuse = [&](const std::string& what) { throw InputError(SourceLocation{file.string()}, what); };
  if (head.build != build && taken == Journal::Build::same) {
    refuse("was written by another build, which may give other numbers: " + head.build + ", and this is " + build +
           "; use its answers anyway with --accept-build");
  }
  if (head.told) refuse("has results that another program gave; expected the journal of simulated runs");
  const StopLines theirs = stop_lines(head.definition);
  const StopLines own = stop_lines(definition(plan.bound()));
  stops_alike_ = theirs.hopeless == own.hopeless;
  if (theirs.rules != own.rules)
    refuse("is of a study with other rules for stopping runs; its runs may have ended at other times");
  const std::vector<std::string> names = journal_->columns().all();
  for (const Quantity& quantity : plan.columns()) {
    const std::string column = journal_->column_of(quantity.name);
    if (column.empty()) refuse("lacks the quantity " + in_quotes(quantity.name) + ", which this study needs");
    quantities_.push_back(place_in(names, column));
  }
  // Keys of the columns. If the other study has other keys, its points have other names, so that none is found.
  std::vector<std::string> keys;
  for (const Parameter& p : plan.study().parameters) keys.push_back(p.key);
  for (const Variation& v : plan.study().replicates.vary) keys.push_back(v.key);
  if (keys.size() != head.parameters.size()) return;
  for (std::size_t k = 0; k < keys.size(); ++k) {
    if (head.parameters[k].key != keys[k]) return;
    values_.push_back(place_in(names, journal_->columns().parameters[k]));
  }
  outcome_ = place_in(names, "outcome");
  message_ = place_in(names, "message");
  simulated_ = place_in(names, "simulated");
  verdict_ = place_in(names, "verdict");
  std::vector<std::string> columns{"run", "point", "replicate", "seed"};
  if (journal_->columns().scenario) columns.emplace_back("scenario");
  journal_->each_row(columns, [&](const std::vector<std::string>& row) {
    runs_.emplace(key_of(row[1], row[2], row[3], row.size() > 4 ? row[4] : ""), run_number_of(row[0]));
  });
}

bool Answers::same_values(const Row& wanted, const std::vector<std::string>& there) const {
  if (wanted.values.size() != values_.size()) return false;
  for (std::size_t k = 0; k < values_.size(); ++k) {
    const bool words = journal_->head().parameters[k].words;
    const std::string& value = there[values_[k]];
    if (words ? wanted.values[k] != value : number_of(wanted.values[k]) != number_of(value)) return false;
  }
  return true;
}

std::optional<Row> Answers::find(const Row& wanted) {
  const auto at = runs_.find(key_of(wanted));
  if (at == runs_.end()) return {};
  const std::vector<std::string> there = journal_->row(at->second);
  if (there.size() <= verdict_ || !same_values(wanted, there)) return {};
  Row row = wanted;
  row.outcome = there[outcome_];
  const bool stopped = row.outcome == name_of(Ended::stopped);
  if (stopped && !stops_alike_) return {};
  row.message = there[message_];
  row.simulated = number_of(there[simulated_]);
  row.verdict = named_cell<Word>(there[verdict_], "verdict", journal_->file());
  if (row.outcome != name_of(Ended::done) && !stopped) return row;
  const bool empty = std::ranges::all_of(quantities_, [&](std::size_t k) { return there[k].empty(); });
  if (stopped && empty) return {};  // of a version that kept no quantities of stopped runs
  for (const std::size_t k : quantities_) row.quantities.push_back(there[k].empty() ? std::nan("") : number_of(there[k]));
  plan_.score(row);
  return row;
}

Executor remembering(Executor executor, std::vector<Answers>& answers, std::uint64_t* taken) {
  return [executor = std::move(executor), &answers, taken](const Work& work, std::atomic<bool>& stop) {
    Remembering jobs(work, answers, taken);
    const Work between{.next = [&] { return jobs.next(); },
                       .begin = work.begin,
                       .end = [&](std::vector<Row>&& rows) { jobs.end(std::move(rows)); }};
    return executor(between, stop);
  };
}

}  // namespace gaitlab::studies
