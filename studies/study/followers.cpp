#include "studies/study/followers.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/settings/wording.h"
#include "studies/study/number.h"

namespace gaitlab::studies {

namespace {

constexpr const char* kSets = " sets ";

/// The text on a single line.
std::string flat(std::string text) {
  std::ranges::replace(text, '\n', ' ');
  return text;
}

/// Names for use in expressions: the numeric parameters, by their index.
Names numbers_of(const std::vector<Parameter>& parameters) {
  return [&parameters](const std::string& name, const std::string& joint) -> Naming {
    std::vector<std::string> known;
    for (const Parameter& p : parameters) known.push_back(p.key);
    const auto at = std::ranges::find(known, name);
    if (at == known.end()) return {{}, "unknown parameter " + in_quotes(name) + offer(name, known, "parameters")};
    const auto number = static_cast<std::size_t>(at - known.begin());
    if (!joint.empty()) return {{}, in_quotes(name) + " is a number; expected it without [" + clipped(joint) + "]"};
    if (parameters[number].words) return {{}, in_quotes(name) + " is a word; expected a parameter that is a number"};
    return {number};
  };
}

}  // namespace

Followers::Followers(const std::vector<Parameter>& parameters, Problems& problems) {
  const Names names = numbers_of(parameters);
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    One& one = all_.emplace_back(One{parameters[k].key});
    for (const Follower& f : parameters[k].sets) one.sets.emplace_back(f.key, Formula(f.expression, names, problems));
  }
}

std::vector<std::pair<std::string, std::string>> Followers::settings(const std::vector<std::string>& values) const {
  std::vector<double> numbers;
  // Words become 0 and are not used in expressions.
  for (const std::string& value : values) numbers.push_back(number_of(value));
  std::vector<std::pair<std::string, std::string>> settings;
  for (std::size_t k = 0; k < all_.size(); ++k) {
    if (all_[k].sets.empty()) settings.emplace_back(all_[k].key, values[k]);
    for (const auto& [key, formula] : all_[k].sets) settings.emplace_back(key, number_text(formula.value(numbers) + 0.0));
  }
  return settings;
}

std::string followers_text(const Parameter& parameter) {
  std::string text;
  for (const Follower& f : parameter.sets)
    text += fmt::format("{}{}{}: {}\n", parameter.key, kSets, f.key, flat(f.expression.text));
  return text;
}

void read_followers(std::vector<Parameter>& parameters, const std::string& definition) {
  for (std::size_t at = 0; at < definition.size();) {
    const std::size_t end = std::min(definition.find('\n', at), definition.size());
    const std::string line = definition.substr(at, end - at);
    at = end + 1;
    for (Parameter& p : parameters) {
      const std::string begins = p.key + kSets;
      const std::size_t colon = line.find(": ");
      if (!line.starts_with(begins) || colon == std::string::npos || colon < begins.size()) continue;
      p.sets.push_back({line.substr(begins.size(), colon - begins.size()), {line.substr(colon + 2), {}}, {}});
    }
  }
}

}  // namespace gaitlab::studies
