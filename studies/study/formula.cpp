#include "studies/study/formula.h"

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/settings/node_places.h"
#include "core/settings/wording.h"

namespace gaitlab::studies {

namespace {

void collect_joints(const expression::Term& term, std::vector<std::pair<std::string, std::string>>& found) {
  if (term.kind == expression::Term::Kind::name && !term.joint.empty()) found.emplace_back(term.name, term.joint);
  for (const expression::Term& argument : term.arguments) collect_joints(argument, found);
}

}  // namespace

Formula::Formula(const FormulaText& text, const Names& names, Problems& problems) {
  try {
    term_ = expression::parse(text.text, expression::NameSyntax::figures);
  } catch (const expression::Fault& fault) {
    add_in(text.node, fault.offset, fault.what, problems);
    return;
  }
  check(term_, names, text.node, problems);
}

void Formula::check(Term& term, const Names& names, const Node& node, Problems& problems) const {
  for (Term& argument : term.arguments) check(argument, names, node, problems);
  if (term.kind == Term::Kind::name) {
    if (term.name == "pi" && term.joint.empty()) {
      term = Term{Term::Kind::number, term.offset};
      term.number = std::numbers::pi;
      return;
    }
    const Naming naming = names(term.name, term.joint);
    if (!naming.column) add_in(node, term.offset, naming.wrong, problems);
    term.number = static_cast<double>(naming.column.value_or(0));
  }
  if (term.kind != Term::Kind::call) return;
  const expression::Function* function = expression::find_function(term.name);
  if (function == nullptr) {
    std::vector<std::string> known;
    for (const expression::Function& one : expression::functions()) known.emplace_back(one.name);
    add_in(node, term.offset, "unknown function " + in_quotes(term.name) + offer(term.name, known, "functions"), problems);
  } else if (function->arguments != term.arguments.size()) {
    add_in(
        node, term.offset,
        term.name + " takes " + counted(function->arguments, "argument") + ", found " + std::to_string(term.arguments.size()),
        problems);
  }
}

double Formula::value(const Term& term, std::span<const double> quantities) {
  if (term.kind == Term::Kind::number) return term.number;
  if (term.kind == Term::Kind::name) return quantities[static_cast<std::size_t>(term.number)];
  std::array<double, 3> operands{};
  for (std::size_t k = 0; k < term.arguments.size(); ++k) {
    operands[k] = value(term.arguments[k], quantities);
    // A comparison with NaN would be false and its negation true; the result is NaN instead.
    if (std::isnan(operands[k])) return std::numeric_limits<double>::quiet_NaN();
  }
  double result = 0;
  expression::calculate(expression::find_function(term.name)->op, 1, &result, operands.data(), &operands[1], &operands[2]);
  return result;
}

bool Formula::names(const Term& term, const std::string& quantity) {
  if (term.kind == Term::Kind::name && term.name == quantity) return true;
  for (const Term& argument : term.arguments) {
    if (names(argument, quantity)) return true;
  }
  return false;
}

std::vector<std::pair<std::string, std::string>> named_joints(const std::string& text) {
  std::vector<std::pair<std::string, std::string>> found;
  try {
    collect_joints(expression::parse(text, expression::NameSyntax::figures), found);
  } catch (const expression::Fault&) {  // the constructor of Formula reports this fault
  }
  return found;
}

}  // namespace gaitlab::studies
