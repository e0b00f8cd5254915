#include "studies/run/runner.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <new>

#include "core/errors.h"
#include "core/settings/wording.h"
#include "studies/run/suspects.h"

namespace gaitlab::studies {

namespace {

using Clock = std::chrono::steady_clock;

Brief brief(const Row& row) { return {row.run, row.outcome, row.message, row.simulated, row.score, row.verdict}; }

}  // namespace

Runner::Runner(const Plan& plan, Journal& journal, RunnerSettings settings)
    : plan_(plan),
      journal_(journal),
      settings_(std::move(settings)),
      maximize_(plan.study().objectives.front().maximize),
      present_(journal.present(plan.most_runs())),
      next_(settings_.shard.index) {
  const Shard& shard = settings_.shard;
  if (shard.index < plan.most_runs()) standing_.wanted = (plan.most_runs() - shard.index - 1) / shard.count + 1;
  journal.each_brief([&](const Brief& one) {
    if (one.run >= present_.size() || !settings_.shard.has(one.run)) return;
    standing_.add(one, maximize_);
    settings_.ended(one);
  });
  standing_.before = standing_.ended;
}

bool Runner::run(std::uint64_t end, std::atomic<bool>& stop) {
  settings_.told(standing_);
  run_suspects(end, stop);
  const Work work{.next = [this, end] { return next(end); },
                  .begin = [this](std::span<const std::uint64_t> runs) { begin(runs); },
                  .end = [this](std::vector<Row>&& rows) { write(rows); }};
  try {
    const bool whole = settings_.executor(work, stop);
    forget_stopped();
    return whole;
  } catch (const std::bad_alloc&) {
    throw RunError(
        fmt::format("{}: the memory is not enough for {}; take fewer with -j, or raise the limit (ulimit -v, a container's); "
                    "the runs that have ended are in the journal",
                    journal_.file().string(), counted(static_cast<std::size_t>(std::max(1, settings_.jobs)), "thread")));
  }
}

void Runner::run_suspects(std::uint64_t end, const std::atomic<bool>& stop) {
  constexpr std::int64_t kStarts = 2;
  std::vector<std::uint64_t> suspects;
  for (const auto& [run, starts] : journal_.unfinished()) {
    if (starts >= kStarts && run < end && !present_[run] && settings_.shard.has(run)) suspects.push_back(run);
  }
  const std::vector<Row> crashed = crashes_of(plan_, suspects, settings_.jobs, stop);
  if (!crashed.empty()) write(crashed);
  for (const Row& row : crashed) present_[row.run] = true;
}

std::optional<Job> Runner::next(std::uint64_t end) {
  for (; next_ < end; next_ += settings_.shard.count) {
    if (present_[next_]) continue;
    Job job{plan_.row(next_), plan_.sets(next_), plan_.points().scenario(next_)};
    next_ += settings_.shard.count;
    return job;
  }
  return {};
}

void Runner::begin(std::span<const std::uint64_t> runs) {
  const std::lock_guard lock(mutex_);
  journal_.count_starts(runs);
  started_[runs.front()] = {Clock::now(), utc_now(), {runs.begin(), runs.end()}};
}

void Runner::write(const std::vector<Row>& rows) {
  const std::lock_guard lock(mutex_);
  Pack pack{Clock::now(), utc_now(), {}};  // used for refused or crashed runs, which never began in this process
  if (const auto at = started_.find(rows.front().run); at != started_.end()) {
    pack = std::move(at->second);
    started_.erase(at);
  }
  const std::chrono::duration<double> wall = Clock::now() - pack.since;
  journal_.write(rows, {rows.front().run, rows.size(), std::move(pack.utc), wall.count(), host_, ::getpid()});
  for (const Row& row : rows) {
    standing_.add(brief(row), maximize_);
    settings_.ended(brief(row));
  }
  settings_.told(standing_);
}

/// Removes the counted starts of stopped runs, because they did not terminate their process.
void Runner::forget_stopped() {
  for (const auto& [first, pack] : started_) journal_.forget_starts(pack.runs);
  started_.clear();
}

void Standing::add(const Brief& run, bool maximize) {
  ++ended;
  if (run.outcome != "done") ++failed;
  if (run.verdict == Word::feasible) ++feasible;
  if (!run.score || !run.score->kept()) return;
  ++kept;
  const double value = run.score->objective();
  const bool better = !best || (maximize ? value > best->objective() : value < best->objective()) ||
                      (value == best->objective() && run.run < best_run);
  if (!better) return;
  best = run.score;
  best_run = run.run;
}

}  // namespace gaitlab::studies
