// JSON from a file that may be damaged or forged.
#pragma once
#include <nlohmann/json.hpp>
#include <string>

namespace gaitlab {

inline constexpr int kDeepestJson = 8;  ///< deeper than any file of the program

/// Parses JSON. The result is discarded if the text is not JSON, or nested deeper than any file of the program, because copies
/// of deeply nested data would overflow the stack.
inline nlohmann::ordered_json shallow_json(const std::string& text) {
  using Json = nlohmann::ordered_json;
  bool deep = false;
  Json json = Json::parse(
      text, [&](int depth, Json::parse_event_t, Json&) { return !(deep = deep || depth > kDeepestJson); }, false);
  return deep ? Json(Json::value_t::discarded) : json;
}

}  // namespace gaitlab
