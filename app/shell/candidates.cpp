#include "app/shell/candidates.h"

#include <algorithm>
#include <map>
#include <utility>

#include "app/look/listed_kinds.h"
#include "app/shell/command_tree.h"
#include "app/shell/commands.h"
#include "core/scenario/key_lookup.h"
#include "kit/catalog.h"

namespace gaitlab::app {

namespace {

using Words = std::vector<std::string>;

/// Joins words that the shell has split at `=`.
Words joined_words(const Words& words) {
  Words joined;
  bool behind = false;
  for (const std::string& word : words) {
    const bool equal = word == "=" && !joined.empty();
    if (equal || behind) {
      joined.back() += word;
    } else {
      joined.push_back(word);
    }
    behind = equal;
  }
  if (joined.empty()) joined.emplace_back();
  return joined;
}

/// Place on the command line: the command, and the option whose value comes next or the number of arguments before.
struct Place {
  const CLI::App* command;
  const CLI::Option* option = nullptr;
  Words arguments = {};  ///< arguments of the command, without options
  bool no_options = false;
};

const CLI::Option* option_of(const CLI::App& command, const std::string& word) {
  return word.starts_with("-") && word.size() > 1 ? command.get_option_no_throw(word.substr(0, word.find('='))) : nullptr;
}

const CLI::App* command_of(const CLI::App& command, const std::string& word) {
  for (const CLI::App* within : command.get_subcommands({})) {
    if (within->get_name() == word) return within;
  }
  return nullptr;
}

void step(Place& place, const std::string& word) {
  if (std::exchange(place.option, nullptr) != nullptr) return;  // the word is the value of the option
  if (!place.no_options && word.starts_with("-") && word.size() > 1) {
    place.no_options = word == "--";
    const CLI::Option* option = option_of(*place.command, word);
    if (option != nullptr && option->get_items_expected_max() > 0 && word.find('=') == std::string::npos) place.option = option;
    return;
  }
  const CLI::App* within = place.arguments.empty() ? command_of(*place.command, word) : nullptr;
  if (within != nullptr) {
    place.command = within;
  } else if (word != "help" || place.command->get_parent() != nullptr) {
    place.arguments.push_back(word);
  }
}

/// Values that the completion offers, by option.
std::map<const CLI::Option*, Offered>& offers() {
  static std::map<const CLI::Option*, Offered> all;
  return all;
}

/// Names of the offered kinds. The kind "" represents the kind that was typed before, or else all kinds.
Words listed_names(const Offered& offered, const Words& arguments) {
  static const Catalog catalog = kit::standard_catalog();
  Words names;
  for (const std::string& kind : offered.kinds) {
    if (const ListedKind* listed = listed_kind(kind.empty() && !arguments.empty() ? arguments.back() : kind)) {
      for (std::string& name : listed->names(catalog)) names.push_back(std::move(name));
    } else if (kind.empty() && arguments.empty()) {
      for (const ListedKind& one : listed_kinds()) names.push_back(one.name);
    }
  }
  return names;
}

/// Keys of a scenario with `=` or, after the `=`, the words that the key permits.
Words settings(const std::string& typed) {
  const std::string key = typed.substr(0, typed.find('='));
  Words found;
  for (const ScenarioKey& known : all_keys(kit::standard_catalog())) {
    if (known.path.find_first_of("[ ") != std::string::npos || known.path.find("NAME") != std::string::npos) continue;
    if (key == typed) {
      found.push_back(known.path + "=");
    } else if (known.path == key) {
      for (const std::string& word : known.row.words) found.push_back(key + "=" + word);
    }
  }
  return found;
}

/// Words that an option or argument accepts in the place of `typed`.
Candidates values(const CLI::Option& option, const Words& arguments, const std::string& typed) {
  const auto found = offers().find(&option);
  const Offered offered = found == offers().end() ? Offered() : found->second;
  if (offered.settings) return {settings(typed)};
  Candidates known{choices(option)};
  if (!known.words.empty() || is_number(option)) return known;
  known.words = listed_names(offered, arguments);
  known.files = offered.files;
  for (std::string& word : known.words) word.insert(0, offered.several ? typed.substr(0, typed.rfind(',') + 1) : "");
  return known;
}

Candidates options(const CLI::App& command) {
  Candidates known;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_snames()) known.words.push_back("-" + name);
    for (const std::string& name : option->get_lnames()) known.words.push_back("--" + name);
  }
  return known;
}

Candidates commands(const CLI::App& command) {
  Candidates known;
  for (const CLI::App* within : shown_commands(command)) known.words.push_back(within->get_name());
  if (command.get_parent() == nullptr) known.words.emplace_back("help");
  return known;
}

Candidates at_place(const Place& place, const std::string& typed) {
  if (place.option != nullptr) return values(*place.option, place.arguments, typed);
  if (!place.no_options && typed.starts_with("-")) return options(*place.command);
  if (!shown_commands(*place.command).empty()) return commands(*place.command);
  const std::vector<const CLI::Option*> all = positionals(*place.command);
  if (all.empty()) return {};
  const CLI::Option& next = *all[std::min(place.arguments.size(), all.size() - 1)];
  const bool more = place.arguments.size() < all.size() || next.get_items_expected_max() > 1;
  return more ? values(next, place.arguments, typed) : Candidates();
}

}  // namespace

CLI::Option* offering(CLI::Option* option, std::string text, const Offered& offered) {
  Words names(offered.settings ? 1 : 0, "key.path=value");
  for (const std::string& kind : offered.kinds)
    names.push_back(kind.empty() ? "`gaitlab list`" : "`gaitlab list " + kind + "`");
  for (const std::string& name : names) text.replace(text.find("{}"), 2, name);
  offers()[option] = offered;
  return option->description(std::move(text));
}

Candidates candidates(const CLI::App& app, const std::vector<std::string>& words) {
  Words before = joined_words(words);
  const std::string whole = before.back();
  before.pop_back();
  Place place{&app};
  for (const std::string& word : before) step(place, word);
  std::string head;  // `--option=`
  if (place.option == nullptr && whole.find('=') != std::string::npos) {
    place.option = option_of(*place.command, whole);
    if (place.option != nullptr) head = whole.substr(0, whole.find('=') + 1);
  }
  Candidates known = at_place(place, whole.substr(head.size()));
  for (std::string& word : known.words) word.insert(0, head);
  std::erase_if(known.words, [&](const std::string& word) { return !word.starts_with(whole); });
  std::ranges::sort(known.words);
  known.words.erase(std::unique(known.words.begin(), known.words.end()), known.words.end());
  return known;
}

}  // namespace gaitlab::app
