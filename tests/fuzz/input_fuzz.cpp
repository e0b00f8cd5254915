// Fuzz target of libFuzzer for the reader that GAITLAB_READER selects (tests/fuzz/readers.h).
#include <cstdint>

#include "tests/fuzz/readers.h"

namespace {

const gaitlab::fuzz::Reader& chosen() {
  const char* name = std::getenv("GAITLAB_READER");
  for (const gaitlab::fuzz::Reader& reader : gaitlab::fuzz::kReaders) {
    if (name != nullptr && reader.name == name) return reader;
  }
  std::fprintf(stderr, "GAITLAB_READER names no reader; expected one of\n");
  for (const gaitlab::fuzz::Reader& reader : gaitlab::fuzz::kReaders)
    std::fprintf(stderr, "  %.*s\n", static_cast<int>(reader.name.size()), reader.name.data());
  std::exit(2);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const gaitlab::fuzz::Reader& reader = chosen();
  gaitlab::fuzz::take(reader, {reinterpret_cast<const char*>(data), size});
  return 0;
}
