// Number of the active mutant, and the changes of the code by mutants.
#pragma once
#include <cstdlib>
namespace gaitlab::mutants {
inline int& current() {
  static int now = std::getenv("GAITLAB_MUTANT") != nullptr ? std::atoi(std::getenv("GAITLAB_MUTANT")) : 0;
  return now;
}
inline bool on(int id) { return current() == id; }
inline double scaled(int id, double value) { return on(id) ? 1.3 * value : value; }
enum class Is { less, more, at_most, at_least };
/// Comparison that mutant `id` reverses. The code writes a < Turn < b for each of the four comparisons.
struct Turn {
  int id;
  Is is;
};
template <class A>
struct Half {
  A a;
  Turn turn;
};
template <class A>
Half<A> operator<(const A& a, const Turn& turn) {
  return {a, turn};
}
template <class A, class B>
bool operator<(const Half<A>& left, const B& b) {
  const bool turned = on(left.turn.id);
  switch (left.turn.is) {
    case Is::less:
      return turned ? left.a > b : left.a < b;
    case Is::more:
      return turned ? left.a < b : left.a > b;
    case Is::at_most:
      return turned ? left.a >= b : left.a <= b;
    default:
      return turned ? left.a <= b : left.a >= b;
  }
}
}  // namespace gaitlab::mutants
