#include "core/recording/trace.h"

#include <fmt/format.h>

namespace gaitlab {

namespace {

constexpr std::string_view kWords = "1-";  // number of the format

std::string joined_names(const Trace& trace) {
  std::string names;
  for (const Column& column : trace.columns)
    names += column.name + '\0';  // separator, so that {"ab", "c"} and {"a", "bc"} differ
  return names;
}

}  // namespace

std::string hash(const Trace& trace) {
  WordHash words;
  words.add(joined_names(trace));
  words.add_length(trace.values.size() * sizeof(double));
  each_part(trace.values, [&](std::string_view bytes) { words.add_words(bytes); });
  return std::string(kWords) + words.text();
}

}  // namespace gaitlab
