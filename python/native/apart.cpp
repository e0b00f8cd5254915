#include "python/native/apart.h"

#include <pybind11/pybind11.h>

#include <algorithm>
#include <cfenv>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>
#include <utility>

#include "core/errors.h"
#include "core/recording/h5_guard.h"

namespace py = pybind11;

namespace gaitlab::python {

namespace {

/// Work in a thread, and its end.
class Worker {
 public:
  explicit Worker(const std::function<void()>& work)
      : thread_([this, &work] {
          std::fesetenv(FE_DFL_ENV);
          try {
            work();
          } catch (...) {
            thrown_ = std::current_exception();
          }
          const std::lock_guard lock(mutex_);
          over_ = true;
          ended_.notify_one();
        }) {}
  ~Worker() { thread_.join(); }
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  /// Waits for the end, but not longer than `time`. Returns true at the end.
  bool ends_in(std::chrono::milliseconds time) {
    std::unique_lock lock(mutex_);
    return ended_.wait_for(lock, time, [&] { return over_; });
  }
  [[nodiscard]] std::exception_ptr thrown() const { return thrown_; }  ///< after the end

 private:
  std::mutex mutex_;
  std::condition_variable ended_;
  bool over_ = false;
  std::exception_ptr thrown_;
  std::thread thread_;
};

std::mutex said_mutex;
std::vector<std::string>& said() {
  static auto* const texts = new std::vector<std::string>;  // never destroyed: threads may speak at exit
  return *texts;
}

/// Receives a text of say(). Control characters other than newlines are escaped, as on stderr.
void hear(std::string_view text) noexcept {
  try {
    while (text.ends_with('\n')) text.remove_suffix(1);
    std::string lines;
    for (std::size_t at = 0; at <= text.size();) {
      const std::size_t end = std::min(text.find('\n', at), text.size());
      lines += (at == 0 ? "" : "\n") + one_line(std::string(text.substr(at, end - at)));
      at = end + 1;
    }
    const std::lock_guard lock(said_mutex);
    said().push_back(std::move(lines));
  } catch (const std::bad_alloc&) {  // NOLINT(bugprone-empty-catch): a message is lost
  }
}

/// The interpreter's lock and that of h5py.
struct Locks {
  py::gil_scoped_acquire held;
  py::object phil;
};

void* enter_h5() {
  auto* const locks = new Locks;
  try {
    const py::object modules = py::module_::import("sys").attr("modules");
    if (!modules.contains("h5py._objects")) return locks;
    locks->phil = modules["h5py._objects"].attr("phil");
    locks->phil.attr("acquire")();
  } catch (py::error_already_set&) {  // an h5py without this lock
    locks->phil = py::object();
  }
  return locks;
}

void leave_h5(void* entered) {
  auto* const locks = static_cast<Locks*>(entered);
  try {
    if (locks->phil) locks->phil.attr("release")();
  } catch (py::error_already_set&) {  // NOLINT(bugprone-empty-catch)
  }
  locks->phil = py::object();  // before the lock is given up
  delete locks;
}

}  // namespace

void apart(std::atomic<bool>& stop, const std::function<void()>& told, const std::function<void()>& work) {
  constexpr std::chrono::milliseconds kOften{50};
  std::exception_ptr raised;
  std::exception_ptr thrown;
  {
    const py::gil_scoped_release released;
    Worker worker(work);
    while (!worker.ends_in(kOften)) {
      if (raised) continue;
      const py::gil_scoped_acquire held;
      try {
        if (PyErr_CheckSignals() != 0) throw py::error_already_set();
        if (told) told();
      } catch (...) {
        raised = std::current_exception();
        stop = true;
      }
    }
    thrown = worker.thrown();
  }
  if (raised) std::rethrow_exception(raised);
  if (thrown) std::rethrow_exception(thrown);
}

void apart(const std::function<void()>& work) {
  std::atomic<bool> never = false;
  apart(never, {}, work);
}

void gather_said() { say_to(&hear); }

std::vector<std::string> take_said() {
  const std::lock_guard lock(said_mutex);
  return std::exchange(said(), {});
}

void share_h5() { guard_h5({&enter_h5, &leave_h5}); }

}  // namespace gaitlab::python
