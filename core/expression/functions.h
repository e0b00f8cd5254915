// Operators and functions of expressions, applied to many values at once.
#pragma once
#include <cstddef>
#include <span>
#include <string>

namespace gaitlab::expression {

/// A function or operator, with its name in the tree.
struct Function {
  enum class Op {
    neg,
    no,
    add,
    sub,
    mul,
    div,
    pow,
    lt,
    le,
    gt,
    ge,
    eq,
    ne,
    both,
    either,
    sin,
    cos,
    tan,
    tanh,
    exp,
    log,
    sqrt,
    abs,
    sign,
    min,
    max,
    clamp,
    choose,
    mod,
    atan2
  };
  const char* name;
  std::size_t arguments;
  Op op;
};
/// Function or operator with this name, or null if the name is unknown.
const Function* find_function(const std::string& name);
/// Functions that are written as calls, without operators.
std::span<const Function> functions();

/// Computes out[k] = op(a[k], b[k], c[k]) for k < n. Operands that the function lacks are not read. Comparisons give 1 or 0.
/// Any number other than 0 counts as true.
void calculate(Function::Op op, std::size_t n, double* out, const double* a, const double* b, const double* c);

}  // namespace gaitlab::expression
