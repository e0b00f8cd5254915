// Place of an error in a JSON text.
#pragma once
#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>

#include "core/errors.h"

namespace gaitlab {

/// Line and column (in bytes, from 1) of the byte before `end`, where nlohmann's parser stopped.
inline SourceLocation json_place(const std::string& file, std::string_view text, std::size_t end) {
  const std::string_view before = text.substr(0, std::min(end == 0 ? 0 : end - 1, text.size()));
  const std::size_t line_start = before.rfind('\n') + 1;  // npos + 1 is 0
  return {file, 1 + static_cast<int>(std::count(before.begin(), before.end(), '\n')),
          1 + static_cast<int>(before.size() - line_start)};
}

}  // namespace gaitlab
