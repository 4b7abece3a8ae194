#include <culm/base/error.hpp>
#include <culm/base/registry.hpp>
#include <culm/base/schema.hpp>

#include <gtest/gtest.h>

#include <limits>

namespace culm {
namespace {

using Messages = std::vector<std::string>;
using Numbers = std::vector<double>;

TEST(Field, IsRequiredUnlessOptional) {
  EXPECT_TRUE(number("Mass", "kg", "").required());
  EXPECT_FALSE(number("Mass", "kg", "").optional().required());
  EXPECT_FALSE(number("Mass", "kg", "").optional().default_value().has_value());
  EXPECT_EQ(number("Mass", "kg", "").optional(2.0).default_value(), Value(2.0));
}

TEST(Field, DefaultsTakeTheKindOfTheField) {
  EXPECT_EQ(number("A", "", "").optional(0).default_value(), Value(0.0));
  EXPECT_EQ(numbers("A", "", "").optional({0, 0, 1}).default_value(), Value(Numbers{0, 0, 1}));
  EXPECT_EQ(integers("A", "").optional({1, 2}).default_value(), Value(std::vector{1, 2}));
  EXPECT_EQ(text("A", "").optional("x").default_value(), Value(std::string("x")));
  EXPECT_EQ(texts("A", "").optional({"x"}).default_value(), Value(std::vector<std::string>{"x"}));
  EXPECT_EQ(texts("A", "").optional("x").default_value(), Value(std::vector<std::string>{"x"}));
  EXPECT_EQ(texts("A", "").optional({"x", "y"}).default_value(),
            Value(std::vector<std::string>{"x", "y"}));
  EXPECT_EQ(flag("A", "").optional(true).default_value(), Value(true));
  EXPECT_THROW(integer("A", "").optional(1.5), InternalError);
}

TEST(Field, ADefaultObeysTheRulesOfItsField) {
  EXPECT_THROW(number("A", "", "").positive().optional(0.0), InternalError);
  EXPECT_THROW(choice("A", {"x", "y"}, "").optional("z"), InternalError);
}

TEST(Field, MessagesNameRuleUnitAndValue) {
  EXPECT_EQ(number("A", "kg", "").positive().mistakes(-15.0), Messages{"must be > 0 kg, got -15"});
  EXPECT_EQ(number("A", "kg", "").positive().mistakes(0.0), Messages{"must be > 0 kg, got 0"});
  EXPECT_EQ(number("A", "1", "").between(0, 0.5).mistakes(0.6),
            Messages{"must be between 0 and 0.5, got 0.6"});
  EXPECT_EQ(integer("N", "").between(1, 100000).mistakes(2000000000),
            Messages{"must be between 1 and 100000, got 2000000000"});
  EXPECT_EQ(number("A", "m", "").non_negative().less_than(2).mistakes(2.0),
            Messages{"must be >= 0 and < 2 m, got 2"});
  EXPECT_EQ(integer("A", "").at_least(1).mistakes(0), Messages{"must be >= 1, got 0"});
}

TEST(Field, TheEndsOfAClosedRangeAreAllowed) {
  const Field field = number("A", "", "").between(0, 1);
  EXPECT_TRUE(field.mistakes(0.0).empty());
  EXPECT_TRUE(field.mistakes(1.0).empty());
}

TEST(Field, NumbersAreFinite) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(number("A", "", "").mistakes(nan), Messages{"must be finite, got nan"});
}

TEST(Field, ArraysCheckSizeAndEachItem) {
  EXPECT_EQ(numbers("A", "m", "").size(3).mistakes(Numbers{1, 2}),
            Messages{"must have 3 items, got 2"});
  EXPECT_EQ(numbers("A", "m", "").size_multiple_of(3).mistakes(Numbers{1, 2}),
            Messages{"must have a multiple of 3 items, got 2"});
  EXPECT_EQ(numbers("A", "m", "").min_size(1).mistakes(Numbers{}),
            Messages{"must have at least 1 item, got 0"});
  EXPECT_EQ(numbers("A", "m", "").positive().mistakes(Numbers{1, -2, -3}),
            (Messages{"item 2: must be > 0 m, got -2", "item 3: must be > 0 m, got -3"}));
}

TEST(Field, LongArraysAreNotComplainedAboutAtLength) {
  const Messages messages = numbers("A", "", "").positive().mistakes(Numbers(1000, -1.0));
  ASSERT_EQ(messages.size(), 6U);
  EXPECT_EQ(messages.back(), "995 more items are wrong");
}

TEST(Field, ChoicesSuggestTheNearest) {
  const Field field = choice("Shape", {"box", "tube"}, "");
  EXPECT_TRUE(field.mistakes(std::string("box")).empty());
  EXPECT_EQ(field.mistakes(std::string("tub")),
            Messages{"unknown choice 'tub' – did you mean 'tube'?"});
  EXPECT_EQ(field.mistakes(std::string("sphere")),
            Messages{"unknown choice 'sphere' (allowed: box, tube)"});
}

TEST(Field, RulesThatDoNotFitTheKindAreBugs) {
  EXPECT_THROW(text("A", "").positive(), InternalError);
  EXPECT_THROW(number("A", "", "").size(3), InternalError);
  EXPECT_THROW(number("A", "", "").one_of({"x"}), InternalError);
}

TEST(Schema, ANameIsDeclaredOnce) {
  Schema schema("Tube");
  schema.add(number("Length", "m", ""));
  EXPECT_THROW(schema.add(text("Length", "")), InternalError);
  EXPECT_THROW(schema.list("Length", Schema("x")), InternalError);
}

TEST(Schema, IsAValue) {
  const Schema one = Schema("Tube").add(number("Length", "m", ""));
  Schema two = one;
  two.add(number("Wall", "m", ""));
  EXPECT_EQ(one.field_names(), std::vector<std::string>{"Length"});
  EXPECT_EQ(two.field_names(), (std::vector<std::string>{"Length", "Wall"}));
}

TEST(Schema, FixedListsGoBeforeEntries) {
  const Schema schema = Schema("a").list("Fixed", Schema("f")).entries(Schema("e"));
  EXPECT_EQ(schema.find_slot("Fixed")->find("")->name(), "f");
  EXPECT_EQ(schema.find_slot("anything")->find("")->name(), "e");
  EXPECT_EQ(Schema("b").find_slot("x"), nullptr);
}

TEST(Schema, AddAllTakesFieldsAndChecks) {
  const auto check = [](const Options& list, InputIssues& issues) {
    issues.add(list.where(), "x");
  };
  const Schema shared = Schema("shared").add(number("A", "1", "")).check(check);
  const Schema schema = Schema("s").check(check).add_all(shared);
  EXPECT_EQ(schema.field_names(), std::vector<std::string>{"A"});
  EXPECT_EQ(schema.checks().size(), 2);
}

TEST(Schema, ADefaultedListByTypeHasADefaultType) {
  const Variants variants = {{"A", Schema("A")}};
  EXPECT_THROW(Schema("s").list_by_type("L", variants, Presence::defaulted), InternalError);
  EXPECT_THROW(Schema("s").list_by_type("L", variants, Presence::defaulted, "B"), InternalError);
  EXPECT_NO_THROW(Schema("s").list_by_type("L", variants, Presence::defaulted, "A"));
}

TEST(Registry, MakesWhatWasAddedWithItsArguments) {
  Registry<double, double> shapes;
  shapes.add("Scaled", Schema("Scaled").add(number("Factor", "1", "")),
             [](const Options& options, double x) { return options.number("Factor") * x; });
  const Options options = Options("s").set("Factor", 3.0);
  EXPECT_EQ(shapes.make("Scaled", options, 2.0), 6.0);
  EXPECT_EQ(shapes.names(), std::vector<std::string>{"Scaled"});
  EXPECT_EQ(shapes.variants().at("Scaled").field_names(), std::vector<std::string>{"Factor"});
}

TEST(Registry, ATypeIsRegisteredOnce) {
  Registry<int> registry;
  registry.add("A", Schema("A"), [](const Options&) { return 1; });
  EXPECT_THROW(registry.add("A", Schema("A"), [](const Options&) { return 2; }), InternalError);
}

TEST(Registry, AnUnknownTypeIsNamedWithItsPlaceAndTheNearest) {
  Registry<int> registry;
  registry.add("Beam", Schema("Beam"), [](const Options&) { return 1; });
  try {
    registry.make("Baem", Options("a", {"deck.xml", 4, "Structures / a"}));
    FAIL() << "nothing was thrown";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(),
                 "deck.xml:4: Structures / a: unknown type 'Baem' – did you mean 'Beam'?");
  }
}

}  // namespace
}  // namespace culm
