#include "deck_fixture.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace culm::deck {
namespace {

std::string length(const std::string& value) {
  return "<Parameter name=\"Length\" value=\"" + value + "\"/>";
}

double length_of(const std::string& content) {
  return read(deck_around(beam(content))).list("Structures").list("beam").number("Length");
}

std::string complaint(const std::string& content) {
  const std::string place = "deck.xml:3: Structures / beam / Length: ";
  const std::string text = mistakes(deck_around(beam(content)));
  return text.starts_with(place) ? text.substr(place.size()) : text;
}

TEST(Expression, ComputesWithPiAndFunctions) {
  EXPECT_EQ(length_of(length("2*pi")), 2.0 * std::numbers::pi);
  EXPECT_EQ(length_of(length("sqrt(16) + 2^3")), 12.0);
}

TEST(Expression, VariablesAreSeenInTheirListAndBelow) {
  EXPECT_EQ(length_of("<Variable name=\"L\" value=\"3\"/>" + length("2*L")), 6.0);
  const std::string above = "<Variable name=\"L\" value=\"3\"/>\n" + beam(length("L + 1"));
  EXPECT_EQ(read(deck_around(above)).list("Structures").list("beam").number("Length"), 4.0);
}

TEST(Expression, VariablesUseEarlierOnesAndHideOuterOnes) {
  EXPECT_EQ(length_of("<Variable name=\"a\" value=\"2\"/><Variable name=\"b\" value=\"a^2\"/>" +
                      length("b")),
            4.0);
  const std::string hidden = "<Variable name=\"L\" value=\"3\"/>" +
                             beam("<Variable name=\"L\" value=\"5\"/>" + length("L"));
  EXPECT_EQ(read(deck_around(hidden)).list("Structures").list("beam").number("Length"), 5.0);
}

TEST(Expression, AVariableIsNotSeenInTheListBeside) {
  const std::string text = body("<Variable name=\"Lang\" value=\"3\"/>") + beam(length("2*Lang"));
  EXPECT_EQ(mistakes(deck_around(text)),
            "deck.xml:3: Structures / beam / Length: must be a number, got '2*Lang': unknown "
            "variable 'Lang' (allowed: e, pi)");
}

TEST(Expression, AnUnknownVariableIsNamedWithTheNearest) {
  EXPECT_EQ(complaint("<Variable name=\"EI\" value=\"3\"/>" + length("2*pi*EJ/4")),
            "must be a number, got '2*pi*EJ/4': unknown variable 'EJ' – did you mean 'EI'?");
  EXPECT_EQ(complaint("<Variable name=\"width\" value=\"3\"/>" + length("widht")),
            "must be a number, got 'widht' – did you mean 'width'?");
}

TEST(Expression, AnUnknownFunctionIsNamed) {
  EXPECT_EQ(complaint(length("2*sqr(4)")),
            "must be a number, got '2*sqr(4)': unknown function 'sqr' – did you mean 'sqrt'?");
}

TEST(Expression, BrokenSyntaxIsExplained) {
  EXPECT_EQ(complaint(length("2*")),
            "must be a number, got '2*' (Unexpected end of expression at position 3)");
}

TEST(Expression, AssignmentIsNoExpression) {
  EXPECT_EQ(complaint("<Variable name=\"a\" value=\"2\"/>" + length("a=3")),
            "must be a number, got 'a=3' ('=' does not compare, '==' does)");
}

TEST(Expression, MessagesShowValueAndExpression) {
  EXPECT_EQ(complaint(length("2 - 5")), "must be > 0 m, got -3 ('2 - 5')");
}

TEST(Expression, ReservedAndMalformedNamesOfVariablesAreRefused) {
  EXPECT_EQ(mistakes(deck_around("<Variable name=\"pi\" value=\"3\"/>")),
            "deck.xml:3: Structures / pi: the name 'pi' is taken");
  EXPECT_EQ(mistakes(deck_around("<Variable name=\"sin\" value=\"3\"/>")),
            "deck.xml:3: Structures / sin: the name 'sin' is taken");
  EXPECT_EQ(mistakes(deck_around("<Variable name=\"2a\" value=\"3\"/>")),
            "deck.xml:3: Structures / 2a: the name of a variable must be letters, digits and "
            "'_', got '2a'");
}

TEST(Expression, ANameTooLongForAFormulaIsRefused) {
  const std::string name(101, 'v');
  EXPECT_EQ(mistakes(deck_around("<Variable name=\"" + name + "\" value=\"3\"/>" +
                                 beam(length("1 + 1")))),
            "deck.xml:3: Structures / " + name +
                ": the name of a variable must have at most 100 characters, got '" +
                name.substr(0, 60) + "…'");
  const std::string longest(100, 'v');
  EXPECT_EQ(length_of("<Variable name=\"" + longest + "\" value=\"3\"/>" + length("2*" + longest)),
            6.0);
}

TEST(Expression, AWrongVariableIsReportedOnceNotForEachUse) {
  EXPECT_EQ(mistakes(deck_around("<Variable name=\"L\" value=\"x\"/>\n" + beam(length("2*L")))),
            "deck.xml:3: Structures / L: must be a number, got 'x'");
}

TEST(Expression, ArrayItemsAreExpressions) {
  const Options deck =
      read(deck_around("<Variable name=\"h\" value=\"2\"/>" +
                       body("<Parameter name=\"Position\" value=\"{0, h, h/4}\"/>")));
  EXPECT_EQ(deck.list("Structures").list("top").numbers("Position"), (std::vector{0.0, 2.0, 0.5}));
}

TEST(UnitAttribute, ConvertsToTheUnitOfTheSchema) {
  EXPECT_EQ(length_of("<Parameter name=\"Length\" value=\"3\" unit=\"mm\"/>"), 0.003);
  EXPECT_EQ(length_of("<Variable name=\"L\" value=\"20\" unit=\"cm\"/>" + length("L")), 0.2);
  const Options deck =
      read(deck_around(body("<Parameter name=\"Position\" value=\"{1, 2, 3}\" unit=\"km\"/>")));
  EXPECT_EQ(deck.list("Structures").list("top").numbers("Position"), (std::vector{1e3, 2e3, 3e3}));
}

TEST(UnitAttribute, ADimensionThatDoesNotFitIsRefused) {
  EXPECT_EQ(complaint("<Parameter name=\"Length\" value=\"3\" unit=\"kg\"/>"),
            "must be in units of 'm', got 'kg'");
  EXPECT_EQ(complaint("<Parameter name=\"Length\" value=\"3\" unit=\"mmm\"/>"),
            "unknown unit 'mmm' – did you mean 'mm'?");
  EXPECT_EQ(complaint("<Parameter name=\"Length\" value=\"-3\" unit=\"mm\"/>"),
            "must be > 0 m, got -0.003 ('-3' in mm)");
  EXPECT_EQ(mistakes(deck_around(
                beam(length("1") + "<Parameter name=\"Elements\" value=\"3\" unit=\"m\"/>"))),
            "deck.xml:3: Structures / beam / Elements: takes no unit, got 'm'");
}

TEST(Formula, HasTheVariablesOfTheDeckAsNumbersAndItsOwnAsAName) {
  const auto formula = [](const std::string& text) {
    const std::string motion = "<Parameter name=\"Motion\" value=\"" + text + "\"/>";
    const std::string variables =
        "<Variable name=\"a\" value=\"-2\"/><Variable name=\"t\" value=\"7\"/>";
    return read(deck_around(beam(variables + length("1") + motion)))
        .list("Structures")
        .list("beam")
        .text("Motion");
  };
  EXPECT_EQ(formula("a^2*t + b"), "(-2)^2*t + b");
  EXPECT_EQ(formula("2e3*a + 1e-3 + ab + a(t) + 3a"), "2e3*(-2) + 1e-3 + ab + a(t) + 3a");
}

}  // namespace
}  // namespace culm::deck
