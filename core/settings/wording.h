// Words of messages: names and numbers; numbers are written so that they are read back unchanged in every locale.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "core/errors.h"
#include "core/plugin/fields.h"

namespace gaitlab {

/// The shortest text that is read back as the same double; the same in every locale.
std::string number_text(double value);
/// The same with its unit: `25 Hz`.
std::string with_unit(double value, const std::string& unit);
/// A range in words: `0 to 20 Hz`, `at least 0 s`, `more than 0 s`; empty if all numbers are allowed.
std::string range_text(const Spec& spec);

/// Unit of a number in a message: ` in Hz`; empty without a unit.
std::string in_unit(const Spec& spec);
/// `2 numbers`, `1 number`.
std::string counted(std::size_t n, const std::string& what);

/// The text without control characters, shortened for a message.
std::string clipped(const std::string& text);
/// The same in single quotes.
std::string in_quotes(const std::string& text);
/// `a, b, c`, shortened if it is long.
std::string joined(const std::vector<std::string>& names);
/// The text in lines of at most `width` characters, broken at blanks, each behind `indent` blanks. Lines that begin with four
/// blanks (equations, YAML) are not joined; if one is too long, its rest is indented by eight more blanks.
std::string wrapped(const std::string& text, std::size_t indent = 0, std::size_t width = 80);
/// Rows of cells as lines, each behind `indent` blanks: the first cell flush left, the others flush right, every column as wide
/// as its widest cell. All rows have as many cells as the first.
std::string aligned(const std::vector<std::vector<std::string>>& rows, std::size_t indent = 0);
/// End of a message on an unknown name: `; did you mean 'x'?` or `; known KIND: a, b, c`.
std::string offer(const std::string& found, const std::vector<std::string>& known, const std::string& kind);
std::vector<std::string> to_strings(std::span<const char* const> names);

/// Adds the problems of an error to `problems`.
void add_all(const InputError& error, Problems& problems);

/// Whether a text consists of letters, digits and the characters of `also`; not empty, at most 100 bytes.
bool is_name(const std::string& text, const std::string& also);

}  // namespace gaitlab
