#include <culm/deck/reference.hpp>

#include "deck_fixture.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace culm::deck {
namespace {

using testing::HasSubstr;

TEST(Reference, NamesEveryParameterWithKindUnitRangeAndDefault) {
  const std::string text = reference(world());
  EXPECT_THAT(text, HasSubstr("# Input reference\n\n## culm\n\nA whole deck.\n"));
  EXPECT_THAT(text, HasSubstr("- `Mass` – number > 0 kg, required. Mass.\n"));
  EXPECT_THAT(text, HasSubstr("- `Position` – numbers in m, 3 items, default {0, 0, 0}. Of the "
                              "centre.\n"));
  EXPECT_THAT(text, HasSubstr("- `Strains` – text: full, reduced, default full. Which.\n"));
  EXPECT_THAT(text, HasSubstr("- `Damping` – number >= 0 1/s, optional. Absent: none.\n"));
  EXPECT_THAT(text, HasSubstr("- list `Section`, required; `Type` is one of: Box, Tube.\n"));
  EXPECT_THAT(text, HasSubstr("- list `Solver`, from defaults if absent; `Type` is one of: "
                              "Newton; default Newton.\n"));
  EXPECT_THAT(text, HasSubstr("- lists named by the user; `Type` is one of: Beam, Rigid Body.\n"));
}

TEST(Reference, ATypeIsFoundByItsName) {
  EXPECT_EQ(reference(world(), "tube"),
            "## Tube\n\nIn `Structures / <name> / Section`.\n\n"
            "- `Radius` – number > 0 m, required. Outer radius.\n\n");
}

TEST(Reference, AParameterIsFoundByItsName) {
  EXPECT_EQ(reference(world(), "Tolerance"),
            "## Newton\n\nIn `Solver`.\n\n- `Tolerance` – number, default 1e-09. Of it.\n\n");
}

TEST(Reference, ATypeThatServesManyPlacesIsDescribedOnce) {
  const Schema tube = Schema("Tube").add(number("Radius", "m", ""));
  const Schema root = Schema("r")
                          .list("A", Schema("A").list_by_type("S", {{"Tube", tube}}))
                          .list("B", Schema("B").list_by_type("S", {{"Tube", tube}}));
  EXPECT_EQ(reference(root, "Tube"),
            "## Tube\n\nIn `A / S`, `B / S`.\n\n- `Radius` – number in m, required.\n\n");
}

TEST(Reference, AMissSuggestsTheNearest) {
  try {
    reference(world(), "Tbue");
    FAIL() << "nothing was thrown";
  } catch (const UsageError& error) {
    EXPECT_STREQ(error.what(), "the input reference has no 'Tbue' – did you mean 'Tube'?");
  }
}

}  // namespace
}  // namespace culm::deck
