#include "deck_fixture.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace culm::deck {
namespace {

using testing::HasSubstr;

TEST(Validate, ASoundDeckGivesItsValuesAndDefaults) {
  const Options deck = read(deck_around(body()));
  const Options& top = deck.list("Structures").list("top");
  EXPECT_EQ(top.text("Type"), "Rigid Body");
  EXPECT_EQ(top.number("Mass"), 15.0);
  EXPECT_EQ(top.numbers("Inertia"), (std::vector{1.0, 2.0, 3.0}));
  EXPECT_EQ(top.numbers("Position"), (std::vector{0.0, 0.0, 0.0}));
  EXPECT_FALSE(top.flag("Fixed"));
  EXPECT_TRUE(top.given("Mass"));
  EXPECT_FALSE(top.given("Position"));
  EXPECT_EQ(top.where("Mass").line, 3);
  EXPECT_EQ(top.where("Mass").path, "Structures / top / Mass");
}

TEST(Validate, OptionalListsAreAbsentAndDefaultedOnesAreBuilt) {
  const Options deck = read(deck_around(body()));
  EXPECT_FALSE(deck.has_list("Time"));
  EXPECT_EQ(deck.list("Solver").text("Type"), "Newton");
  EXPECT_EQ(deck.list("Solver").number("Tolerance"), 1e-9);
}

TEST(Validate, EntriesKeepTheOrderOfTheDeck) {
  const Options deck =
      read(deck_around(beam("<Parameter name=\"Length\" value=\"2\"/>") + "\n" + body()));
  const auto& entries = deck.list("Structures").entries();
  ASSERT_EQ(entries.size(), 2U);
  EXPECT_EQ(entries[0].name(), "beam");
  EXPECT_EQ(entries[1].name(), "top");
  EXPECT_FALSE(entries[0].has("Damping"));
}

TEST(Validate, AllMistakesAreReportedInOnePassInTheOrderOfTheFile) {
  const std::string text = R"(<ParameterList name="culm">
  <ParameterList name="Structures">
    <ParameterList name="top">
      <Parameter name="Type"     type="string" value="Rigid Body"/>
      <Parameter name="Mass"     type="double" value="-15"/>
      <!-- a comment

           of three lines -->
      <Parameter name="Interia"  value="{1, 2, 3}"/>
      <Parameter name="Position" value="{1, 2}"/>
      <Parameter name="Fixed"    value="yes"/>
    </ParameterList>
    <ParameterList name="beam">
      <Parameter name="Type" value="Baem"/>
    </ParameterList>
  </ParameterList>
  <ParameterList name="Tyme"/>
</ParameterList>)";
  EXPECT_EQ(mistakes(text),
            "deck.xml:5: Structures / top / Mass: must be > 0 kg, got -15\n"
            "deck.xml:9: Structures / top: unknown name 'Interia' – did you mean 'Inertia'?\n"
            "deck.xml:10: Structures / top / Position: must have 3 items, got 2\n"
            "deck.xml:11: Structures / top / Fixed: must be true or false, got 'yes'\n"
            "deck.xml:14: Structures / beam / Type: unknown type 'Baem' – did you mean 'Beam'?\n"
            "deck.xml:17: culm: unknown list 'Tyme' – did you mean 'Time'?");
}

TEST(Validate, ANumberIsTheWholeText) {
  const auto of = [](const std::string& value) {
    return mistakes(deck_around(beam("<Parameter name=\"Length\" value=\"" + value + "\"/>")));
  };
  const std::string place = "deck.xml:3: Structures / beam / Length: ";
  EXPECT_EQ(of("abc"), place + "must be a number, got 'abc'");
  EXPECT_EQ(of("0.05 s"),
            place +
                "must be a number, got '0.05 s' – a unit stands in its own attribute: "
                "unit=\"s\"");
  EXPECT_EQ(of("nan"), place + "must be a finite number, got 'nan'");
  EXPECT_EQ(of("-inf"), place + "must be a finite number, got '-inf'");
  EXPECT_EQ(of("1e999"), place + "must be within the range of double precision, got '1e999'");
  EXPECT_EQ(of("1/0"), place + "must be finite, got '1/0'");
  EXPECT_EQ(of("1,5"), place + "must be one number, got '1,5'");
  EXPECT_EQ(of(""), place + "must be a number, got ''");
  EXPECT_EQ(of("{1}"), place +
                           "must be a number, got '{1}' (Unexpected token \"{1} \" found at "
                           "position 0.)");
  EXPECT_EQ(of(" 1.5 "), "");
  EXPECT_EQ(of("+1.5e0"), "");
}

TEST(Validate, ANumberInSiUnitsIsNormal) {
  const auto of = [](const std::string& value, const std::string& unit) {
    return mistakes(deck_around(
        beam("<Parameter name=\"Length\" value=\"" + value + "\" unit=\"" + unit + "\"/>")));
  };
  const std::string rule =
      "deck.xml:3: Structures / beam / Length: must be from 2.23e-308 to 1.8e+308 in size when it "
      "is "
      "in SI units, got ";
  EXPECT_EQ(of("1e306", "km"), rule + "'1e306' in km");
  EXPECT_EQ(of("1e-306", "mm"), rule + "'1e-306' in mm");
  EXPECT_EQ(of("1e-323", "mm"), rule + "'1e-323' in mm");
  EXPECT_EQ(of("1e-320", "m"), rule + "'1e-320' in m");
  EXPECT_EQ(of("2e-300", "mm"), "");
  EXPECT_NE(mistakes("<ParameterList name=\"culm\"><Variable name=\"EA\" value=\"1e305\" "
                     "unit=\"MN\"/></ParameterList>")
                .find("got '1e305' in MN"),
            std::string::npos);
}

TEST(Validate, AnIntegerIsWholeAndFits) {
  const auto of = [](const std::string& value) {
    return mistakes(
        deck_around(beam("<Parameter name=\"Length\" value=\"1\"/>"
                         "<Parameter name=\"Elements\" value=\"" +
                         value + "\"/>")));
  };
  const std::string place = "deck.xml:3: Structures / beam / Elements: ";
  EXPECT_EQ(of("4.7"), place + "must be an integer, got '4.7'");
  EXPECT_EQ(of("9/2"), place + "must be an integer, got '9/2', which is 4.5");
  EXPECT_EQ(of("abc"), place + "must be an integer, got 'abc'");
  EXPECT_EQ(of("0"), place + "must be >= 1, got 0");
  EXPECT_EQ(of("3000000000"),
            place + "must be an integer of at most 2147483647 in size, got '3000000000'");
  EXPECT_EQ(of("8/2"), "");
}

TEST(Validate, ArraysAreWrittenInBraces) {
  const auto of = [](const std::string& value) {
    return mistakes(deck_around(body("<Parameter name=\"Position\" value=\"" + value + "\"/>")));
  };
  const std::string place = "deck.xml:3: Structures / top / Position: ";
  EXPECT_EQ(of("1 2 3"), place + "must be an array such as {1, 2, 3}, got '1 2 3'");
  EXPECT_EQ(of("{{1}, 2, 3}"), place + "must be an array such as {1, 2, 3}, got '{{1}, 2, 3}'");
  EXPECT_EQ(of("{1, x, nan}"), place + "item 2: must be a number, got 'x'\n" + place +
                                   "item 3: must be a finite number, got 'nan'");
  EXPECT_EQ(of("{1, 2,}"), place + "item 3: must be a number, got ''");
  EXPECT_EQ(of("{max(1, 2), 2, 3}"), "");
}

TEST(Validate, ItemsObeyTheRangeOfTheirField) {
  EXPECT_EQ(mistakes(deck_around("<ParameterList name=\"top\">"
                                 "<Parameter name=\"Type\" value=\"Rigid Body\"/>\n"
                                 "<Parameter name=\"Mass\" value=\"1\"/>\n"
                                 "<Parameter name=\"Inertia\" value=\"{1, 0, 1}\"/>"
                                 "</ParameterList>")),
            "deck.xml:5: Structures / top / Inertia: item 2: must be > 0 kg m^2, got 0");
}

TEST(Validate, TextsAndIntegersHaveArraysToo) {
  const Options deck = read(deck_around(
      beam("<Parameter name=\"Length\" value=\"1\"/><Parameter name=\"Nodes\" type=\"Array(int)\" "
           "value=\"{1, 1+1}\"/><Parameter name=\"Tags\" type=\"Array(string)\" "
           "value='{a b, \"c, d\", \"say \"\"so\"\"\"}'/>")));
  const Options& beam = deck.list("Structures").list("beam");
  EXPECT_EQ(beam.integers("Nodes"), (std::vector{1, 2}));
  EXPECT_EQ(beam.texts("Tags"), (std::vector<std::string>{"a b", "c, d", "say \"so\""}));
}

TEST(Validate, AWrittenTypeIsChecked) {
  const auto of = [](const std::string& type) {
    return mistakes(
        deck_around(beam("<Parameter name=\"Length\" type=\"" + type + "\" value=\"1\"/>")));
  };
  const std::string place = "deck.xml:3: Structures / beam / Length: ";
  EXPECT_EQ(of("double"), "");
  EXPECT_EQ(of("string"), place + "must have type=\"double\", got type=\"string\"");
  EXPECT_EQ(of("duoble"), place + "unknown type=\"duoble\" – did you mean 'double'?");
}

TEST(Validate, ChoicesSuggestTheNearest) {
  EXPECT_EQ(mistakes(deck_around(beam("<Parameter name=\"Length\" value=\"1\"/>"
                                      "<Parameter name=\"Strains\" value=\"ful\"/>"))),
            "deck.xml:3: Structures / beam / Strains: unknown choice 'ful' – did you mean "
            "'full'?");
}

TEST(Validate, AMissingTypeListsWhatThereIs) {
  EXPECT_EQ(mistakes(deck_around("<ParameterList name=\"x\"/>")),
            "deck.xml:3: Structures / x: missing 'Type' (allowed: Beam, Rigid Body)");
}

TEST(Validate, MissingListsAreReportedAtTheirParent) {
  EXPECT_EQ(mistakes("<ParameterList name=\"culm\">\n</ParameterList>"),
            "deck.xml:1: culm: missing list 'Structures'");
}

TEST(Validate, AMisspeltNameIsNotMissingAsWell) {
  EXPECT_EQ(mistakes(deck_around(beam("\n<Parameter name=\"Lenght\" value=\"2\"/>"))),
            "deck.xml:4: Structures / beam: unknown name 'Lenght' – did you mean 'Length'?");
  EXPECT_EQ(mistakes("<ParameterList name=\"culm\">\n<ParameterList name=\"Structure\"/>\n"
                     "</ParameterList>"),
            "deck.xml:2: culm: unknown list 'Structure' – did you mean 'Structures'?");
}

TEST(Validate, AMisspeltNameStandsForOneThatIsMissing) {
  Schema schema("culm", "");
  schema.add(number("EI1", "N m^2", "")).add(number("EI2", "N m^2", ""));
  try {
    Deck::parse_text(
        "<ParameterList name=\"culm\">\n<Parameter name=\"EI1\" value=\"1\"/>"
        "<Parameter name=\"EI3\" value=\"1\"/></ParameterList>",
        "deck.xml", {})
        .validate(schema);
    FAIL() << "the mistake passed";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "deck.xml:2: culm: unknown name 'EI3' – did you mean 'EI2'?");
  }
}

TEST(Validate, TheRootHasTheNameOfTheSchema) {
  EXPECT_THAT(mistakes("<ParameterList name=\"colm\"><ParameterList name=\"Structures\"/>"
                       "</ParameterList>"),
              HasSubstr("deck.xml:1: colm: the root list must be named 'culm', got 'colm'"));
}

TEST(Validate, ListsAndParametersAreNotMixedUp) {
  EXPECT_EQ(mistakes("<ParameterList name=\"culm\">\n<Parameter name=\"Structures\" value=\"1\"/>"
                     "\n<ParameterList name=\"Title\"/></ParameterList>"),
            "deck.xml:2: Structures: must be a <ParameterList>, found a <Parameter>\n"
            "deck.xml:3: Title: must be a <Parameter>, found a <ParameterList>");
}

TEST(Validate, DuplicatesNameTheFirst) {
  EXPECT_EQ(mistakes(deck_around(body("\n<Parameter name=\"Mass\" value=\"16\"/>"))),
            "deck.xml:4: Structures / top / Mass: duplicate name, first used in line 3");
}

TEST(Validate, RulesAcrossParametersRunOnSoundLists) {
  EXPECT_EQ(mistakes(deck_around(beam("\n<Parameter name=\"Length\" value=\"1000\"/>"))),
            "deck.xml:4: Structures / beam / Length: elements are longer than 100 m");
}

TEST(Validate, AUnitOfTheSchemaThatIsNoneIsABug) {
  const Schema schema = Schema("culm").add(number("Mass", "stone", ""));
  const Deck deck = Deck::parse_text(
      "<ParameterList name=\"culm\"><Parameter name=\"Mass\" value=\"1\" unit=\"g\"/>"
      "</ParameterList>",
      "deck.xml");
  EXPECT_THROW(deck.validate(schema), InternalError);
}

TEST(Validate, LongValuesAreCutInMessages) {
  const std::string message = mistakes(
      deck_around(beam("<Parameter name=\"Length\" value=\"" + std::string(100000, 'x') + "\"/>")));
  EXPECT_LT(message.size(), 200U);
}

}  // namespace
}  // namespace culm::deck
