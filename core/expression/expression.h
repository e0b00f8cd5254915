// Parser for expressions in CPG equations and in studies. It turns a text into a tree without interpreting names.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

namespace gaitlab::expression {

/// A node of the tree. An operator is a call whose name is its sign: "+" ... "!=", "and", "or", "not", "^", and "~" for a minus
/// before its operand.
struct Term {
  enum class Kind { number, name, call, sum } kind = Kind::number;
  enum class Index { none, i, j, ij };
  std::size_t offset = 0;  ///< position in the text, bytes
  std::string name = {};   ///< name of a value, function or operator
  Index index = Index::none;
  std::string joint = {};  ///< for NameSyntax::figures: text within [ ]; empty without brackets
  double number = 0;
  std::vector<Term> arguments = {};  ///< arguments of a call, or the summed term of a sum
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
enum class NameSyntax {
  joints,  ///< `phi[i]`, `w[i,j]`, `imu.roll`: values per joint and of sensors, with sums over neighbours
  figures  ///< `torque.peak[m3/active]`: names with dots, and the name of a joint in brackets
};

/// Parses a whole text into a tree. Throws Fault for an invalid text.
///
///     expression := conjunction { "or" conjunction }
///     conjunction := negation { "and" negation }
///     negation := "not" negation | comparison
///     comparison := addition [ ("<" | "<=" | ">" | ">=" | "==" | "!=") addition ]
///     addition := product { ("+" | "-") product }
///     product := factor { ("*" | "/") factor }
///     factor := ("-" | "+") factor | primary [ "^" factor ]
///     primary := NUMBER | name | NAME "(" expression { "," expression } ")" | "(" expression ")"
/// NameSyntax::joints adds the rules
///     name := NAME { "." NAME } [ "[" ("i" | "j" | "i" "," "j") "]" ]
///     primary := "sum" "(" "j" "in" "neighbours" "," expression ")"
/// and NameSyntax::figures the rule
///     name := NAME { "." NAME } [ "[" JOINT "]" ]
Term parse(const std::string& text, NameSyntax names = NameSyntax::joints);

}  // namespace gaitlab::expression
