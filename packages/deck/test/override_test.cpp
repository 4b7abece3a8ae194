#include "deck_fixture.hpp"

#include <gtest/gtest.h>

namespace culm::deck {
namespace {

Options overridden(const Overrides& overrides) {
  const std::string text = "<Variable name=\"L\" value=\"2\"/>" + body() +
                           beam("<Parameter name=\"Length\" value=\"10*L\" unit=\"cm\"/>");
  return read(deck_around(text), overrides).list("Structures");
}

TEST(Override, ReplacesAValue) {
  EXPECT_EQ(overridden({"Structures/top/Mass=20"}).list("top").number("Mass"), 20.0);
  EXPECT_EQ(overridden({" Structures / top / Mass = 20 "}).list("top").number("Mass"), 20.0);
}

TEST(Override, TheLastOneWins) {
  EXPECT_EQ(
      overridden({"Structures/top/Mass=20", "Structures/top/Mass=30"}).list("top").number("Mass"),
      30.0);
}

TEST(Override, AddsWhatIsMissing) {
  const Options structures = overridden({"Structures/beam/Elements=32"});
  EXPECT_EQ(structures.list("beam").integer("Elements"), 32);
  EXPECT_TRUE(structures.list("beam").given("Elements"));
  EXPECT_EQ(structures.list("beam").where("Elements").file, "command line");
  EXPECT_EQ(read(deck_around(body()), {"Time/End=3"}).list("Time").number("End"), 3.0);
}

TEST(Override, KeepsTheUnitOfTheDeck) {
  EXPECT_EQ(overridden({"Structures/beam/Length=300"}).list("beam").number("Length"), 3.0);
}

TEST(Override, ReplacesVariables) {
  EXPECT_EQ(overridden({"Structures/L=5"}).list("beam").number("Length"), 0.5);
}

TEST(Override, ValuesMayContainEqualsSigns) {
  EXPECT_EQ(read(deck_around(body()), {"Title=a=b"}).text("Title"), "a=b");
}

TEST(Override, ANameThatIsNotThereIsTakenForTheNearestOne) {
  const std::string deck = deck_around("<Variable name=\"L\" value=\"2\"/>" + body());
  EXPECT_EQ(
      mistakes(deck, {"Structures/tap/Mass=1"}),
      "command line: Structures / tap: there is no list 'tap', and a new one needs a 'Type' – "
      "did you mean 'top'?");
  EXPECT_EQ(mistakes(deck, {"Structures/l=5"}),
            "command line: Structures: unknown name 'l' – did you mean 'L'?");
  EXPECT_EQ(mistakes(deck, {"Structures/top=5"}),
            "command line: Structures / top: is a list: name what to set in it, as 'top/…'");
}

TEST(Override, MistakesAreReportedAtTheCommandLine) {
  EXPECT_EQ(mistakes(deck_around(body()), {"Structures/top/Mass=-1", "Structures/top/Mas=1"}),
            "command line: Structures / top / Mass: must be > 0 kg, got -1\n"
            "command line: Structures / top: unknown name 'Mas' – did you mean 'Mass'?");
  EXPECT_EQ(mistakes(deck_around(body()), {"Strctures/top/Mass=1"}),
            "command line: culm: unknown list 'Strctures' – did you mean 'Structures'?");
  EXPECT_EQ(mistakes(deck_around(body()), {"Structures/top/Mass/Unit=1"}),
            "command line: Structures / top / Mass: must be a <Parameter>, found a "
            "<ParameterList>");
}

TEST(Override, WhatXmlCannotHoldIsAUsageError) {
  const auto message = [](const std::string& assignment) -> std::string {
    try {
      read(deck_around(body()), {assignment});
    } catch (const UsageError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(message("Title=a\xff\xfe"), "--set is no valid UTF-8 in 'Title=a\\xff\\xfe'");
  EXPECT_EQ(message("Title=\xe2\x82"), "--set is no valid UTF-8 in 'Title=\\xe2\\x82'");
  EXPECT_EQ(message("Title=\x01"),
            "--set has a character that XML does not allow in 'Title=\\x01'");
  EXPECT_EQ(message("T\xffitle=1"), "--set is no valid UTF-8 in 'T\\xffitle=1'");
  EXPECT_EQ(message("Title=µ\t€\n"), "");
}

TEST(Override, WhatIsNoAssignmentIsAUsageError) {
  EXPECT_THROW(read(deck_around(body()), {"Structures/top/Mass"}), UsageError);
  EXPECT_THROW(read(deck_around(body()), {"Structures//Mass=1"}), UsageError);
  EXPECT_THROW(read(deck_around(body()), {"=1"}), UsageError);
}

}  // namespace
}  // namespace culm::deck
