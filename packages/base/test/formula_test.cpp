#include <culm/base/formula.hpp>

#include <gtest/gtest.h>

namespace culm {
namespace {

Formula::Result evaluate(const std::string& text) {
  Formula formula;
  formula.set_constants({{"a", 2.0}});
  formula.set_text(text);
  return formula.evaluate();
}

std::string reason(const std::string& text) {
  const Formula::Result result = evaluate(text);
  return result.mistake ? result.mistake->reason : "";
}

TEST(Formula, ComputesWithConstantsAndVariables) {
  EXPECT_EQ(evaluate("a^3 + sqrt(4)").value, 10.0);
  Formula formula;
  double t = 1.0;
  formula.add_variable("t", t);
  formula.set_text("t < 2 ? 10*t : -1");
  EXPECT_EQ(formula.evaluate().value, 10.0);
  t = 3.0;
  EXPECT_EQ(formula.evaluate().value, -1.0);
}

TEST(Formula, ComparesAndNeverAssigns) {
  EXPECT_EQ(evaluate("a==2 ? 1 : 0").value, 1.0);
  EXPECT_EQ(evaluate("(a<=2) + (a>=2) + (a!=2)").value, 2.0);
  for (const std::string text : {"a=2", "a==2=2", "2<==a", "a= =2"}) {
    EXPECT_EQ(reason(text), "'=' does not compare, '==' does") << text;
  }
  EXPECT_EQ(evaluate("a=2").mistake->position, 1);
}

TEST(Formula, KnowsAndAndOrAsWords) {
  EXPECT_EQ(evaluate("a>1 and a<3 ? 5 : 6").value, 5.0);
  EXPECT_EQ(evaluate("a>1 and a>3 or a==2").value, 1.0);
  EXPECT_EQ(evaluate("a>3 or a<1").value, 0.0);
  EXPECT_EQ(evaluate("a>1 and a<3").value, evaluate("a>1 && a<3").value);
  EXPECT_TRUE(Formula().has_function("and"));
}

TEST(Formula, MistakesAreResults) {
  EXPECT_EQ(evaluate("2*b").mistake->token, "b");
  EXPECT_NE(reason("2*"), "");
  EXPECT_NE(reason(std::string(30000, '1')), "");
  EXPECT_NE(reason(std::string(200, 'x') + " + 1"), "");
  EXPECT_EQ(evaluate("1, 2").count, 2);
}

}  // namespace
}  // namespace culm
