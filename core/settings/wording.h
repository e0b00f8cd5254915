// Words for messages: names, and numbers in a notation that does not depend on the locale.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "core/errors.h"
#include "core/plugin/fields.h"

namespace gaitlab {

/// The shortest text that is read back as the same double. It does not depend on the locale.
std::string number_text(double value);
/// Number with its unit, as in `25 Hz`.
std::string with_unit(double value, const std::string& unit);
/// A range in words, such as `0 to 20 Hz`, `at least 0 s` or `more than 0 s`. Empty if all numbers are allowed.
std::string range_text(const Spec& spec);

/// Unit of a number in a message, as in ` in Hz`. Empty without a unit.
std::string in_unit(const Spec& spec);
/// Hint for a number beyond its range, such as `; 180 degrees are 3.142 rad`. Empty if the unit is not rad, or if the value is
/// not plausible as degrees.
std::string in_degrees(double value, const std::string& unit);
/// Number with a noun in singular or plural, as in `1 number` and `2 numbers`.
std::string counted(std::size_t n, const std::string& what);

/// The text without control characters, shortened for a message.
std::string clipped(const std::string& text);
/// The clipped() text in single quotes.
std::string in_quotes(const std::string& text);
/// List such as `a, b, c`, shortened if it is long.
std::string joined(const std::vector<std::string>& names);
/// The text in lines of at most `width` characters, broken at blanks, each after `indent` blanks. Lines that begin with four
/// blanks (equations, YAML) are not joined. If such a line is too long, its rest is indented by eight more blanks. If two or
/// more blanks divide the line into cells, the rest is instead placed below the last cell, together with the following lines
/// that begin there.
std::string wrapped(const std::string& text, std::size_t indent = 0, std::size_t width = 80);
/// Rows of cells as lines, each after `indent` blanks. The first cell is flush left, and the others are flush right. Every
/// column is as wide as its widest cell. All rows have as many cells as the first row.
std::string aligned(const std::vector<std::vector<std::string>>& rows, std::size_t indent = 0);
/// End of a message about an unknown name: `; did you mean 'x'?` or `; known KIND: a, b, c`.
std::string offer(const std::string& found, const std::vector<std::string>& known, const std::string& kind);
/// Noun for a kind of name, such as `joint` or `body`.
const char* noun(Among among);
std::vector<std::string> to_strings(std::span<const char* const> names);

/// Adds the problems of an error to `problems`.
void add_all(const InputError& error, Problems& problems);

/// True if a text has 1 to 100 bytes, all of them letters, digits or characters of `also`.
bool is_name(const std::string& text, const std::string& also);

}  // namespace gaitlab
