#include "python/native/apart.h"

#include <pthread.h>
#include <pybind11/pybind11.h>
#include <unistd.h>

#include <algorithm>
#include <cfenv>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <set>
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
  [[nodiscard]] std::exception_ptr thrown() const { return thrown_; }  ///< to be called after the end

 private:
  std::mutex mutex_;
  std::condition_variable ended_;
  bool over_ = false;
  std::exception_ptr thrown_;
  std::thread thread_;
};

/// Works under way, each with its flag, and the end of the interpreter. A thread that asks for the interpreter's lock after
/// that end is unwound by Python, which C++ does not survive.
struct Works {
  std::mutex mutex;
  std::condition_variable left;
  std::set<std::atomic<bool>*> stops;
  bool over = false;     ///< true from the beginning of that end
  std::thread::id last;  ///< the thread that ends the interpreter
};
Works& works() {
  static auto* const made = new Works;  // never destroyed: threads may be in it at exit
  return *made;
}

/// A work under way, without the interpreter's lock. After the end of the interpreter, its thread waits for the end of the
/// process.
class UnderWay {
 public:
  explicit UnderWay(std::atomic<bool>& stop) : stop_(&stop) {
    std::unique_lock lock(works().mutex);
    if (ended()) wait_for_ever(lock);
    works().stops.insert(stop_);
  }
  ~UnderWay() {
    std::unique_lock lock(works().mutex);
    works().stops.erase(stop_);
    works().left.notify_all();
    if (ended()) wait_for_ever(lock);
  }
  UnderWay(const UnderWay&) = delete;
  UnderWay& operator=(const UnderWay&) = delete;

 private:
  static bool ended() { return works().over && works().last != std::this_thread::get_id(); }
  [[noreturn]] static void wait_for_ever(std::unique_lock<std::mutex>& lock) {
    lock.unlock();
    for (;;) ::pause();
  }
  std::atomic<bool>* stop_;
};

constexpr std::chrono::milliseconds kOften{50};  // time between checks for Ctrl-C

/// Ends all works. Called with the interpreter's lock, when the end of the interpreter begins.
void end_works() {
  const py::gil_scoped_release released;
  Works& all = works();
  std::unique_lock lock(all.mutex);
  all.over = true;
  all.last = std::this_thread::get_id();
  for (std::atomic<bool>* stop : all.stops) *stop = true;
  while (!all.left.wait_for(lock, kOften, [&] { return all.stops.empty(); })) {
    lock.unlock();
    {
      const py::gil_scoped_acquire held;
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    }
    lock.lock();
  }
}

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
  std::exception_ptr raised;
  std::exception_ptr thrown;
  {
    const py::gil_scoped_release released;
    const UnderWay under_way(stop);
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

void end_with_interpreter() {
  py::module_::import("atexit").attr("register")(py::cpp_function(&end_works));
  // The child of a fork has none of the other threads.
  ::pthread_atfork([] { works().mutex.lock(); }, [] { works().mutex.unlock(); },
                   [] {
                     works().stops.clear();
                     works().mutex.unlock();
                   });
}

void gather_said() { say_to(&hear); }

std::vector<std::string> take_said() {
  const std::lock_guard lock(said_mutex);
  return std::exchange(said(), {});
}

void share_h5() { guard_h5({&enter_h5, &leave_h5}); }

}  // namespace gaitlab::python
