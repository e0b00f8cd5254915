// `gaitlab completion bash`: completion of commands, options, files and names, from the declarations of the parser.
#include <fmt/format.h>

#include "app/shell/candidates.h"
#include "app/shell/commands.h"

namespace gaitlab::app {

namespace {

struct CompletionArguments {
  std::string shell;
  std::vector<std::string> words;
};

/// The function calls the program for each completion, so that it knows the names and options of the installed version. If bash
/// divides words at `=`, only the part after it is replaced.
constexpr const char* kBash = R"SH(# Completion of gaitlab in bash, printed by `gaitlab completion bash`.
_gaitlab() {
  local program=${COMP_WORDS[0]/#\~/$HOME} current=${COMP_WORDS[COMP_CWORD]} line
  COMPREPLY=()
  [[ $current != = ]] || current=
  while IFS= read -r line; do
    case $line in
      :files)
        while IFS= read -r line; do COMPREPLY+=("$line"); done < <(compgen -f -- "$current")
        compopt -o filenames 2>/dev/null
        ;;
      *=)
        COMPREPLY+=("$line")
        compopt -o nospace 2>/dev/null
        ;;
      *)
        if [[ $current != *=* && $COMP_WORDBREAKS == *=* ]]; then line=${line##*=}; fi
        COMPREPLY+=("$line")
        ;;
    esac
  done < <("$program" completion bash -- "${COMP_WORDS[@]:1:COMP_CWORD}" 2>/dev/null)
}
complete -F _gaitlab gaitlab
)SH";

int completion(const CLI::App& app, const CompletionArguments& arguments) {
  if (arguments.words.empty()) {
    fmt::print("{}", kBash);
    return 0;
  }
  const Candidates found = candidates(app, arguments.words);
  for (const std::string& word : found.words) fmt::print("{}\n", word);
  if (found.files) fmt::print(":files\n");
  return 0;
}

}  // namespace

void add_completion(Commands& commands) {
  const auto arguments = std::make_shared<CompletionArguments>();
  CLI::App* command = commands.app.add_subcommand("completion", "Print the completion of commands and names for a shell.");
  command->add_option("SHELL", arguments->shell, "bash: source <(gaitlab completion bash)")
      ->required()
      ->check(CLI::IsMember({"bash"}));
  command->add_option("WORD", arguments->words,
                      "print the possible next words instead; give the words after the program's name behind --");
  command->callback(
      [&commands, arguments] { commands.chosen = [&commands, arguments] { return completion(commands.app, *arguments); }; });
}

}  // namespace gaitlab::app
