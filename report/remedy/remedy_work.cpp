#include "report/remedy/remedy_work.h"

#include <algorithm>

namespace gaitlab::report {

void RemedyWork::begin(RemedyRuns kind, const Simulated& to_come, Time now) {
  const std::lock_guard lock(mutex_);
  kind_ = kind;
  to_come_ = to_come;
  begun_ = now;
}

double RemedyWork::ended(double simulated) {
  const std::lock_guard lock(mutex_);
  const auto kind = static_cast<std::size_t>(kind_);
  done_[kind] += simulated;
  to_come_[kind] = std::max(0.0, to_come_[kind] - simulated);
  const auto work = [this](const Simulated& of) { return of[0] + ratio_ * of[1]; };
  return work(done_) / (work(done_) + work(to_come_));
}

void RemedyWork::end(Time now) {
  const std::lock_guard lock(mutex_);
  wall_[static_cast<std::size_t>(kind_)] += std::chrono::duration<double>(now - begun_).count();
  const auto cost = [this](std::size_t kind) { return done_[kind] > 0 ? wall_[kind] / done_[kind] : 0; };
  if (cost(0) > 0 && cost(1) > 0) ratio_ = cost(1) / cost(0);
}

}  // namespace gaitlab::report
