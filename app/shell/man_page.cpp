// `gaitlab man`: the manual page gaitlab(1), from the declarations of the parser.
#include <fmt/format.h>

#include <algorithm>

#include "app/shell/command_tree.h"
#include "app/shell/commands.h"
#include "core/build_id.h"

namespace gaitlab::app {

namespace {

/// Text for troff: its special characters escaped, words in backquotes in bold.
std::string troff(const std::string& text) {
  std::string out;
  bool bold = false;
  for (const char c : text) {
    if (c == '`') {
      out += (bold = !bold) ? "\\fB" : "\\fR";
    } else if (c == '\\') {
      out += "\\e";
    } else if (c == '-') {
      out += "\\-";
    } else {
      out += c;
    }
  }
  return out.starts_with(".") || out.starts_with("'") ? "\\&" + out : out;
}

/// An entry of a list: its name in bold, then its text.
std::string entry(const std::string& name, const std::string& text) {
  return fmt::format(".TP\n\\fB{}\\fR\n{}\n", troff(name), troff(text));
}

/// Names of an option, and the value that it expects: `-j, --jobs N`.
std::string option_names(const CLI::Option& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.get_snames()) names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  std::string all = fmt::format("{}", fmt::join(names, ", "));
  if (option.get_positional()) return option.get_name();
  if (option.get_items_expected_max() == 0) return all;
  const std::vector<std::string> known = choices(option);
  return all + " " + (is_number(option) ? "N" : known.empty() ? "TEXT" : fmt::format("{}", fmt::join(known, "|")));
}

std::string command_entries(const CLI::App& command) {
  std::string text = entry(usage(command), command.get_description());
  std::string options;
  for (const CLI::Option* option : command.get_options()) {
    if (!option->check_name("--help")) options += entry(option_names(*option), option->get_description());
  }
  if (!options.empty()) text += ".RS\n" + options + ".RE\n";
  for (const CLI::App* within : shown_commands(command)) text += command_entries(*within);
  return text;
}

/// The commands in the order and under the headings of the help.
std::string commands_section(const CLI::App& app) {
  std::vector<std::string> groups;
  for (const CLI::App* command : shown_commands(app)) {
    if (std::ranges::find(groups, command->get_group()) == groups.end()) groups.push_back(command->get_group());
  }
  std::string text = ".SH COMMANDS\n";
  for (const std::string& group : groups) {
    text += fmt::format(".SS \"{}\"\n", group);
    for (const CLI::App* command : shown_commands(app)) {
      if (command->get_group() == group) text += command_entries(*command);
    }
  }
  return text;
}

constexpr const char* kIntroduction =
    "The input is a scenario, a YAML file: a robot assembled from modules, its motors and controllers, its pattern generator, "
    "the "
    "ground. The program simulates it, writes a folder with the trace, a figure and a page of the moving robot, and prints a "
    "verdict on motors, docks and falls. All numbers are in SI units, angles in rad.";

std::string closing_sections() {
  std::string text = ".SH EXIT STATUS\nIf several apply, the status is the first of 2, 1, 4, 3.\n";
  text += entry("0", "success") + entry("1", "a run failed") + entry("2", "bad input");
  text += entry("3", "the verdict is not feasible, with `--fail-infeasible`");
  text += entry("4", "`test`, `rerun --verify` or `study rerun` found a difference");
  text += ".SH ENVIRONMENT\n";
  text += entry("GAITLAB_DATA", "folder of the shipped modules, robots and scenarios, for a program that is not installed");
  text += entry("NO_COLOR", "print the verdict without colour");
  text += ".SH FILES\n";
  text += entry("share/gaitlab/scenarios", "modules, robots, scenarios and studies, below the installation prefix");
  text += entry("share/doc/gaitlab/docs", "the documentation; begin with README.md");
  return text + ".SH SEE ALSO\n" +
         troff(
             "`gaitlab explain` prints the keys of a scenario, and the manual of every name that "
             "`gaitlab list` prints.") +
         "\n";
}

std::string man_page(const CLI::App& app) {
  const std::string build = build_id(), about = app.get_description();
  std::string text = fmt::format(".TH GAITLAB 1 \"\" \"gaitlab {}\" \"User Commands\"\n", build.substr(0, build.find('+')));
  text += ".SH NAME\ngaitlab \\- " + troff(about.substr(about.find(':') + 2)) + "\n";
  text += ".SH SYNOPSIS\n\\fBgaitlab\\fR \\fICOMMAND\\fR [\\fIARGUMENT\\fR...]\n.br\n\\fBgaitlab help\\fR [\\fICOMMAND\\fR]\n";
  text += fmt::format(".SH DESCRIPTION\n{}\n", troff(kIntroduction));
  return text + commands_section(app) + closing_sections();
}

}  // namespace

void add_man(Commands& commands) {
  CLI::App* command = commands.app.add_subcommand("man", "Print the manual page of the program, for man and groff.");
  command->group("");  // hides the command in the help
  command->callback([&commands] {
    commands.chosen = [&commands] {
      fmt::print("{}", man_page(commands.app));
      return 0;
    };
  });
}

}  // namespace gaitlab::app
