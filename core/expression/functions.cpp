#include "core/expression/functions.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "core/math/functions.h"

namespace gaitlab::expression {
namespace {

using Op = Function::Op;

constexpr Function kFunctions[] = {
    {"~", 1, Op::neg},   {"not", 1, Op::no},      {"+", 2, Op::add},     {"-", 2, Op::sub},     {"*", 2, Op::mul},
    {"/", 2, Op::div},   {"^", 2, Op::pow},       {"<", 2, Op::lt},      {"<=", 2, Op::le},     {">", 2, Op::gt},
    {">=", 2, Op::ge},   {"==", 2, Op::eq},       {"!=", 2, Op::ne},     {"and", 2, Op::both},  {"or", 2, Op::either},
    {"sin", 1, Op::sin}, {"cos", 1, Op::cos},     {"tan", 1, Op::tan},   {"tanh", 1, Op::tanh}, {"exp", 1, Op::exp},
    {"log", 1, Op::log}, {"sqrt", 1, Op::sqrt},   {"abs", 1, Op::abs},   {"sign", 1, Op::sign}, {"min", 2, Op::min},
    {"max", 2, Op::max}, {"clamp", 3, Op::clamp}, {"if", 3, Op::choose}, {"mod", 2, Op::mod},   {"atan2", 2, Op::atan2}};
constexpr std::size_t kOperators = 15;  // number of operators, which the grammar does not write as calls

template <class F>
void each(std::size_t n, double* out, const double* a, F f) {
  for (std::size_t k = 0; k < n; ++k) out[k] = f(a[k]);
}

template <class F>
void each(std::size_t n, double* out, const double* a, const double* b, F f) {
  for (std::size_t k = 0; k < n; ++k) out[k] = f(a[k], b[k]);
}

double truth(bool value) { return value ? 1 : 0; }

// The results of min, max and sign for NaN are NaN, so that a diverged model does not seem finite.
double smaller(double x, double y) { return y < x || std::isnan(y) ? y : x; }
double larger(double x, double y) { return y > x || std::isnan(y) ? y : x; }
/// x - y floor(x / y) for y > 0, in [0, y); NaN for any other y.
double mod(double x, double y) {
  if (!(y > 0)) return std::numeric_limits<double>::quiet_NaN();
  const double rest = x - y * std::floor(x / y);
  return rest < y ? std::max(rest, 0.0) : std::isnan(rest) ? rest : 0;
}
double sign(double x) { return x > 0 ? 1 : x < 0 ? -1 : x; }

}  // namespace

const Function* find_function(const std::string& name) {
  const auto* const it = std::ranges::find_if(kFunctions, [&](const Function& f) { return name == f.name; });
  return it == std::end(kFunctions) ? nullptr : it;
}

std::span<const Function> functions() { return std::span(kFunctions).subspan(kOperators); }

void calculate(Op op, std::size_t n, double* out, const double* a, const double* b, const double* c) {
  switch (op) {
    case Op::neg:
      return each(n, out, a, [](double x) { return -x; });
    case Op::no:
      return each(n, out, a, [](double x) { return truth(x == 0); });
    case Op::add:
      return each(n, out, a, b, [](double x, double y) { return x + y; });
    case Op::sub:
      return each(n, out, a, b, [](double x, double y) { return x - y; });
    case Op::mul:
      return each(n, out, a, b, [](double x, double y) { return x * y; });
    case Op::div:
      return each(n, out, a, b, [](double x, double y) { return x / y; });
    case Op::pow:
      return each(n, out, a, b, [](double x, double y) { return math::pow(x, y); });
    case Op::lt:
      return each(n, out, a, b, [](double x, double y) { return truth(x < y); });
    case Op::le:
      return each(n, out, a, b, [](double x, double y) { return truth(x <= y); });
    case Op::gt:
      return each(n, out, a, b, [](double x, double y) { return truth(x > y); });
    case Op::ge:
      return each(n, out, a, b, [](double x, double y) { return truth(x >= y); });
    case Op::eq:
      return each(n, out, a, b, [](double x, double y) { return truth(x == y); });
    case Op::ne:
      return each(n, out, a, b, [](double x, double y) { return truth(x != y); });
    case Op::both:
      return each(n, out, a, b, [](double x, double y) { return truth(x != 0 && y != 0); });
    case Op::either:
      return each(n, out, a, b, [](double x, double y) { return truth(x != 0 || y != 0); });
    case Op::sin:
      return each(n, out, a, [](double x) { return math::sin(x); });
    case Op::cos:
      return each(n, out, a, [](double x) { return math::cos(x); });
    case Op::tan:
      return each(n, out, a, [](double x) { return math::tan(x); });
    case Op::tanh:
      return each(n, out, a, [](double x) { return math::tanh(x); });
    case Op::exp:
      return each(n, out, a, [](double x) { return math::exp(x); });
    case Op::log:
      return each(n, out, a, [](double x) { return math::log(x); });
    case Op::sqrt:
      return each(n, out, a, [](double x) { return std::sqrt(x); });
    case Op::abs:
      return each(n, out, a, [](double x) { return std::abs(x); });
    case Op::sign:
      return each(n, out, a, sign);
    case Op::min:
      return each(n, out, a, b, smaller);
    case Op::max:
      return each(n, out, a, b, larger);
    case Op::clamp:
      for (std::size_t k = 0; k < n; ++k) out[k] = smaller(larger(a[k], b[k]), c[k]);
      return;
    case Op::mod:
      return each(n, out, a, b, mod);
    case Op::atan2:
      return each(n, out, a, b, [](double y, double x) { return math::atan2(y, x); });
    case Op::choose:
      for (std::size_t k = 0; k < n; ++k) out[k] = a[k] != 0 ? b[k] : c[k];
      return;
  }
}

}  // namespace gaitlab::expression
