#include "core/recording/trace.h"

#include <fmt/format.h>

namespace gaitlab {

namespace {

constexpr std::string_view kWords = "2-";  // prefix of format 2; a hash of format 1 has only 16 digits

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

bool is_hash(std::string_view text, const Trace& trace) {
  if (text.starts_with(kWords)) return text == hash(trace);
  std::uint64_t state = fnv1a(joined_names(trace));
  each_part(trace.values, [&](std::string_view bytes) { state = fnv1a(bytes, state); });
  return text == fmt::format("{:016x}", state);
}

}  // namespace gaitlab
