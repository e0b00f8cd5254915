#include "app/study/study_progress.h"

#include <fmt/format.h>

#include <mutex>

#include "core/errors.h"
#include "core/settings/wording.h"

namespace gaitlab::app {

struct AgainProgress::Line {
  explicit Line(bool quiet) : progress(quiet), shown(!quiet) {}
  ProgressLine progress;
  bool shown;
  std::size_t added = 0;
  std::mutex mutex;
};

AgainProgress::AgainProgress(bool quiet, std::string what) : line_(std::make_shared<Line>(quiet)), what_(std::move(what)) {}

void AgainProgress::add(std::size_t runs, std::size_t of) {
  const std::lock_guard lock(line_->mutex);
  line_->added += runs;
  show(line_->added, of);
}

void AgainProgress::operator()(std::size_t done, std::size_t of) {
  const std::lock_guard lock(line_->mutex);
  show(done, of);
}

void AgainProgress::show(std::size_t done, std::size_t of) {
  if (done == 0 && line_->shown) say(fmt::format("{}: {}\n", what_, counted(of, "run")));
  if (done == of) return line_->progress.clear();
  if (done > 0 && line_->progress.due()) {
    line_->progress.show(static_cast<double>(done) / static_cast<double>(of),
                         fmt::format("{}: {} of {}", what_, done, counted(of, "run")));
  }
}

void StudyProgress::operator()(const studies::SearchPlace& place) {
  place_ = place.searches > 1 ? fmt::format("  {} searches", place.searches) : "";
  place_ += fmt::format("  generation {}", place.generation);
  if (place.restart > 0) place_ += fmt::format(" restart {}", place.restart);
}

double StudyProgress::rate(Time now, std::uint64_t ended) {
  constexpr std::chrono::seconds kMinute{60};
  constexpr std::chrono::milliseconds kApart{100};
  if (minute_.empty() || now - minute_.back().first > kApart) minute_.emplace_back(now, ended);
  while (minute_.size() > 2 && now - minute_[1].first > kMinute) minute_.pop_front();
  const std::chrono::duration<double> since = now - minute_.front().first;
  return since.count() > 0 ? static_cast<double>(ended - minute_.front().second) / since.count() : 0;
}

void StudyProgress::operator()(const studies::Standing& s) {
  const Time now = std::chrono::steady_clock::now();
  const double runs_per_s = rate(now, s.ended);
  if (!line_.due()) return;
  std::string text = fmt::format("{}/{} runs", s.ended, s.wanted);
  const std::string left = left_.text(now, static_cast<double>(s.ended - s.before), static_cast<double>(s.wanted - s.ended));
  if (!left.empty()) text += "  " + left;
  text += place_;
  if (s.best) text += fmt::format("  best {:.4g}{} (run {})", s.best->objective(), unit_, s.best_run);
  text += fmt::format("  {} kept  {} feasible  {} failed", s.kept, s.feasible, s.failed);
  if (runs_per_s > 0) text += fmt::format("  {:.3g} runs/s", runs_per_s);
  line_.show(s.wanted == 0 ? 1 : static_cast<double>(s.ended) / static_cast<double>(s.wanted), text);
}

}  // namespace gaitlab::app
