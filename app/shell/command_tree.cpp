#include "app/shell/command_tree.h"

#include <fmt/format.h>

#include <algorithm>

namespace gaitlab::app {

std::string full_name(const CLI::App& command) {
  return command.get_parent() == nullptr ? "gaitlab" : full_name(*command.get_parent()) + " " + command.get_name();
}

std::vector<const CLI::App*> shown_commands(const CLI::App& command) {
  std::vector<const CLI::App*> shown;
  for (const CLI::App* within : command.get_subcommands({})) {
    if (!within->get_group().empty()) shown.push_back(within);
  }
  return shown;
}

std::vector<std::string> choices(const CLI::Option& option) {
  const std::string type = option.get_type_name();  // such as TEXT:{h5,csv}
  const std::size_t open = type.find('{');
  if (open == std::string::npos) return {};
  return CLI::detail::split(type.substr(open + 1, type.find('}') - open - 1), ',');
}

bool is_number(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  return type.starts_with("INT") || type.starts_with("UINT") || type.starts_with("FLOAT");
}

std::string usage(const CLI::App& command) {
  std::string text = full_name(command);
  for (const CLI::Option* option : command.get_options()) {
    const bool place = option->get_positional();
    if (!place && !option->get_required()) continue;
    const std::vector<std::string> list = choices(*option);
    std::string part = place ? option->get_name() : fmt::format("{} {}", option->get_name(), fmt::join(list, "|"));
    if (!place && list.empty()) part += "...";
    if (place && option->get_items_expected_max() > 1) part += "...";
    text += option->get_required() ? " " + part : " [" + part + "]";
  }
  return text;
}

std::vector<const CLI::Option*> positionals(const CLI::App& command) {
  const auto place = [](const CLI::Option* option) { return option->get_positional() && !option->get_group().empty(); };
  return command.get_options(place);
}

}  // namespace gaitlab::app
