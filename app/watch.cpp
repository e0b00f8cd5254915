// `gaitlab watch`, which runs a scenario again after each change of a file that it reads, and renews the page in the browser.
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <set>
#include <sstream>
#include <thread>

#include "app/commands.h"
#include "app/program.h"
#include "app/stop_on_signal.h"
#include "core/errors.h"
#include "core/files/atomic_file.h"
#include "core/files/child_process.h"
#include "core/files/files_read.h"
#include "core/files/folder_lock.h"
#include "core/settings/wording.h"
#include "report/page/page.h"

namespace gaitlab::app {

namespace {

namespace fs = std::filesystem;
constexpr const char* kStamp =
    "stamp.svg";                        // of the run that the folder contains; the page looks at it (report/page/src/watch.ts)
constexpr const char* kRead = ".read";  // files that the run has read, as its process tells them to this one
constexpr std::uintmax_t kMostRead = 1 << 26;

struct WatchArguments : ScenarioArguments {
  std::optional<std::string> out;
  SummaryOptions shown;
};

/// Folder of the newest run: `--out`, or runs/watch-NAME. Throws InputError if it has files of something else.
fs::path watch_folder(const WatchArguments& a) {
  const fs::path folder = a.out ? fs::path(*a.out) : fs::path("runs") / ("watch-" + fs::path(a.file).stem().string());
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw InputError(SourceLocation{"--out " + folder.string()}, "cannot be made: " + error.message());
  const bool is_own = fs::exists(folder / kStamp, error) || fs::exists(folder / kRead, error) || fs::is_empty(folder, error);
  if (!is_own) {
    throw InputError(SourceLocation{"--out " + folder.string()},
                     "exists and is not a folder of gaitlab watch; expected one, or a new or empty folder");
  }
  return folder;
}

/// Runs the scenario into the folder `out`, in a process of its own: a plugin that was compiled again is loaded anew, and one
/// that crashes ends only that process. Returns the exit code of `gaitlab run`.
int run_apart(const WatchArguments& a, const fs::path& out, const fs::path& told) {
  (void)std::fflush(stdout);
  const pid_t child = begin_child([&] {
    const FilesRead reading;
    RunArguments arguments;
    static_cast<ScenarioArguments&>(arguments) = a;
    arguments.out = out.string();
    arguments.shown = a.shown;
    arguments.names_files = false;
    int code = guarded([&] { return run(arguments); }, say);
    std::string all;  // records that end with a NUL, which a path cannot contain
    for (const FileRead& one : reading.files())
      all += fmt::format("{} {} {} {}", one.stamp.modified, one.stamp.size, one.stamp.inode, one.path.string()) + '\0';
    const int wrote = guarded([&] { return write_file(told, all), 0; }, say);
    if (std::fflush(stdout) != 0 || wrote != 0) code = std::max(code, 1);
    return code;
  });
  if (child < 0) throw RunError(fmt::format("no process can be started: {}", std::generic_category().message(errno)));
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFEXITED(status)) return WEXITSTATUS(status);
  say(a.file, "error", fmt::format("the run crashed (signal {})", WTERMSIG(status)));
  return 1;
}

/// The files that the last run has read; at least the scenario.
std::vector<FileRead> files_to_watch(const WatchArguments& a, const fs::path& told) {
  std::vector<FileRead> files;
  std::error_code none;
  if (fs::exists(told, none)) {
    std::istringstream all(read_file(told, kMostRead));
    for (std::string record; std::getline(all, record, '\0');) {
      FileRead one;
      std::istringstream in(record);
      in >> one.stamp.modified >> one.stamp.size >> one.stamp.inode;
      one.path = record.substr(static_cast<std::size_t>(in.tellg()) + 1);
      files.push_back(std::move(one));
    }
  }
  fs::remove(told, none);
  if (files.empty()) files.push_back({fs::absolute(a.file, none), stamp_of(a.file)});
  return files;
}

/// Replaces the files in `folder` by those of the run in `made`, the page after its files and before its stamp.
void publish(const fs::path& made, const fs::path& folder, int run) {
  std::set<std::string> names{kStamp};
  for (const auto& file : fs::directory_iterator(made)) names.insert(file.path().filename().string());
  for (const std::string& name : names) {
    if (name != kStamp && name != kPageFile) fs::rename(made / name, folder / name);
  }
  constexpr std::uintmax_t kMostHtml = std::uintmax_t{1} << 31;
  write_file(folder / kPageFile, report::watched_page(read_file(made / kPageFile, kMostHtml), run));
  for (const auto& file : fs::directory_iterator(folder)) {
    if (file.is_regular_file() && !names.contains(file.path().filename().string())) fs::remove(file.path());
  }
  write_file(folder / kStamp, report::stamp(run, false));
  fs::remove_all(made);
}

/// Waits until one of the files has changed, and until it is not being written any more. Returns early if stopped.
void wait_for_change(const std::vector<FileRead>& files) {
  constexpr std::chrono::milliseconds kOften{100};
  const auto stamps = [&] {
    std::vector<FileStamp> all;
    for (const FileRead& file : files) all.push_back(stamp_of(file.path));
    return all;
  };
  std::vector<FileStamp> before;
  for (const FileRead& file : files) before.push_back(file.stamp);
  while (!stopped() && stamps() == before) std::this_thread::sleep_for(kOften);
  for (std::vector<FileStamp> now = stamps(); !stopped(); now = stamps()) {
    std::this_thread::sleep_for(kOften);
    if (stamps() == now) return;
  }
}

int watch(const WatchArguments& a) {
  const fs::path folder = watch_folder(a);
  const fs::path made = folder.string() + ".next";
  FolderLock lock;
  if (!lock.take(folder)) throw InputError(SourceLocation{folder.string()}, "is being written by another process");
  const StopOnSignal stop(StopOnSignal::Second::is_ignored);
  int shown = 0;  // number of the run that the folder contains
  // Numbers differ from those of an earlier process, whose page may still be open.
  constexpr int kNumbers = 16000;
  for (int number = ::getpid() % kNumbers + 1; !stopped(); ++number) {
    std::error_code none;
    fs::remove_all(made, none);
    const int code = run_apart(a, made, folder / kRead);
    const std::vector<FileRead> files = files_to_watch(a, folder / kRead);
    if (stopped()) break;
    if (code != 2 && fs::exists(made / kPageFile, none)) {
      publish(made, folder, shown = number);
    } else {
      write_file(folder / kStamp, report::stamp(shown, true));
    }
    if (!a.quiet) {
      if (shown == number) print_page(folder / kPageFile);
      say(fmt::format("{}: waiting for a change of {}; Ctrl-C ends\n", a.file, counted(files.size(), "file")));
    }
    (void)std::fflush(stdout);
    wait_for_change(files);
  }
  std::error_code none;
  fs::remove_all(made, none);
  return 0;
}

}  // namespace

void add_watch(Commands& commands) {
  add_command<WatchArguments>(commands, "watch", "Run a scenario again after each change of its files; the page follows.",
                              watch, [](CLI::App& command, WatchArguments& arguments) {
                                add_scenario(command, arguments);
                                command.add_option(
                                    "--out", arguments.out,
                                    "folder of the newest run, which replaces the one before (default runs/watch-NAME)");
                                add_shown(command, arguments.shown);
                              });
}

}  // namespace gaitlab::app
