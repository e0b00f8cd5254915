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

/// Text of an expression, with its place in the file.
struct FormulaText {
  std::string text;
  Node node;  ///< a scalar node, from which places within the text are computed
};

/// Result of the lookup of a name: column number of a quantity, or an error message.
struct Naming {
  std::optional<std::size_t> column;
  std::string wrong = {};
};
using Names = std::function<Naming(const std::string& name, const std::string& joint)>;

/// A checked expression.
class Formula {
 public:
  Formula() = default;
  /// Adds every fault to the problems at its place. After a fault, the formula must not be used.
  Formula(const FormulaText& text, const Names& names, Problems& problems);
  /// Value of the expression for `quantities` by column. NaN if a quantity that it needs is not known.
  [[nodiscard]] double value(std::span<const double> quantities) const { return value(term_, quantities); }
  /// True if the expression is a comparison with this sign.
  [[nodiscard]] bool compares(const char* sign) const {
    return term_.kind == expression::Term::Kind::call && term_.name == sign;
  }
  /// Value of one operand of the outermost operator or call.
  [[nodiscard]] double operand(std::size_t number, std::span<const double> quantities) const {
    return value(term_.arguments[number], quantities);
  }
  /// True if the expression contains this quantity, for any joint.
  [[nodiscard]] bool names(const std::string& quantity) const { return names(term_, quantity); }

 private:
  using Term = expression::Term;
  void check(Term& term, const Names& names, const Node& node, Problems& problems) const;
  [[nodiscard]] static double value(const Term& term, std::span<const double> quantities);
  [[nodiscard]] static bool names(const Term& term, const std::string& quantity);

  Term term_;  ///< the `number` of a name is the column of its quantity
};

/// Quantities per joint in a text, as (quantity, joint), as far as the text can be parsed.
std::vector<std::pair<std::string, std::string>> named_joints(const std::string& text);

}  // namespace gaitlab::studies
