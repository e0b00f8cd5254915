// JSON from a file that may be damaged or forged.
#pragma once
#include <nlohmann/json.hpp>
#include <string>

namespace gaitlab {

/// Parses JSON. The result is discarded if the text is not JSON, or nested deeper than any file of the program, because copies
/// of deeply nested data would overflow the stack.
inline nlohmann::ordered_json shallow_json(const std::string& text) {
  using Json = nlohmann::ordered_json;
  constexpr int kDeepest = 8;
  bool deep = false;
  Json json = Json::parse(
      text, [&](int depth, Json::parse_event_t, Json&) { return !(deep = deep || depth > kDeepest); }, false);
  return deep ? Json(Json::value_t::discarded) : json;
}

}  // namespace gaitlab
