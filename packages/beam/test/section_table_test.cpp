#include <culm/base/error.hpp>
#include <culm/beam/section_table.hpp>
#include <culm/beam/span_table.hpp>

#include <culm_kit/deck_list.hpp>
#include <gtest/gtest.h>

namespace culm::beam {
namespace {

using Messages = std::vector<std::string>;

material::Section section(double EA) { return {EA * Mat6::Identity(), Mat3::Identity(), {}}; }

double stiffness_at(const SectionTable& table, double span) {
  return table.at(span).stiffness(2, 2);
}

TEST(FindPlace, IsConstantBeyondTheEnds) {
  const std::vector<double> positions{0.2, 0.6};
  EXPECT_EQ(table_place(positions, 0.1).second, 0U);
  EXPECT_EQ(table_place(positions, 0.7).first, 1U);
  EXPECT_NEAR(table_place(positions, 0.3).t, 0.25, 1e-15);
}

TEST(SectionTable, IsLinearBetweenItsSections) {
  const SectionTable table({section(1.0), section(3.0), section(2.0)}, {0.0, 0.5, 1.0});
  EXPECT_NEAR(stiffness_at(table, 0.25), 2.0, 1e-15);
  EXPECT_NEAR(stiffness_at(table, 0.5), 3.0, 1e-15);
  EXPECT_NEAR(stiffness_at(table, 1.0), 2.0, 1e-15);
}

TEST(SectionTable, JumpsWhereTwoPositionsAreEqual) {
  const SectionTable table({section(1.0), section(1.0), section(4.0), section(4.0)},
                           {0.0, 0.5, 0.5, 1.0});
  EXPECT_EQ(stiffness_at(table, 0.499), 1.0);
  EXPECT_EQ(stiffness_at(table, 0.5), 4.0);
}

material::Section mass(double rhoA) { return {Mat6::Identity(), rhoA * Mat3::Identity(), {}}; }

TEST(SectionTable, MeanMassIsExactAcrossKinksAndJumps) {
  const SectionTable kinked({mass(1.0), mass(3.0), mass(2.0)}, {0.0, 0.5, 1.0});
  EXPECT_NEAR(kinked.mean_mass(0.0, 1.0), 2.25, 1e-15);
  EXPECT_NEAR(kinked.mean_mass(0.25, 0.75), 0.5 * (2.5 + 2.75), 1e-15);
  const SectionTable jumping({mass(1.0), mass(1.0), mass(4.0), mass(4.0)}, {0.0, 0.5, 0.5, 1.0});
  EXPECT_NEAR(jumping.mean_mass(0.4, 0.8), (0.1 * 1.0 + 0.3 * 4.0) / 0.4, 1e-14);
}

class SectionFields : public testing::Test {
 protected:
  SectionFields() { add_section_fields(schema_); }
  Messages mistakes(const kit::GivenValues& given) const {
    return kit::mistakes_in(schema_, kit::deck_list(schema_, given));
  }
  SectionTable read(const kit::GivenValues& given) const {
    return read_sections(kit::deck_list(schema_, given), sections_);
  }

  Schema schema_{"Beam"};
  const std::map<std::string, material::Section> sections_{{"root", section(1.0)},
                                                           {"tip", section(3.0)}};
};

TEST_F(SectionFields, NameOneSectionOrSeveral) {
  EXPECT_EQ(stiffness_at(read({{"Section", std::string("tip")}}), 0.3), 3.0);
  const SectionTable table =
      read({{"Sections", Messages{"root", "tip"}}, {"Section Positions", std::vector{0.0, 1.0}}});
  EXPECT_NEAR(stiffness_at(table, 0.5), 2.0, 1e-15);
}

TEST_F(SectionFields, MustFitEachOther) {
  EXPECT_EQ(mistakes({}), Messages{"give one of 'Section' and 'Sections'"});
  EXPECT_EQ(mistakes({{"Sections", Messages{"root", "tip"}}}),
            Messages{"'Sections' and 'Section Positions' need each other"});
  EXPECT_EQ(
      mistakes({{"Sections", Messages{"root", "tip"}}, {"Section Positions", std::vector{0.0}}}),
      Messages{"must have one position per value: 2 values, 1 positions"});
}

TEST_F(SectionFields, SuggestTheNearestName) {
  try {
    read({{"Section", std::string("rot")}});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.issues().at(0).message, "unknown section 'rot' – did you mean 'root'?");
  }
}

}  // namespace
}  // namespace culm::beam
