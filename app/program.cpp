#include "app/program.h"

#include <algorithm>
#include <cstdio>
#include <system_error>

#include "app/command_line.h"
#include "core/errors.h"

namespace gaitlab::app {

int guarded(const std::function<int()>& command, void (*say_piece)(const char*)) {
  // Pieces, not fmt: nothing may throw any more.
  const auto say = [&](const char* before, const char* what, const char* after) {
    for (const char* text : {before, what, after}) say_piece(text);
  };
  try {
    return command();
  } catch (const InputError& error) {
    say("", error.what(), "\n");
    return 2;
  } catch (const RunError& error) {
    say("gaitlab: error: ", error.what(), "\n");
  } catch (const std::system_error& error) {  // of fmt: standard output
    say("gaitlab: error: ", error.what(), "\n");
  } catch (const std::bad_alloc&) {
    say("gaitlab: error: ", "out of memory", "\n");
  } catch (const std::exception& error) {
    say("gaitlab: error: ", error.what(), " (this is a defect of gaitlab: please report it)\n");
  }
  return 1;
}

int program(std::span<void (*const)(Commands&)> known, int argc, char** argv) {
  CLI::App app{"gaitlab: a gait lab for modular robots", "gaitlab"};
  app.require_subcommand(1);
  app.set_version_flag("--version", [] { return version(); });
  Commands commands{app};
  for (const auto add : known) add(commands);
  if (!read_command_line(app, {argv + std::min(argc, 1), argv + argc})) return 0;
  const int code = commands.chosen();
  if (std::fflush(stdout) != 0 && code == 0) throw RunError("standard output cannot be written");
  return code;
}

}  // namespace gaitlab::app
