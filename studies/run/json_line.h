// A line of a protocol in JSON, which holds one object of numbers, texts, and flat lists and objects.
#pragma once
#include <nlohmann/json.hpp>
#include <string>

#include "core/errors.h"

namespace gaitlab::studies {

/// The object in a line. Throws InputError at `place` if the line holds no such object; `expected` ends the message, as in
/// `; expected {"id": 7}`.
nlohmann::json json_object(const std::string& line, const SourceLocation& place, const std::string& expected);

/// A text as JSON, with bytes that are not UTF-8 replaced.
std::string json_text(const std::string& text);
/// The shortest decimal text with the same bits; `null` for a number that is not finite.
std::string json_number(double value);

}  // namespace gaitlab::studies
