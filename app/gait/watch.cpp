// `gaitlab watch`, which runs a scenario again after each change of a file that it reads, and renews the page in the browser.
#include <fmt/format.h>
#include <sys/wait.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <sstream>
#include <thread>

#include "app/shell/commands.h"
#include "app/shell/program.h"
#include "app/shell/stop_on_signal.h"
#include "core/errors.h"
#include "core/files/atomic_file.h"
#include "core/files/child_process.h"
#include "core/files/file_kind.h"
#include "core/files/files_read.h"
#include "core/files/folder_lock.h"
#include "core/files/part_file.h"
#include "core/settings/wording.h"
#include "report/page/page.h"

namespace gaitlab::app {

namespace {

namespace fs = std::filesystem;
constexpr const char* kStamp = "stamp.svg";  // identifies the run in the folder; the page reads it repeatedly
                                             // (report/page/src/watch.ts)
constexpr const char* kRead = ".read";       // list of the files that the run has read, written by its process
constexpr const char* kNext = ".next";       // folder of a run that has not ended
constexpr const char* kWrong = ".wrong";     // message of a run without a page, written by its process
constexpr const char* kError = "error.svg";  // this message as a picture, which the page shows
constexpr std::uintmax_t kMostRead = 1 << 26;

struct WatchArguments : ScenarioArguments {
  std::optional<std::string> out;
  SummaryOptions shown;
};

/// True for a file of a run that has not ended.
bool is_unfinished(const fs::path& file) {
  const fs::path name = file.filename();
  return name == kNext || name == kRead || name == kWrong || is_part_file(file);
}

/// Number of the run in a folder of `gaitlab watch`; 0 in a new folder, or if there is no page yet. Nothing for other folders.
std::optional<int> run_in(const fs::path& folder) {
  constexpr std::uintmax_t kMostStamp = 4096;
  std::error_code none, error;
  const fs::directory_iterator files(folder, error);
  if (!error && std::ranges::all_of(files, is_unfinished)) return 0;
  if (!fs::is_regular_file(folder / kStamp, none)) return {};
  const std::optional<int> run = report::stamped(read_file(folder / kStamp, kMostStamp));
  return run && fs::exists(folder / kPageFile, none) ? run : run ? std::optional(0) : std::nullopt;
}

/// Folder of the newest run: `--out`, or runs/watch-NAME. Throws InputError if the folder has other content.
fs::path watch_folder(const WatchArguments& a) {
  fs::path folder = a.out ? fs::path(*a.out) : fs::path("runs") / ("watch-" + fs::path(a.file).stem().string());
  const SourceLocation place{"--out " + folder.string()};
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw InputError(place, "cannot be made: " + error.message());
  if (!run_in(folder))
    throw InputError(place, "exists and is not a folder of gaitlab watch; expected such a folder, or a new or empty one");
  return folder;
}

/// Waits for the end of a child. If this process is stopped, the child is stopped, and killed after five seconds.
int wait_for_child(pid_t child) {
  constexpr std::chrono::milliseconds kOften{20};
  constexpr int kPatience = 250;
  int status = 0;
  for (int since = 0; ::waitpid(child, &status, WNOHANG) == 0; since += stopped() ? 1 : 0) {
    if (since == 1) ::kill(child, SIGTERM);
    if (since == kPatience) ::kill(child, SIGKILL);
    std::this_thread::sleep_for(kOften);
  }
  return status;
}

/// Runs the scenario into the folder kNext of `folder`, in another process, so that a recompiled plugin is loaded again and a
/// plugin that crashes ends only that process. Returns the exit code of `gaitlab run`.
int run_apart(const WatchArguments& a, const fs::path& folder) {
  (void)std::fflush(stdout);
  const pid_t child = begin_child([&] {
    const FilesRead reading;
    RunArguments arguments;
    const ScenarioArguments& scenario = a;
    static_cast<ScenarioArguments&>(arguments) = scenario;
    arguments.out = (folder / kNext).string();
    arguments.shown = a.shown;
    arguments.names_files = false;
    int code = guarded([&] {
      try {
        return run(arguments);
      } catch (const std::exception& error) {
        (void)guarded([&] { return write_file(folder / kWrong, error.what()), 0; });
        throw;
      }
    });
    std::string all;  // records that end with a NUL, which a path cannot contain
    for (const FileRead& one : reading.files())
      all += fmt::format("{} {} {} {}", one.stamp.modified, one.stamp.size, one.stamp.inode, one.path.string()) + '\0';
    const int wrote = guarded([&] { return write_file(folder / kRead, all), 0; });
    if (std::fflush(stdout) != 0 || wrote != 0) code = std::max(code, 1);
    return code;
  });
  if (child < 0) throw RunError(fmt::format("no process can be started: {}", std::generic_category().message(errno)));
  const int status = wait_for_child(child);
  if (WIFEXITED(status)) return WEXITSTATUS(status);
  const std::string crash = fmt::format("the run crashed (signal {})", WTERMSIG(status));
  if (stopped()) return 1;
  say(a.file, "error", crash);
  (void)guarded([&] { return write_file(folder / kWrong, crash), 0; });
  return 1;
}

/// The files that the last run has read. After a crash of that run, the files in `before`, in their present state.
std::vector<FileRead> files_to_watch(const WatchArguments& a, const fs::path& told, std::vector<FileRead> before) {
  std::vector<FileRead> files;
  std::error_code none;
  if (!fs::exists(told, none)) {
    if (before.empty()) before.push_back({fs::absolute(a.file, none), {}});
    for (FileRead& file : before) file.stamp = stamp_of(file.path);
    return before;
  }
  std::istringstream all(read_file(told, kMostRead));
  for (std::string record; std::getline(all, record, '\0');) {
    FileRead one;
    std::istringstream in(record);
    in >> one.stamp.modified >> one.stamp.size >> one.stamp.inode;
    one.path = record.substr(static_cast<std::size_t>(in.tellg()) + 1);
    files.push_back(std::move(one));
  }
  fs::remove(told, none);
  return files;
}

/// Moves the files of the run in `made` to `folder`, then writes the page, then its stamp. Other files stay.
void publish(const fs::path& made, const fs::path& folder, int run) {
  constexpr std::uintmax_t kMostHtml = std::uintmax_t{1} << 31;
  std::error_code error;
  for (const auto& file : fs::directory_iterator(made)) {
    const fs::path name = file.path().filename();
    if (name == kPageFile) continue;
    fs::rename(file.path(), folder / name, error);
    if (error) throw RunError(fmt::format("{}: cannot be replaced: {}", (folder / name).string(), error.message()));
  }
  write_file(folder / kPageFile, report::watched_page(read_file(made / kPageFile, kMostHtml), run));
  write_file(folder / kStamp, report::stamp(run, false));
  // The file stays: a page may look for it after a look at the stamp before.
  if (fs::exists(folder / kError, error)) write_file(folder / kError, report::picture_of(""));
}

/// Shows an error on the page of the run before it.
void publish_error(const fs::path& folder, int run) {
  constexpr std::uintmax_t kMostText = 1 << 20;
  std::error_code none;
  const bool told = fs::exists(folder / kWrong, none);
  write_file(folder / kError,
             report::picture_of(told ? read_file(folder / kWrong, kMostText) : "The terminal shows the message."));
  write_file(folder / kStamp, report::stamp(run, true));
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

/// Runs the scenario, and shows the run if it has a page, or else the error on the previous page. Returns the number of the run
/// that the folder contains.
int renew(const WatchArguments& a, const fs::path& folder, int shown) {
  const fs::path made = folder / kNext;
  std::error_code none;
  fs::remove_all(made, none);
  fs::remove(folder / kWrong, none);  // of a watch that was killed
  fs::create_directories(folder, none);
  const int code = run_apart(a, folder);
  const bool made_page = code != 2 && !stopped() && fs::exists(made / kPageFile, none);
  (void)guarded([&] {
    if (made_page) publish(made, folder, shown + 1);
    if (!made_page && !stopped()) publish_error(folder, shown);
    shown += made_page ? 1 : 0;
    if (made_page && !a.quiet) print_page(folder / kPageFile);
    return 0;
  });
  fs::remove_all(made, none);
  fs::remove(folder / kWrong, none);
  return shown;
}

int watch(const WatchArguments& a) {
  (void)read_file(a.file, kMostScenario + 1);  // a scenario that never existed is an error, not a reason to wait
  expect_kind(a.file, FileKind::scenario);
  const fs::path folder = watch_folder(a);
  FolderLock lock;
  if (!lock.take(folder)) throw InputError(SourceLocation{folder.string()}, "is being written by another process");
  const StopOnSignal stop(StopOnSignal::Second::is_ignored);
  std::vector<FileRead> files;
  int shown = run_in(folder).value_or(0);
  if (shown == 0) write_file(folder / kStamp, report::stamp(shown, false));  // marks the folder before it has other files
  while (!stopped()) {
    shown = renew(a, folder, shown);
    files = files_to_watch(a, folder / kRead, std::move(files));
    if (stopped()) break;
    const auto there = std::ranges::count_if(files, [](const FileRead& file) { return file.stamp != FileStamp{}; });
    if (!a.quiet) {
      say(fmt::format("{}: waiting for a change of {}; Ctrl-C ends the watch\n", a.file,
                      counted(static_cast<std::size_t>(there), "file")));
    }
    (void)std::fflush(stdout);
    wait_for_change(files);
  }
  return 0;
}

}  // namespace

void add_watch(Commands& commands) {
  add_command<WatchArguments>(commands, "watch", "Run a scenario again after each change of its files, and renew its page.",
                              watch, [](CLI::App& command, WatchArguments& arguments) {
                                add_scenario(command, arguments);
                                command.add_option(
                                    "--out", arguments.out,
                                    "folder of the newest run, which replaces the run before it (default runs/watch-NAME)");
                                add_shown(command, arguments.shown);
                              });
}

}  // namespace gaitlab::app
