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

/// Text of an expression, and where it stands.
struct Text {
  std::string text;
  Node node;  ///< a scalar, for places within it
};

/// What an expression may name: number of a quantity's column, or what is wrong with the name (`joint` empty: none was given).
struct Naming {
  std::optional<std::size_t> column;
  std::string wrong = {};
};
using Names = std::function<Naming(const std::string& name, const std::string& joint)>;

/// A checked expression.
class Formula {
 public:
  Formula() = default;
  /// Every fault is a problem at its place; then the formula is not to be used.
  Formula(const Text& text, const Names& names, Problems& problems);
  /// `quantities` by column; NaN where one of those it needs is not known.
  [[nodiscard]] double value(std::span<const double> quantities) const { return value(term_, quantities); }
  /// Whether the expression is a comparison by this sign.
  [[nodiscard]] bool compares(const char* sign) const {
    return term_.kind == expression::Term::Kind::call && term_.name == sign;
  }
  /// Of an operator or call: one of its operands.
  [[nodiscard]] double operand(std::size_t number, std::span<const double> quantities) const {
    return value(term_.arguments[number], quantities);
  }
  /// Whether it names this quantity, of whichever joint.
  [[nodiscard]] bool names(const std::string& quantity) const { return names(term_, quantity); }

 private:
  using Term = expression::Term;
  void check(Term& term, const Names& names, const Node& node, Problems& problems) const;
  [[nodiscard]] static double value(const Term& term, std::span<const double> quantities);
  [[nodiscard]] static bool names(const Term& term, const std::string& quantity);

  Term term_;  ///< a quantity's column stands in `number` of its name
};

/// The quantities per joint that a text names, as far as it can be read.
std::vector<std::pair<std::string, std::string>> named_joints(const std::string& text);

}  // namespace gaitlab::studies
