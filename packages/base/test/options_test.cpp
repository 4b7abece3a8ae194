#include <culm/base/error.hpp>
#include <culm/base/options.hpp>

#include <gtest/gtest.h>

namespace culm {
namespace {

Options beam_options() {
  Options options("beam", {"deck.xml", 3, "Structures / beam"});
  options.set("Length", 2.0, true, {"deck.xml", 4, "Structures / beam / Length"});
  options.set("Elements", 8, false, {});
  options.declare("Damping").declare_list("Section");
  options.add_list(Options("Curve")).add_entry(Options("left")).add_entry(Options("right"));
  return options;
}

TEST(Options, ReadsEachKind) {
  Options options("all");
  options.set("number", 1.5).set("integer", 2).set("flag", true).set("text", "word");
  options.set("numbers", std::vector{1.0, 2.0}).set("integers", std::vector{1, 2});
  options.set("texts", std::vector<std::string>{"a", "b"});
  EXPECT_EQ(options.number("number"), 1.5);
  EXPECT_EQ(options.integer("integer"), 2);
  EXPECT_TRUE(options.flag("flag"));
  EXPECT_EQ(options.text("text"), "word");
  EXPECT_EQ(options.numbers("numbers"), (std::vector{1.0, 2.0}));
  EXPECT_EQ(options.integers("integers"), (std::vector{1, 2}));
  EXPECT_EQ(options.texts("texts"), (std::vector<std::string>{"a", "b"}));
}

TEST(Options, TellsValuesFromDefaultsFromNothing) {
  const Options options = beam_options();
  EXPECT_TRUE(options.has("Length"));
  EXPECT_TRUE(options.given("Length"));
  EXPECT_TRUE(options.has("Elements"));
  EXPECT_FALSE(options.given("Elements"));
  EXPECT_FALSE(options.has("Damping"));
  EXPECT_FALSE(options.given("Damping"));
}

TEST(Options, PlaceOfADefaultIsThatOfItsList) {
  const Options options = beam_options();
  EXPECT_EQ(options.where("Length").line, 4);
  EXPECT_EQ(options.where("Elements").line, 3);
  EXPECT_EQ(options.where("Elements").path, "Structures / beam");
}

TEST(Options, AskingForWhatIsNotDeclaredIsABug) {
  const Options options = beam_options();
  EXPECT_THROW(options.number("Lenght"), InternalError);
  EXPECT_THROW(options.has("Lenght"), InternalError);
  EXPECT_THROW(options.given("Lenght"), InternalError);
  EXPECT_THROW(options.where("Lenght"), InternalError);
  EXPECT_THROW(Options("no lists").has_list("Curve"), InternalError);
}

TEST(Options, ReadingNothingOrAnotherKindIsABug) {
  const Options options = beam_options();
  EXPECT_THROW(options.number("Damping"), InternalError);
  EXPECT_THROW(options.integer("Length"), InternalError);
  EXPECT_THROW(options.list("Section"), InternalError);
}

TEST(Options, ListsAreFoundByNameAndEntriesKeepTheirOrder) {
  const Options options = beam_options();
  EXPECT_TRUE(options.has_list("Curve"));
  EXPECT_FALSE(options.has_list("Section"));
  EXPECT_EQ(options.list("left").name(), "left");
  ASSERT_EQ(options.entries().size(), 2U);
  EXPECT_EQ(options.entries()[0].name(), "left");
  EXPECT_EQ(options.entries()[1].name(), "right");
}

TEST(Options, AnEntryThatIsNotThereMayBeAskedFor) {
  EXPECT_FALSE(Options("empty").declare_entries().has_list("tip"));
}

}  // namespace
}  // namespace culm
