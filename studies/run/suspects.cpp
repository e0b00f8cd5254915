#include "studies/run/suspects.h"

#include <fmt/format.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <map>
#include <optional>
#include <system_error>
#include <utility>

#include "core/files/child_process.h"
#include "core/simulation/batch.h"

namespace gaitlab::studies {

namespace {

constexpr std::array kOwnSignals{SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGTRAP, SIGSYS};

/// True if the simulation returns with any outcome, so that it has not terminated this process.
bool try_run(const Plan& plan, std::uint64_t run, std::atomic<bool>& stop) {
  std::optional<Rollout> only = Rollout{run, plan.scenario(run)};
  const BatchStream stream{.next = [&] { return std::exchange(only, std::nullopt); }, .end = [](std::vector<RolloutEnd>&&) {}};
  return run_pulled(stream, {}, {Loads::recorded, false}, stop);
}

/// Signal by which the process terminated itself, or 0.
int own_signal(int status) {
  const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  return std::ranges::find(kOwnSignals, signal) != kOwnSignals.end() ? signal : 0;
}

pid_t begin(const Plan& plan, std::uint64_t run) {
  const pid_t child = begin_child([&] {
    std::atomic<bool> never = false;
    try {
      return try_run(plan, run, never) ? 0 : 1;
    } catch (const InputError&) {
      return 0;
    } catch (...) {
      return 1;
    }
  });
  if (child < 0)
    throw std::system_error(errno, std::generic_category(), "cannot start a process for a run that ended an earlier process");
  return child;
}

Row crashed(const Plan& plan, std::uint64_t run, int signal) {
  Row row = plan.row(run);
  row.outcome = "crashed";
  row.message = fmt::format("the process ended by signal {}", signal);
  row.verdict = Word::failed;
  return row;
}

}  // namespace

std::vector<Row> crashes_of(const Plan& plan, std::span<const std::uint64_t> runs, int jobs, const std::atomic<bool>& stop) {
  std::vector<Row> rows;
  std::map<pid_t, std::uint64_t> children;
  for (std::size_t next = 0; next < runs.size() || !children.empty();) {
    if (stop) {
      for (const auto& [child, run] : children) ::kill(child, SIGKILL);
      next = runs.size();
    }
    while (next < runs.size() && children.size() < static_cast<std::size_t>(std::max(1, jobs))) {
      const pid_t child = begin(plan, runs[next]);
      children[child] = runs[next++];
    }
    if (children.empty()) break;
    int status = 0;
    const pid_t ended = ::waitpid(-1, &status, 0);
    if (ended < 0 && errno != EINTR) break;
    if (ended < 0) continue;  // a signal interrupted the call, and may have set `stop`
    const auto at = children.find(ended);
    if (at == children.end()) continue;
    if (const int signal = own_signal(status); signal != 0) rows.push_back(crashed(plan, at->second, signal));
    children.erase(at);
  }
  std::ranges::sort(rows, {}, &Row::run);
  return rows;
}

}  // namespace gaitlab::studies
