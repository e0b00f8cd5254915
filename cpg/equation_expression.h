// The grammar of `equations`: a text to a tree. What the names in it mean is not the business of the parser.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

namespace gaitlab::cpg {

/// A node of the tree. An operator is a call by its sign ("+" ... "!=", "and", "or", "not", "^", and "~" for a minus before its
/// operand).
struct Term {
  enum class Kind { number, name, call, sum } kind = Kind::number;
  enum class Index { none, i, j, ij };
  std::size_t offset = 0;  ///< in the text, bytes
  std::string name = {};   ///< name, call
  Index index = Index::none;
  double number = 0;
  std::vector<Term> arguments = {};  ///< call; sum: the one summed term
};

/// What is wrong with a text, and where.
struct EquationFault {
  std::size_t offset;
  std::string what;
};

inline constexpr std::size_t kMostEquationText = 4000;  ///< bytes
inline constexpr std::size_t kMostEquationTerms = 500;  ///< nodes of a tree
inline constexpr std::size_t kMostEquationLevels = 64;  ///< brackets, signs and powers within one another

/// The tree of a whole text. Throws EquationFault.
///
///     expression := conjunction { "or" conjunction }
///     conjunction := negation { "and" negation }
///     negation := "not" negation | comparison
///     comparison := addition [ ("<" | "<=" | ">" | ">=" | "==" | "!=") addition ]
///     addition := product { ("+" | "-") product }
///     product := factor { ("*" | "/") factor }
///     factor := ("-" | "+") factor | primary [ "^" factor ]
///     primary := NUMBER | NAME [ "[" ("i" | "j" | "i" "," "j") "]" ] | NAME "(" expression { "," expression } ")"
///              | "sum" "(" "j" "in" "neighbours" "," expression ")" | "(" expression ")"
Term parse_equation(const std::string& text);

}  // namespace gaitlab::cpg
