#include "core/recording/trace.h"

#include <fmt/format.h>

namespace gaitlab {

std::size_t Trace::find(const std::string& name) const {
  std::size_t index = 0;
  while (index < columns.size() && columns[index].name != name) ++index;
  return index;
}

namespace {

constexpr std::string_view kWords = "2-";  // format 2; one of format 1 is 16 digits alone

std::string joined_names(const Trace& trace) {
  std::string names;
  for (const Column& column : trace.columns) names += column.name + '\0';  // so that {"ab", "c"} and {"a", "bc"} differ
  return names;
}

std::string_view bytes_of(const Trace& trace) {
  return {reinterpret_cast<const char*>(trace.values.data()), trace.values.size() * sizeof(double)};
}

}  // namespace

std::string hash(const Trace& trace) {
  WordHash words;
  words.add(joined_names(trace));
  words.add(bytes_of(trace));
  return std::string(kWords) + words.text();
}

bool is_hash(std::string_view text, const Trace& trace) {
  if (text.starts_with(kWords)) return text == hash(trace);
  return text == fmt::format("{:016x}", fnv1a(bytes_of(trace), fnv1a(joined_names(trace))));
}

}  // namespace gaitlab
