// `gaitlab evaluate`, which runs points that another program requests. Requests and results are lines of JSON.
#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <csignal>
#include <deque>
#include <set>
#include <thread>

#include "app/study/asking.h"
#include "app/study/study_quantities.h"
#include "app/study/study_text.h"
#include "app/study/sweep_arguments.h"
#include "core/settings/shell_word.h"
#include "studies/run/asked.h"
#include "studies/run/question.h"
#include "studies/run/runner.h"
#include "studies/study/study_file.h"

namespace gaitlab::app {

namespace {

namespace fs = std::filesystem;
using studies::Brief;
using studies::Journal;
using studies::Question;

struct EvaluateArguments : StudyRunArguments {
  std::string file;
  std::vector<std::string> sets;
  bool as_completed = false, quiet = false;
};

/// Stops the study when the reader of standard output closes it, because the requesting program has then ended.
class WatchReader {
 public:
  ~WatchReader() {
    over_ = true;
    thread_.join();
  }
  WatchReader() = default;
  WatchReader(const WatchReader&) = delete;
  WatchReader& operator=(const WatchReader&) = delete;
  [[nodiscard]] bool gone() const { return gone_; }

 private:
  void watch() {
    constexpr int kOften = 100;  // ms between checks of the flags
    while (!over_ && !gone_) {
      pollfd output{STDOUT_FILENO, 0, 0};
      if (::poll(&output, 1, kOften) <= 0) continue;
      gone_ = true;
      stopped() = true;
    }
  }
  std::atomic<bool> over_ = false, gone_ = false;
  std::thread thread_{[this] { watch(); }};
};

/// The requests of a batch that are not answered yet, and the runs that answer them.
class Replies {
 public:
  Replies(Journal& journal, std::span<const studies::MarginGuard> guards, bool as_completed)
      : journal_(journal), guards_(guards), as_completed_(as_completed) {}

  /// Adds a run whose row is in the journal.
  void take(const Brief& run) {
    runs_[run.run / journal_.head().replicates].push_back(run);
    if (!open_.empty()) give();
  }
  void ask(Question&& question, std::uint64_t point) { open_.emplace_back(std::move(question), point); }
  [[nodiscard]] bool asked() const { return !open_.empty(); }
  /// Writes the answers that are complete: in the order of the requests or, with --as-completed, immediately.
  void give() {
    for (auto one = open_.begin(); one != open_.end();) {
      const auto runs = runs_.find(one->second);
      const bool whole = runs != runs_.end() && runs->second.size() == journal_.head().replicates;
      if (one->first.refused.empty() && !whole) {
        if (!as_completed_) return;
        ++one;
        continue;
      }
      print(one->first, one->first.refused.empty() ? &runs->second : nullptr);
      one = open_.erase(one);
    }
  }

 private:
  void print(const Question& question, std::vector<Brief>* runs) {
    if (runs != nullptr) std::ranges::sort(*runs, {}, &Brief::run);
    const std::span<const Brief> of = runs == nullptr ? std::span<const Brief>() : std::span<const Brief>(*runs);
    std::vector<std::vector<std::string>> figures;
    for (const Brief& run : of) figures.push_back(journal_.quantities(run.run));
    if (!print_line(answer(question, journal_.head(), guards_, of, figures), "completed runs are in the journal", stopped()))
      throw RunError("standard output cannot be written: its reader has closed it; completed runs are in the journal");
  }

  Journal& journal_;
  std::span<const studies::MarginGuard> guards_;
  bool as_completed_;
  std::map<std::uint64_t, std::vector<Brief>> runs_;  ///< completed runs of each point
  std::deque<std::pair<Question, std::uint64_t>> open_;
};

/// Reads the requests of the next batch, up to an empty line or the end of the input. Returns false if the input has ended.
bool read_batch(Lines& lines, const std::vector<studies::Parameter>& parameters, studies::Asked& asked, Replies& replies) {
  while (const std::optional<std::string> line = lines.next(stopped())) {
    if (line->find_first_not_of(" \t\r") == std::string::npos) return true;
    Question question = read_question(*line, {"stdin", lines.number(), 1}, parameters);
    const std::uint64_t point = question.refused.empty() ? asked.point(question.values) : 0;
    replies.ask(std::move(question), point);
  }
  return false;
}

/// Runs the points of each batch of requests and writes the answers, until the input ends or the program is stopped.
void answer(Lines& lines, studies::Plan& plan, Journal& journal, const studies::Executor& executor, Replies& replies,
            int jobs) {
  studies::Asked asked(plan, journal);
  studies::Runner runner(
      plan, journal,
      {.executor = executor, .shard = {}, .jobs = study_threads(jobs), .ended = [&](const Brief& run) { replies.take(run); }});
  for (bool more = true; more && !stopped();) {
    more = read_batch(lines, plan.study().parameters, asked, replies);
    if (stopped() || !replies.asked()) continue;
    replies.give();
    if (!replies.asked()) continue;
    journal.expect(asked.end());
    runner.run(asked.end(), stopped());
    replies.give();
  }
}

int evaluate_study(const EvaluateArguments& a) {
  refuse_copies("gaitlab evaluate");
  std::signal(SIGPIPE, SIG_IGN);  // the failed write reports the closed output instead
  Catalog catalog = standard_catalog();
  studies::Study study = studies::read_study(a.file, studies::Purpose::evaluate);
  add_sets(study, a.sets);
  study.runs = studies::kMostAsked;
  studies::Plan plan(std::move(study), quantity_offer(), catalog);
  const studies::Executor executor = study_executor(plan, a);
  warn_of_scenarios(plan);
  if (!a.quiet)
    for (const Problem& note : plan.study().notes) say(to_string(note.place), "note", note.text);
  studies::JournalHead head = study_head(plan);
  std::vector<studies::Answers> answers = other_answers(plan, a, head.build);
  head.runs = 0;  // increases with the requests
  // Installed before the folder is created, so that a signal cannot interrupt the creation.
  const StopOnSignal stop(StopOnSignal::Second::ends_the_process);
  const fs::path folder = studies::study_folder(a.out, "evaluate-" + plan.study().name, holds_study(head));
  head.command = "gaitlab evaluate " + shell_word(told_path(a.file)) + set_words(a.sets);
  for (const std::string& other : a.answers) head.command += " --answers " + shell_word(told_path(other));
  head.command += " --out " + shell_word(told_path(folder.string()));
  const studies::Lock lock(folder / "lock");
  Journal journal(folder / studies::kJournalFile, head, a.accept_build ? Journal::Build::any : Journal::Build::same);
  write_heights(plan, folder);

  const WatchReader reader;
  Replies replies(journal, plan.scorer().margins(), a.as_completed);
  Lines lines;
  answer(lines, plan, journal, remembering(executor, answers), replies, a.jobs);
  const std::uint64_t rows = journal.rows();
  const bool finished = lines.ended() && !replies.asked();  // if all requests are answered, a closed output does not matter
  if (!finished && reader.gone()) {
    throw RunError(
        fmt::format("{}: the reader of the answers has closed the output; {} runs are in the journal", folder.string(), rows));
  }
  if (!finished && stopped()) {
    say(fmt::format("{}: interrupted: {} runs are in the journal; continue with the same questions to\n{}\n", folder.string(),
                    rows, head.command));
    return 1;
  }
  if (rows > 0) write_study_files(journal, studies::results(journal), folder);
  if (!a.quiet) say(fmt::format("{}: {} runs are in the journal\n", folder.string(), rows));
  return 0;
}

}  // namespace

void add_evaluate(Commands& commands) {
  add_command<EvaluateArguments>(
      commands, "evaluate", "Run the points that another program requests, in lines of JSON.", evaluate_study,
      [](CLI::App& command, EvaluateArguments& a) {
        command.add_option("STUDY", a.file, "file of a study (YAML); its method and budget are not used")
            ->required()
            ->transform(named_file);
        add_study_sets(command, a.sets);
        add_study_run(command, a, "runs/evaluate-NAME");
        command.add_flag("--as-completed", a.as_completed,
                         "answer each question when its runs have ended, not in the order of the questions");
        command.add_flag("--quiet", a.quiet, "print only answers and errors");
      });
}

}  // namespace gaitlab::app
