// The grammar of expressions, in the equations of a CPG and in a study: a text to a tree. The parser does not interpret names.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

namespace gaitlab::expression {

/// A node of the tree. An operator is a call with its sign as the name ("+" ... "!=", "and", "or", "not", "^", and "~" for a
/// minus before its operand).
struct Term {
  enum class Kind { number, name, call, sum } kind = Kind::number;
  enum class Index { none, i, j, ij };
  std::size_t offset = 0;  ///< in the text, bytes
  std::string name = {};   ///< name, call
  Index index = Index::none;
  std::string joint = {};  ///< Names::figures: text within [ ]; empty: no brackets
  double number = 0;
  std::vector<Term> arguments = {};  ///< of a call; of a sum: the summed term
};

/// Error in a text, with its position.
struct Fault {
  std::size_t offset;
  std::string what;
};

inline constexpr std::size_t kMostText = 4000;  ///< bytes
inline constexpr std::size_t kMostTerms = 500;  ///< nodes of a tree
inline constexpr std::size_t kMostLevels = 64;  ///< nesting depth of brackets, signs and powers

/// Syntax of names.
enum class Names {
  joints,  ///< `phi[i]`, `w[i,j]`: values per joint, and sums over neighbours
  figures  ///< `torque.peak[m3/active]`: dots within, and the name of a joint
};

/// Parses a whole text into a tree. Throws Fault.
///
///     expression := conjunction { "or" conjunction }
///     conjunction := negation { "and" negation }
///     negation := "not" negation | comparison
///     comparison := addition [ ("<" | "<=" | ">" | ">=" | "==" | "!=") addition ]
///     addition := product { ("+" | "-") product }
///     product := factor { ("*" | "/") factor }
///     factor := ("-" | "+") factor | primary [ "^" factor ]
///     primary := NUMBER | name | NAME "(" expression { "," expression } ")" | "(" expression ")"
/// and with Names::joints
///     name := NAME [ "[" ("i" | "j" | "i" "," "j") "]" ]
///     primary := "sum" "(" "j" "in" "neighbours" "," expression ")"
/// or with Names::figures
///     name := NAME { "." NAME } [ "[" JOINT "]" ]
Term parse(const std::string& text, Names names = Names::joints);

}  // namespace gaitlab::expression
