// An expression over the quantities of a run: objectives and constraints.
#pragma once
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/expression/expression.h"
#include "core/expression/functions.h"
#include "core/settings/node.h"

namespace gaitlab::studies {

/// Text of an expression, with its place.
struct Text {
  std::string text;
  Node node;  ///< a scalar, for places within it
};

/// Result of looking up a name: number of a quantity's column, or an error message (`joint` empty: none was given).
struct Naming {
  std::optional<std::size_t> column;
  std::string wrong = {};
};
using Names = std::function<Naming(const std::string& name, const std::string& joint)>;

/// A checked expression.
class Formula {
 public:
  Formula() = default;
  /// Every fault is added to the problems at its place; then the formula must not be used.
  Formula(const Text& text, const Names& names, Problems& problems);
  /// `quantities` by column; the result is NaN if one that it needs is not known.
  [[nodiscard]] double value(std::span<const double> quantities) const { return value(term_, quantities); }
  /// Whether the expression is a comparison with this sign.
  [[nodiscard]] bool compares(const char* sign) const {
    return term_.kind == expression::Term::Kind::call && term_.name == sign;
  }
  /// Value of one operand of an operator or call.
  [[nodiscard]] double operand(std::size_t number, std::span<const double> quantities) const {
    return value(term_.arguments[number], quantities);
  }
  /// Whether it contains this quantity, of any joint.
  [[nodiscard]] bool names(const std::string& quantity) const { return names(term_, quantity); }

 private:
  using Term = expression::Term;
  void check(Term& term, const Names& names, const Node& node, Problems& problems) const;
  [[nodiscard]] static double value(const Term& term, std::span<const double> quantities);
  [[nodiscard]] static bool names(const Term& term, const std::string& quantity);

  Term term_;  ///< `number` of a name is its quantity's column
};

/// Quantities per joint in a text, as far as it can be parsed.
std::vector<std::pair<std::string, std::string>> named_joints(const std::string& text);

}  // namespace gaitlab::studies
