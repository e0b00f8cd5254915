// Scalars read strictly, before any conversion, and numbers written so that they read back the same in every locale.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/plugin/fields.h"
#include "core/scenario/node.h"

namespace gaitlab {

/// A value, or what is wrong with it as the rest of a sentence: `is 'fast'; expected a number in s`.
template <class T>
struct Reading {
  T value = {};
  std::string wrong = {};
  [[nodiscard]] bool ok() const { return wrong.empty(); }
};

/// A finite decimal number. Refused: .nan, .inf, hexadecimal, octal, leading zeros, 1_000, quotes, overflow, underflow to 0.
Reading<double> read_number(const Node& node, const std::string& unit);
Reading<std::int64_t> read_integer(const Node& node);
/// `true` or `false`, nothing else.
Reading<bool> read_flag(const Node& node);
/// Any scalar.
Reading<std::string> read_scalar(const Node& node);

/// The shortest text that reads back to the same double; the same in every locale.
std::string number_text(double value);
/// The same with its unit: `25 Hz`.
std::string with_unit(double value, const std::string& unit);
/// A range in words: `0 to 20 Hz`, `at least 0 s`, `more than 0 s`; empty where every number will do.
std::string range_text(const Spec& spec);

/// ` in Hz`, or nothing where there is no unit.
std::string in_unit(const Spec& spec);
/// `2 numbers`, `1 number`.
std::string counted(std::size_t n, const std::string& what);

/// What stands there, for a message: `'fast'`, `a list`, `empty`.
std::string found(const Node& node);
/// The text without control characters and not too long for a message.
std::string clipped(const std::string& text);
/// The same in single quotes.
std::string in_quotes(const std::string& text);
/// `a, b, c`, shortened where it is long.
std::string joined(const std::vector<std::string>& names);
/// How a message on an unknown name ends: `; did you mean 'x'?` or `; known KIND: a, b, c`.
std::string offer(const std::string& found, const std::vector<std::string>& known, const std::string& kind);
std::vector<std::string> to_strings(std::span<const char* const> names);

/// Adds what an error found to what is known already.
void add_all(const InputError& error, Problems& problems);

/// Letters, digits and the characters of `also`; not empty, at most 100 bytes.
bool is_name(const std::string& text, const std::string& also);

}  // namespace gaitlab
