#include "studies/study/method.h"

#include <fmt/format.h>

#include <vector>

namespace gaitlab::studies {

std::string methods_text() {
  std::string text;
  for (const auto& row : enum_table<Method>()) text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", row.text, row.about);
  return text;
}

std::string searches_text(bool several) {
  std::vector<std::string> names;
  for (const auto& row : enum_table<Method>()) {
    if (row.searches && row.several == several) names.emplace_back(row.text);
  }
  const std::string last = names.back();
  names.pop_back();
  return names.empty() ? last : fmt::format("{} or {}", fmt::join(names, ", "), last);
}

}  // namespace gaitlab::studies
