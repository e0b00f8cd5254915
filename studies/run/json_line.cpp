#include "studies/run/json_line.h"

#include <cmath>

#include "core/settings/wording.h"

namespace gaitlab::studies {

using Json = nlohmann::json;

Json json_object(const std::string& line, const SourceLocation& place, const std::string& expected) {
  constexpr int kDeep = 2;  // largest nesting depth of objects
  const auto shallow = [&](int depth, Json::parse_event_t, Json&) {
    if (depth > kDeep) throw InputError(place, "holds values within values" + expected);
    return true;
  };
  try {
    Json root = Json::parse(line, shallow);
    if (!root.is_object()) throw InputError(place, "is not a JSON object" + expected);
    return root;
  } catch (const Json::parse_error& error) {
    SourceLocation at = place;
    at.column = static_cast<int>(error.byte);
    throw InputError(at, "is not JSON" + expected);
  } catch (const Json::exception&) {  // a number exceeds the range of a double
    throw InputError(place, "holds a number that is too large" + expected);
  }
}

std::string json_text(const std::string& text) { return Json(text).dump(-1, ' ', false, Json::error_handler_t::replace); }

std::string json_number(double value) { return std::isfinite(value) ? number_text(value) : "null"; }

}  // namespace gaitlab::studies
