#include "app/shell/command_line.h"

#include <fmt/format.h>

#include <algorithm>

#include "app/shell/command_tree.h"
#include "core/settings/wording.h"

namespace gaitlab::app {

namespace {

using Words = std::vector<std::string>;

[[noreturn]] void refuse(const CLI::App& command, const std::string& text) {
  throw InputError(SourceLocation{full_name(command)}, text);
}

/// The program, the chosen command, and the chosen subcommands within it, from the outermost to the innermost.
std::vector<const CLI::App*> levels(const CLI::App& app) {
  std::vector<const CLI::App*> all{&app};
  while (!all.back()->get_subcommands().empty()) all.push_back(all.back()->get_subcommands().front());
  return all;
}

/// Names of the subcommands that the help of a command shows.
Words shown_names(const CLI::App& command) {
  Words known;
  for (const CLI::App* within : shown_commands(command)) known.push_back(within->get_name());
  return known;
}

Words long_options(const CLI::App& command) {
  Words known;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
  }
  return known;
}

bool is_option(const CLI::App& command, const std::string& word) {
  const auto named = [&](const CLI::Option* option) { return word.starts_with('-') && option->check_name(word); };
  const auto options = command.get_options();
  return std::any_of(options.begin(), options.end(), named);
}

bool among(const Words& known, const std::string& name) { return std::find(known.begin(), known.end(), name) != known.end(); }

bool looks_like_option(const std::string& word) { return word.size() > 1 && word[0] == '-' && word != "--"; }

/// Description of the value that an option expects.
std::string expected(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  if (const Words list = choices(option); !list.empty()) return fmt::format("{}", fmt::join(list, " or "));
  const bool whole = type.starts_with("INT") || type.starts_with("UINT");
  const std::size_t open = type.find('[');
  const std::size_t dash = type.find(" - ", open);
  if (open == std::string::npos || dash == std::string::npos) return whole ? "a whole number" : option.get_description();
  const std::string low = type.substr(open + 1, dash - open - 1);
  const std::string high = type.substr(dash + 3, type.find(']') - dash - 3);
  return fmt::format("{} from {} to {}", whole ? "a whole number" : "a number", low, high);
}

void check_command(const CLI::App& app, const Words& words) {
  if (words.empty() || words.front().starts_with('-')) return;
  const auto all = app.get_subcommands({});
  if (std::any_of(all.begin(), all.end(), [&](const CLI::App* one) { return one->get_name() == words.front(); })) return;
  Words known = shown_names(app);
  known.push_back("help");
  refuse(app, "unknown command " + in_quotes(words.front()) + offer(words.front(), known, "commands"));
}

/// Throws InputError for words that begin with a dash and are not an option of their command.
void check_options(const std::vector<const CLI::App*>& chosen) {
  for (const CLI::App* command : chosen) {
    for (const std::string& word : command->remaining()) {
      if (!looks_like_option(word)) continue;
      const std::string name = word.substr(0, word.find('='));
      const bool later = command != chosen.back() && is_option(*chosen.back(), name);
      refuse(*command, "unknown option " + in_quotes(name) +
                           (later ? "; expected after the command: " + full_name(*chosen.back()) + " " + name
                            : is_option(*command, name) ? "; expected before --"
                                                        : offer(name, long_options(*command), "options")));
    }
  }
}

/// Throws InputError if a command requires a subcommand and none follows.
void check_within(const CLI::App& command) {
  if (command.get_require_subcommand_min() == 0 || !command.get_subcommands().empty()) return;
  const Words known = shown_names(command);
  const Words left = command.remaining();
  if (!left.empty()) refuse(command, "unknown command " + in_quotes(left.front()) + offer(left.front(), known, "commands"));
  if (command.get_parent() == nullptr) refuse(command, "a command is missing");  // all commands have just been printed
  refuse(command, fmt::format("a command is missing; expected {} and one of: {}", full_name(command), fmt::join(known, ", ")));
}

void check_missing(const CLI::App& command) {
  std::vector<const CLI::Option*> missing;
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_required() && option->count() == 0) missing.push_back(option);
    if (option->count() == 0) continue;
    for (const CLI::Option* needed : option->get_needs()) {
      if (needed->count() == 0) missing.push_back(needed);
    }
  }
  Problems problems;
  for (const CLI::Option* option : missing) {
    problems.add(SourceLocation{full_name(command)},
                 fmt::format("{} is missing: {}; expected {}", option->get_name(), option->get_description(), usage(command)));
  }
  problems.raise();
}

void check_exclusions(const CLI::App& command) {
  for (const CLI::Option* option : command.get_options()) {
    for (const CLI::Option* other : option->get_excludes()) {
      if (option->count() == 0 || other->count() == 0) continue;
      refuse(command,
             fmt::format("found {} and {} together; expected only one of them", option->get_name(), other->get_name()));
    }
  }
}

void check_extras(const CLI::App& command) {
  for (const std::string& word : command.remaining()) {
    if (word == "--") continue;
    const Words known = long_options(command);
    const std::string option = nearest("--" + word, known);
    std::string remedy;
    if (word.find('=') != std::string::npos && among(known, "--set")) remedy = "; did you mean --set " + clipped(word) + "?";
    if (remedy.empty() && !option.empty()) remedy = "; did you mean '" + option + "'?";
    refuse(command, fmt::format("found {}, one argument too many; expected {}{}", in_quotes(word), usage(command), remedy));
  }
}

/// The option that a message of the parser names: the one with the longest name in the message, or nullptr.
const CLI::Option* named_in(const CLI::App& command, const std::string& message) {
  const CLI::Option* found = nullptr;
  for (const CLI::Option* option : command.get_options()) {
    const std::string name = option->get_name();
    if (name.empty() || message.find(name) == std::string::npos) continue;
    if (found == nullptr || name.size() > found->get_name().size()) found = option;
  }
  return found;
}

/// Name of the option as the user typed it, for example -j for --jobs.
std::string as_typed(const CLI::Option& option, const Words& words) {
  for (const std::string& name : option.get_snames()) {
    if (std::any_of(words.begin(), words.end(), [&](const std::string& word) { return word.starts_with("-" + name); }))
      return "-" + name;
  }
  return option.get_name();
}

constexpr const char* kNoValue = "{} has no value{}; expected one after it: {}";

/// Throws InputError for an option whose value is missing, superfluous or of the wrong kind.
void check_value(const CLI::App& command, const Words& words, const CLI::ParseError& error) {
  const CLI::Option* option = named_in(command, error.what());
  if (option == nullptr) return;
  const std::string name = as_typed(*option, words);
  if (option->count() == 0) refuse(command, fmt::format(kNoValue, name, "", expected(*option)));
  if (error.get_name() == "ArgumentMismatch") {
    refuse(command, fmt::format("{} is given {} times; expected once", name, option->count()));
  }
  const bool empty = among(option->results(), "");
  const std::string value = empty ? "" : option->results().back();
  const std::string close = nearest(value, choices(*option));
  refuse(command, fmt::format("{} is {}; expected {}{}", name, empty ? "empty" : in_quotes(value), expected(*option),
                              close.empty() ? "" : "; did you mean '" + close + "'?"));
}

/// Throws InputError for words that the parser accepts by mistake: an option as the value of another option, and a value of a
/// flag.
void check_taken_values(const CLI::App& command) {
  for (const CLI::Option* option : command.get_options()) {
    const std::string name = option->get_name();
    const bool flag = option->get_items_expected_max() == 0;
    for (const std::string& value : option->results()) {
      if (flag && value != "true" && value != "false") {
        refuse(command, fmt::format("{} is given {}; expected no value", name, in_quotes(value)));
      }
      if (flag || option->get_positional() || !is_option(command, value)) continue;
      refuse(command, fmt::format(kNoValue, name, " but the option " + in_quotes(value), expected(*option)));
    }
  }
}

}  // namespace

bool read_command_line(CLI::App& app, std::vector<std::string> words) {
  bool help = false;
  if (words.empty()) say(app.help() + "\n");
  for (; !words.empty() && words.front() == "help"; help = true) words.erase(words.begin());
  if (help) words.emplace_back("--help");
  check_command(app, words);
  try {
    app.parse(Words(words.rbegin(), words.rend()));
  } catch (const CLI::Success& asked) {
    app.exit(asked);
    return false;
  } catch (const CLI::ParseError& error) {
    const auto chosen = levels(app);
    const CLI::App& command = *chosen.back();
    check_taken_values(command);
    check_options(chosen);
    check_within(command);
    check_exclusions(command);
    check_missing(command);
    check_extras(command);
    check_value(command, words, error);
    refuse(command, error.what());
  }
  check_taken_values(*levels(app).back());
  return true;
}

}  // namespace gaitlab::app
