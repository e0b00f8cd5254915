#include "app/shell/program.h"

#include <fcntl.h>
#include <malloc.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <system_error>

#include "app/app.h"
#include "app/shell/command_line.h"
#include "app/shell/commands.h"
#include "core/errors.h"
#include "core/settings/shell_word.h"

namespace gaitlab::app {

namespace {

/// Opens closed standard streams on /dev/null. Otherwise the next file to be opened would get the number of a standard stream,
/// and output would be written into that file. Writing to the opened streams fails, as it does on closed ones.
void hold_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(stream, F_GETFD) < 0 && errno == EBADF) (void)::open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
  }
}

/// Keeps up to 64 MB of freed memory in the process. A rollout allocates arrays of some MB and frees them again. By default
/// glibc returns them to the system each time, and the page faults of the next rollout take 60 % of the time of short ones.
void keep_freed_memory() {
#ifdef __GLIBC__
  mallopt(M_TRIM_THRESHOLD, 64 << 20);
  mallopt(M_TOP_PAD, 1 << 20);
  mallopt(M_MMAP_THRESHOLD, 4 << 20);  // longer blocks, such as traces, are still returned
#endif
}

/// Group of a command in the help.
struct GroupedCommand {
  const char *name, *group;
};
constexpr const char* kSimulate = "Run a gait";
constexpr const char* kLookUp = "Look up";
constexpr const char* kCompare = "Compare and draw";
constexpr const char* kMany = "Many runs";
constexpr const char* kKeep = "Keep results, extend";
constexpr GroupedCommand kGrouped[] = {
    {"run", kSimulate},      {"watch", kSimulate},   {"report", kSimulate}, {"check", kSimulate}, {"remedy", kSimulate},
    {"rerun", kSimulate},    {"demo", kSimulate},    {"list", kLookUp},     {"explain", kLookUp}, {"schema", kLookUp},
    {"completion", kLookUp}, {"compare", kCompare},  {"swap", kCompare},    {"figure", kCompare}, {"export", kCompare},
    {"dynamics", kCompare},  {"converge", kCompare}, {"sweep", kMany},      {"optimize", kMany},  {"evaluate", kMany},
    {"study", kMany},        {"approve", kKeep},     {"test", kKeep},       {"new", kKeep}};

/// Puts the commands of the program into groups. Commands without a group are hidden.
void group(CLI::App& app) {
  for (CLI::App* command : app.get_subcommands({})) {
    const auto* const one = std::ranges::find(kGrouped, command->get_name(), &GroupedCommand::name);
    if (one != std::end(kGrouped)) command->group(one->group);
  }
}

}  // namespace

// Parts are not formatted with fmt, because nothing may throw here.
void say_error(const char* before, const char* text, const char* remark) {
  for (const char* part : {before, text, remark, "\n"}) say(part);
}

int guarded(const std::function<int()>& command, void (*tell)(const char* before, const char* text, const char* remark)) {
  constexpr const char* kError = "gaitlab: error: ";
  hold_streams();
  try {
    return command();
  } catch (const InputError& error) {
    tell("", error.what(), "");
    return 2;
  } catch (const RunError& error) {
    tell(kError, error.what(), "");
  } catch (const std::system_error& error) {  // thrown by fmt when it cannot write to standard output
    tell(kError, error.what(), "");
  } catch (const std::bad_alloc&) {
    tell(kError, "out of memory", "");
  } catch (const std::exception& error) {
    tell(kError, error.what(), " (this is a defect of gaitlab: please report it)");
  }
  return 1;
}

int program(std::span<void (*const)(Commands&)> known, int argc, char** argv) {
  keep_freed_memory();
  CLI::App app{"gaitlab: a gait lab for modular robots", "gaitlab"};
  app.require_subcommand(1);
  app.set_version_flag("--version", [] { return version(); });
  Commands commands{app};
  for (int k = 1; k < argc; ++k) typed() += " " + shell_word(argv[k]);
  for (const auto add : known) add(commands);
  group(app);
  const int code = read_command_line(app, {argv + std::min(argc, 1), argv + argc}) ? commands.chosen() : 0;
  const bool all_out = std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
  if (!all_out && code == 0) throw RunError("standard output cannot be written");
  return code;
}

}  // namespace gaitlab::app
