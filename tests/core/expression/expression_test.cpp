// Tests of names of summary numbers in expressions. Tests of the grammar are in tests/cpg/equation_texts_test.cpp.
#include "core/expression/expression.h"

#include <gtest/gtest.h>

#include "core/expression/functions.h"

namespace gaitlab::expression {
namespace {

Term figure(const std::string& text) { return parse(text, NameSyntax::figures); }

/// Position and message, `character: what`, of the error for a text that is refused.
std::string refused(const std::string& text, NameSyntax names) {
  try {
    parse(text, names);
  } catch (const Fault& fault) {
    return std::to_string(fault.offset) + ": " + fault.what;
  }
  return "taken";
}

TEST(Expression, NamesOfFiguresHoldDotsAndJoints) {
  const Term term = figure("2*torque.peak[ m3/active ] + speed");
  ASSERT_EQ(term.name, "+");
  const Term& peak = term.arguments[0].arguments[1];
  EXPECT_EQ(peak.name, "torque.peak");
  EXPECT_EQ(peak.joint, "m3/active");
  EXPECT_EQ(term.arguments[1].name, "speed");
  EXPECT_EQ(term.arguments[1].joint, "");
  EXPECT_EQ(figure("1.5e-3").number, 1.5e-3);  // the point in a number does not start a name
  EXPECT_EQ(figure("a._b1.c <= 1.e2").arguments[0].name, "a._b1.c");
  EXPECT_EQ(figure("sum(a)").kind, Term::Kind::call);  // without neighbours, `sum` is an unknown function
}

TEST(Expression, RefusesOtherNames) {
  EXPECT_EQ(refused("torque.peak", NameSyntax::joints), "taken");  // a value of a sensor
  EXPECT_EQ(refused("torque.", NameSyntax::figures), "6: found '.', which has no meaning here");
  EXPECT_EQ(refused("torque.1", NameSyntax::figures), "6: found '.1'; expected an operator or the end of the text");
  EXPECT_EQ(refused("torque..peak", NameSyntax::figures), "6: found '.', which has no meaning here");
  EXPECT_EQ(refused("torque[m3", NameSyntax::figures), "9: found the end of the text; expected ']'");
  EXPECT_EQ(refused("torque[ ]", NameSyntax::figures), "8: found nothing in [ ]; expected the name of a joint");
  EXPECT_EQ(refused("phi[m3/active]", NameSyntax::joints), "4: found 'm3'; expected i or j");
}

TEST(Expression, FunctionsAreKnownByTheirNames) {
  EXPECT_EQ(find_function("clamp")->arguments, 3U);
  EXPECT_EQ(find_function("sum"), nullptr);
  EXPECT_STREQ(functions().front().name, "sin");  // the list omits the operators
}

}  // namespace
}  // namespace gaitlab::expression
