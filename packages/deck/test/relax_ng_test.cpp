#include <culm/deck/relax_ng.hpp>

#include "deck_fixture.hpp"

#include <gtest/gtest.h>
#include <libxml/parser.h>
#include <libxml/relaxng.h>

#include <memory>

namespace culm::deck {
namespace {

template <class Thing, auto release>
using Owned = std::unique_ptr<Thing, decltype([](Thing* thing) { release(thing); })>;

void say_nothing(void*, const char*, ...) {}

/// The grammar of the small world, as libxml2 reads it.
class RelaxNg : public testing::Test {
 protected:
  RelaxNg() : text_(relax_ng(world())) {
    xmlSetGenericErrorFunc(nullptr, say_nothing);
    const Owned<xmlRelaxNGParserCtxt, xmlRelaxNGFreeParserCtxt> parser(
        xmlRelaxNGNewMemParserCtxt(text_.data(), static_cast<int>(text_.size())));
    grammar_.reset(xmlRelaxNGParse(parser.get()));
  }
  ~RelaxNg() override { xmlSetGenericErrorFunc(nullptr, nullptr); }

  void SetUp() override { ASSERT_NE(grammar_, nullptr) << text_; }

  bool accepts(const std::string& deck) const {
    const Owned<xmlDoc, xmlFreeDoc> document(xmlReadMemory(
        deck.data(), static_cast<int>(deck.size()), "deck.xml", nullptr, XML_PARSE_NOERROR));
    const Owned<xmlRelaxNGValidCtxt, xmlRelaxNGFreeValidCtxt> validator(
        xmlRelaxNGNewValidCtxt(grammar_.get()));
    return document && xmlRelaxNGValidateDoc(validator.get(), document.get()) == 0;
  }

  /// A beam with this parameter.
  bool accepts(const std::string& name, const std::string& value, const std::string& more = "") {
    return accepts(deck_around(
        beam("<Parameter name=\"" + name + "\" value=\"" + value + "\" " + more + "/>")));
  }

  std::string text_;
  Owned<xmlRelaxNG, xmlRelaxNGFree> grammar_;
};

TEST_F(RelaxNg, AcceptsASoundDeck) {
  const std::string deck = deck_around(body() + beam("<Parameter name=\"Length\" value=\"2\"/>"));
  ASSERT_EQ(mistakes(deck), "");
  EXPECT_TRUE(accepts(deck));
}

TEST_F(RelaxNg, RefusesNamesThatTheListDoesNotHave) {
  EXPECT_FALSE(accepts("Lenght", "2"));
  EXPECT_FALSE(accepts("Mass", "2")) << "that of another type";
  EXPECT_FALSE(accepts(deck_around(beam("<ParameterList name=\"Sektion\"/>"))));
  EXPECT_FALSE(accepts("Length", "2", "unti=\"m\""));
}

TEST_F(RelaxNg, RefusesUnknownTypesAndListsWithoutOne) {
  EXPECT_FALSE(accepts(deck_around(
      "<ParameterList name=\"a\"><Parameter name=\"Type\" value=\"Beem\"/></ParameterList>")));
  EXPECT_FALSE(accepts(deck_around("<ParameterList name=\"a\"/>")));
  EXPECT_TRUE(
      accepts("<ParameterList name=\"culm\"><ParameterList name=\"Solver\"/>"
              "</ParameterList>"))
      << "of which the type has a default";
}

TEST_F(RelaxNg, TheTypeMayStandAnywhereInItsList) {
  EXPECT_TRUE(
      accepts(deck_around("<ParameterList name=\"a\"><Parameter name=\"Length\" value=\"1\"/>"
                          "<Parameter name=\"Type\" value=\"Beam\"/><Variable name=\"b\" "
                          "value=\"2\"/></ParameterList>")));
}

TEST_F(RelaxNg, NumbersAreDigitsOrExpressions) {
  for (const char* value : {"2", "+2e-3", " 2.5 ", "2*pi*L", "max(L, 2) + 3", "-L"}) {
    EXPECT_TRUE(accepts("Length", value)) << value;
  }
  for (const char* value : {"", " ", "3 apples", "0.05 s", "inf", "-nan", "0", "-1"}) {
    EXPECT_FALSE(accepts("Length", value)) << value;
  }
  EXPECT_TRUE(accepts("Elements", "1"));
  EXPECT_TRUE(accepts("Elements", "2.0"));
  EXPECT_FALSE(accepts("Elements", "0"));
  EXPECT_FALSE(accepts("Elements", "2.5"));
}

TEST_F(RelaxNg, ChoicesFlagsAndArraysAreChecked) {
  EXPECT_TRUE(accepts("Strains", "reduced"));
  EXPECT_FALSE(accepts("Strains", "Reduced"));
  EXPECT_TRUE(accepts("Nodes", "{1, n - 2}"));
  EXPECT_FALSE(accepts("Nodes", "1, 2"));
  EXPECT_TRUE(accepts(deck_around(body("<Parameter name=\"Fixed\" value=\" true\"/>"))));
  EXPECT_FALSE(accepts(deck_around(body("<Parameter name=\"Fixed\" value=\"yes\"/>"))));
}

TEST_F(RelaxNg, TheAttributeTypeIsThatOfTheKindAndOnlyNumbersHaveUnits) {
  EXPECT_TRUE(accepts("Length", "2", "type=\"double\" unit=\"mm\""));
  EXPECT_FALSE(accepts("Length", "2", "type=\"int\""));
  EXPECT_FALSE(accepts("Elements", "2", "unit=\"mm\""));
}

TEST_F(RelaxNg, IncludesMayBringTheTypeAndAreFilesOfTheirOwn) {
  const std::string include =
      "<xi:include xmlns:xi=\"http://www.w3.org/2001/XInclude\" href=\"a.xml\"/>";
  EXPECT_TRUE(accepts(deck_around("<ParameterList name=\"a\">" + include + "</ParameterList>")));
  EXPECT_TRUE(accepts("<ParameterList name=\"Structures\">" + body() + "</ParameterList>"));
  EXPECT_FALSE(accepts("<ParameterList name=\"top\"/>"));
}

TEST_F(RelaxNg, TellsWhatTheReferenceTells) {
  EXPECT_NE(text_.find("<a:documentation>number &gt; 0 m, required. Length.</a:documentation>"),
            std::string::npos);
}

}  // namespace
}  // namespace culm::deck
