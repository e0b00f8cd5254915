// The program `gaitlab-mpi`, which runs the studies of `gaitlab` in several processes started by mpirun. All processes read the
// same files. Process 0 (rank 0) chooses the runs, writes the journal and also simulates. The others simulate the packs of runs
// that process 0 sends and return rows. If a process dies, all end; completed runs are in the journal.
#include <mpi.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <future>
#include <mutex>
#include <set>
#include <thread>

#include "app/shell/program.h"
#include "app/study/study_run.h"
#include "core/build_id.h"
#include "core/errors.h"
#include "core/files/hash.h"
#include "studies/journal/study_folder.h"
#include "studies/plan/definition.h"
#include "studies/run/parcel.h"

namespace {

using namespace gaitlab;
using namespace gaitlab::studies;

enum Tag : int {
  kHello = 1,
  kRows,
  kJobs,
  kOver,
  kBye
};  // messages to rank 0: kHello, kRows (also requests more jobs), kBye (with the reason why the process ended)
constexpr std::chrono::microseconds kOften{200};  // time between polls; a blocking MPI call would occupy a processor

struct Message {
  int rank = 0, tag = 0;
  Bytes bytes;
};

Bytes bytes_of(const std::string& text) { return {text.begin(), text.end()}; }
std::string text_of(const Bytes& bytes) { return {bytes.begin(), bytes.end()}; }

void send(int rank, Tag tag, const Bytes& bytes) {
  MPI_Send(bytes.data(), static_cast<int>(bytes.size()), MPI_BYTE, rank, tag, MPI_COMM_WORLD);
}

std::optional<Message> received() {
  MPI_Status status;
  int there = 0;
  MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &there, &status);
  if (there == 0) return {};
  int size = 0;
  MPI_Get_count(&status, MPI_BYTE, &size);
  Message message{status.MPI_SOURCE, status.MPI_TAG, Bytes(static_cast<std::size_t>(size))};
  MPI_Recv(message.bytes.data(), size, MPI_BYTE, message.rank, message.tag, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  return message;
}

/// Four lines: host, study, scenario and build. The last three must be equal in all processes.
std::string hello(const Plan& plan) {
  const JournalHead head = journal_head(plan);
  return host() + "\n" + hash128(head.definition) + "\n" + hash128(head.scenario) + "\n" + build_id();
}

std::size_t pack_size(const BatchSettings& settings) {
  constexpr std::size_t kLanes = 8;  // largest number of lanes of any engine
  return static_cast<std::size_t>(settings.threads) * (settings.lanes > 0 ? settings.lanes : kLanes);
}

/// Simulates jobs and returns their rows in the order of their numbers. Nothing if `stop` was set.
std::optional<std::vector<Row>> done(const Executor& local, std::vector<Job> jobs, std::atomic<bool>& stop) {
  std::vector<Row> all;
  std::mutex mutex;
  std::size_t at = 0;
  const Work work{.next = [&] { return at < jobs.size() ? std::optional(std::move(jobs[at++])) : std::nullopt; },
                  .begin = [](std::span<const std::uint64_t>) {},
                  .end =
                      [&](std::vector<Row>&& rows) {
                        const std::lock_guard lock(mutex);
                        std::ranges::move(rows, std::back_inserter(all));
                      }};
  if (!local(work, stop)) return {};
  std::ranges::sort(all, {}, &Row::run);
  return all;
}

/// Packs of jobs of `work`, which two threads take.
class Packs {
 public:
  Packs(const Work& work, std::size_t size, const std::atomic<bool>& stop) : work_(work), size_(size), stop_(stop) {}

  /// The next jobs; none at the end or if `stop` was set.
  std::vector<Job> take() {
    const std::lock_guard lock(mutex_);
    std::vector<Job> jobs;
    std::vector<std::uint64_t> runs;
    while (jobs.size() < size_ && !stop_) {
      std::optional<Job> job = work_.next();
      if (!job) break;
      runs.push_back(job->row.run);
      jobs.push_back(std::move(*job));
    }
    if (!jobs.empty()) work_.begin(runs);
    return jobs;
  }

 private:
  const Work& work_;
  std::size_t size_;
  const std::atomic<bool>& stop_;
  std::mutex mutex_;
};

/// The other processes, as seen by rank 0.
class Others {
 public:
  explicit Others(int size) : left_(static_cast<std::size_t>(size), true) { left_[0] = false; }

  /// Checks that all processes have read the same files and have the same build as rank 0. Throws InputError otherwise.
  void greet(const Plan& plan) {
    const std::vector<std::string> own = lines(hello(plan));
    for (auto waits = std::ranges::count(left_, true); waits > 0;) {
      const std::optional<Message> message = next();
      if (message && message->tag == kBye) throw RunError("rank " + std::to_string(message->rank) + " was stopped");
      if (!message || message->tag != kHello) continue;
      --waits;
      const std::vector<std::string> other = lines(text_of(message->bytes));
      constexpr std::array<const char*, 3> kWhat{"another study", "another scenario", "another build of the program"};
      for (std::size_t k = 1; k < own.size(); ++k) {
        if (other[k] != own[k]) {
          throw InputError(SourceLocation{"gaitlab-mpi"}, "rank " + std::to_string(message->rank) + " on " + other[0] +
                                                              " has " + kWhat[k - 1] + " than rank 0 on " + own[0] +
                                                              "; expected the same files and the same program everywhere");
        }
      }
    }
  }

  /// Simulates all jobs of `work` in all processes. It has the effect of a call of an Executor.
  bool lead(const Executor& local, std::size_t pack, const Work& work, std::atomic<bool>& stop) {
    Packs packs(work, pack, stop);
    std::future<void> own = std::async(std::launch::async, [&] {
      try {
        for (std::vector<Job> jobs = packs.take(); !jobs.empty() && !stop; jobs = packs.take()) {
          if (std::optional<std::vector<Row>> rows = done(local, std::move(jobs), stop)) work.end(std::move(*rows));
        }
      } catch (...) {
        stop = true;
        throw;
      }
    });
    std::set<int> busy;  // ranks that simulate a pack
    bool more = true;
    try {
      while (!stop && (more || !busy.empty() || own.wait_for(std::chrono::seconds(0)) != std::future_status::ready)) {
        for (; more && !idle_.empty(); idle_.pop_back()) {
          const std::vector<Job> jobs = packs.take();
          more = !jobs.empty();
          if (!more) break;
          busy.insert(idle_.back());
          send(idle_.back(), kJobs, packed(jobs));
        }
        const std::optional<Message> message = next();
        if (!message) continue;
        busy.erase(message->rank);
        if (message->tag == kBye) stop = true;
        if (message->tag != kRows) continue;
        idle_.push_back(message->rank);
        if (!message->bytes.empty()) work.end(rows_of(message->bytes));  // otherwise the process has just started
      }
    } catch (...) {
      stop = true;
      own.wait();
      throw;
    }
    own.get();
    if (stop) recall(busy);
    return !stop;
  }

  /// Tells the remaining processes to end.
  void dismiss() {
    for (std::size_t rank = 0; rank < left_.size(); ++rank) {
      if (left_[rank]) send(static_cast<int>(rank), kOver, {});
    }
    while (std::ranges::count(left_, true) > 0) {
      const std::optional<Message> message = received();
      if (message && message->tag == kBye) left_[static_cast<std::size_t>(message->rank)] = false;
      if (!message) std::this_thread::sleep_for(kOften);
    }
  }

 private:
  /// Stops the processes that simulate packs. Throws RunError if one does not answer because it has died, so that mpirun stops
  /// the others. The runs of that process's pack keep their count of starts.
  void recall(std::set<int> busy) {
    constexpr std::chrono::milliseconds kPatience{700};  // mpirun kills the processes 1 s after its SIGTERM
    for (const int rank : busy) send(rank, kOver, {});
    const auto since = std::chrono::steady_clock::now();
    while (!busy.empty() && std::chrono::steady_clock::now() - since < kPatience) {
      if (const std::optional<Message> message = next()) busy.erase(message->rank);
    }
    if (busy.empty()) return;
    for (const int rank : busy) left_[static_cast<std::size_t>(rank)] = false;
    throw RunError(
        "rank " + std::to_string(*busy.begin()) +
        " does not answer any more; runs that have ended are in the journal, and the same command continues the study");
  }

  static std::vector<std::string> lines(const std::string& text) {
    std::vector<std::string> all(1);
    for (const char c : text) c == '\n' ? all.emplace_back() : all.back().append(1, c);
    return all;
  }

  /// The next message, or nothing. A message kBye means that its process was stopped. If a process ended because of an error,
  /// throws InputError or RunError with its message, according to its exit code.
  std::optional<Message> next() {
    std::optional<Message> message = received();
    if (!message) std::this_thread::sleep_for(kOften);
    if (!message || message->tag != kBye) return message;
    left_[static_cast<std::size_t>(message->rank)] = false;
    std::string why = text_of(message->bytes);
    if (why.size() < 2) return message;
    const bool bad_input = why.front() == '2';
    why.erase(0, 1);
    const std::string rank = "rank " + std::to_string(message->rank);
    if (bad_input) throw InputError(SourceLocation{rank}, why);
    throw RunError(rank + ": " + why);
  }

  std::vector<bool> left_;  ///< true for each rank that has not ended
  std::vector<int> idle_;   ///< ranks that have requested jobs
};

/// Thrown in a process other than rank 0 when its work is complete.
struct Served {};

/// Simulates the jobs that rank 0 sends, until there are none.
[[noreturn]] void serve(const Plan& plan, const BatchSettings& settings, const Measure& measure) {
  const app::StopOnSignal signals(app::StopOnSignal::Second::ends_the_process);
  std::atomic<bool>& stop = app::stopped();
  const Executor local = local_executor(plan, settings, measure);
  send(0, kHello, bytes_of(hello(plan)));
  send(0, kRows, {});
  std::future<std::optional<std::vector<Row>>> pack;
  while (!stop || pack.valid()) {
    const std::optional<Message> message = received();
    if (message && message->tag == kOver) stop = true;
    if (message && message->tag == kJobs)
      pack = std::async(std::launch::async, [&, bytes = message->bytes] { return done(local, jobs_of(bytes), stop); });
    if (!pack.valid()) {
      std::this_thread::sleep_for(kOften);
    } else if (pack.wait_for(kOften) == std::future_status::ready) {
      if (const std::optional<std::vector<Row>> rows = pack.get()) send(0, kRows, packed(*rows));
    }
  }
  throw Served();
}

std::string said;  ///< text of the error, sent to rank 0, which prints it after `gaitlab: error: `

}  // namespace

int main(int argc, char** argv) {
  int provided = 0;
  int rank = 0;
  int size = 1;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  std::signal(SIGXFSZ, SIG_IGN);  // as in main.cpp
  constexpr void (*kCommands[])(app::Commands&) = {app::add_sweep, app::add_optimize, app::add_evaluate};
  const auto run = [&] { return app::program(kCommands, argc, argv); };
  int code = 0;
  if (rank == 0) {
    Others others(size);
    if (size > 1) {
      app::team() = [&others](const Plan& plan, const BatchSettings& settings, Measure measure) -> Executor {
        others.greet(plan);
        return [&others, pack = pack_size(settings), local = local_executor(plan, settings, std::move(measure))](
                   const Work& work, std::atomic<bool>& stop) { return others.lead(local, pack, work, stop); };
      };
    }
    code = app::guarded(run);
    others.dismiss();
  } else {
    if (std::freopen("/dev/null", "w", stdout) == nullptr) return 1;
    app::team() = [](const Plan& plan, const BatchSettings& settings, const Measure& measure) -> Executor {
      serve(plan, settings, measure);
    };
    try {
      code = app::guarded(run, [](const char*, const char* text, const char* remark) { said = std::string(text) + remark; });
    } catch (const Served&) {
    }
    send(0, kBye, bytes_of(std::to_string(code) + said));
    code = 0;  // mpirun returns the exit code of rank 0
  }
  MPI_Finalize();
  return code;
}
