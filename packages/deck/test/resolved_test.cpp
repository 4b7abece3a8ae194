#include <culm/deck/resolved.hpp>

#include "deck_fixture.hpp"

#include <gtest/gtest.h>

namespace culm::deck {
namespace {

void expect_same(const Options& a, const Options& b) {
  EXPECT_EQ(a.name(), b.name());
  ASSERT_EQ(a.parameters().size(), b.parameters().size()) << a.name();
  for (std::size_t i = 0; i < a.parameters().size(); ++i) {
    EXPECT_EQ(a.parameters()[i].name, b.parameters()[i].name);
    EXPECT_EQ(a.parameters()[i].value, b.parameters()[i].value) << a.parameters()[i].name;
    EXPECT_EQ(a.parameters()[i].given, b.parameters()[i].given) << a.parameters()[i].name;
  }
  ASSERT_EQ(a.lists().size(), b.lists().size());
  for (std::size_t i = 0; i < a.lists().size(); ++i) expect_same(a.lists()[i], b.lists()[i]);
  ASSERT_EQ(a.entries().size(), b.entries().size());
  for (std::size_t i = 0; i < a.entries().size(); ++i) expect_same(a.entries()[i], b.entries()[i]);
}

const std::string rich = deck_around("<Variable name=\"L\" value=\"1/3\"/>" +
                                     body("<Parameter name=\"Fixed\" value=\"true\"/>") +
                                     beam("<Parameter name=\"Length\" value=\"10*L\" unit=\"mm\"/>"
                                          "<Parameter name=\"Nodes\" value=\"{1, 2}\"/>"
                                          "<Parameter name=\"Tags\" value='{a &amp; b, \"c, d\", "
                                          "\"\", \" e\", \"say \"\"so\"\"\"}'/>"));

TEST(Resolved, ReadAgainGivesTheSameOptions) {
  const Options once = read(rich);
  const Options twice = read(resolved(once));
  expect_same(once, twice);
  EXPECT_EQ(resolved(once), resolved(twice));
}

TEST(Resolved, TextsSurviveWithAllTheirCharacters) {
  const Options once = read(
      "<ParameterList name=\"culm\"><ParameterList name=\"Structures\"/>"
      "<Parameter name=\"Title\" value=\" &lt;&quot;&amp;&gt;'&#10;&#9;ü \"/>"
      "</ParameterList>");
  EXPECT_EQ(once.text("Title"), " <\"&>'\n\tü ");
  expect_same(once, read(resolved(once)));
}

TEST(Resolved, MarksDefaults) {
  EXPECT_EQ(resolved(read(deck_around(body()))),
            R"xml(<?xml version="1.0" encoding="UTF-8"?>
<ParameterList name="culm">
  <Parameter name="Title" type="string" value="" isDefault="true"/>
  <ParameterList name="Structures">
    <ParameterList name="top">
      <Parameter name="Type" type="string" value="Rigid Body"/>
      <Parameter name="Mass" type="double" value="15"/>
      <Parameter name="Inertia" type="Array(double)" value="{1, 2, 3}"/>
      <Parameter name="Position" type="Array(double)" value="{0, 0, 0}" isDefault="true"/>
      <Parameter name="Fixed" type="bool" value="false" isDefault="true"/>
    </ParameterList>
  </ParameterList>
  <ParameterList name="Solver">
    <Parameter name="Type" type="string" value="Newton" isDefault="true"/>
    <Parameter name="Tolerance" type="double" value="1e-09" isDefault="true"/>
  </ParameterList>
</ParameterList>
)xml");
}

TEST(Resolved, ADefaultThatWasEditedIsAValue) {
  const Options deck =
      read(deck_around(body("<Parameter name=\"Fixed\" value=\"true\" isDefault=\"true\"/>")));
  EXPECT_TRUE(deck.list("Structures").list("top").flag("Fixed"));
  EXPECT_TRUE(deck.list("Structures").list("top").given("Fixed"));
}

}  // namespace
}  // namespace culm::deck
