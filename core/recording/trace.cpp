#include "core/recording/trace.h"

#include <fmt/format.h>

#include <cstdint>

namespace gaitlab {

std::size_t Trace::find(const std::string& name) const {
  std::size_t index = 0;
  while (index < columns.size() && columns[index].name != name) ++index;
  return index;
}

std::string hash(const Trace& trace) {
  std::uint64_t state = kFnvOffset;
  for (const Column& column : trace.columns) {
    state = fnv1a(column.name, state);
    state = fnv1a(std::string_view("\0", 1), state);  // so that {"ab", "c"} and {"a", "bc"} differ
  }
  const char* bytes = reinterpret_cast<const char*>(trace.values.data());
  state = fnv1a({bytes, trace.values.size() * sizeof(double)}, state);
  return fmt::format("{:016x}", state);
}

}  // namespace gaitlab
