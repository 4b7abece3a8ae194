#include <culm/material/box_section.hpp>
#include <culm/material/circle_section.hpp>
#include <culm/material/register_material.hpp>
#include <culm/material/stiffness_matrix_section.hpp>
#include <culm/material/stiffness_values_section.hpp>
#include <culm/material/tube_section.hpp>

#include <culm_kit/deck_list.hpp>
#include <culm_kit/rigid_motion.hpp>
#include <gtest/gtest.h>

#include <numbers>

namespace culm::material {
namespace {

using kit::deck_list;
using kit::GivenValues;
using kit::mistakes_in;
using Messages = std::vector<std::string>;

Registry<Section> sections() {
  Registry<Section> registry;
  register_sections(registry);
  return registry;
}

Messages mistakes(const Schema& schema, const GivenValues& given) {
  return mistakes_in(schema, deck_list(schema, given));
}

std::vector<double> rows(const Mat6& C) {
  const RowMat<6, 6> by_rows = C;
  return {by_rows.data(), by_rows.data() + 36};
}

TEST(SectionTypes, AreRegisteredByName) {
  EXPECT_EQ(sections().names(), (Messages{"Box", "Circle", "Rectangle", "Stiffness Matrix",
                                          "Stiffness Values", "Tube"}));
}

TEST(CircleType, FillsItsShapeWithMaterial) {
  const auto options = deck_list(
      CircleSection::schema(),
      {{"Radius", 0.5}, {"Young Modulus", 2.6e6}, {"Poisson Ratio", 0.3}, {"Density", 8.0}});
  EXPECT_TRUE(mistakes_in(CircleSection::schema(), options).empty());
  const Section section = sections().make("Circle", options);
  const double area = 0.25 * std::numbers::pi;
  EXPECT_NEAR(section.stiffness(2, 2), 2.6e6 * area, 1e-8);
  EXPECT_NEAR(section.stiffness(5, 5), 1e6 * area / 8.0, 1e-8);  // G = 1e6
  EXPECT_NEAR(section.mass(0, 0), 8.0 * area, 1e-14);
  EXPECT_NEAR(section.mass(1, 1), 8.0 * area / 16.0, 1e-14);
}

TEST(CircleType, TakesItsConstantsFromTheDeckWhenGiven) {
  const auto options = deck_list(CircleSection::schema(), {{"Radius", 0.5},
                                                           {"Young Modulus", 1.0},
                                                           {"Shear Modulus", 2.0},
                                                           {"Shear Factor", std::vector{0.5, 0.25}},
                                                           {"Torsion Constant", 7.0}});
  const Section section = CircleSection::make(options);
  const double area = 0.25 * std::numbers::pi;
  EXPECT_NEAR(section.stiffness(0, 0), 0.5 * 2.0 * area, 1e-15);
  EXPECT_NEAR(section.stiffness(1, 1), 0.25 * 2.0 * area, 1e-15);
  EXPECT_NEAR(section.stiffness(5, 5), 14.0, 1e-15);
}

TEST(CircleType, SitsWhereTheDeckPutsIt) {
  const auto options = deck_list(CircleSection::schema(), {{"Radius", 0.5},
                                                           {"Young Modulus", 1.0},
                                                           {"Poisson Ratio", 0.0},
                                                           {"Density", 1.0},
                                                           {"Offset", std::vector{0.3, 0.0}}});
  const Section section = CircleSection::make(options);
  const double area = 0.25 * std::numbers::pi;
  EXPECT_NEAR(section.stiffness(2, 4), -0.3 * area, 1e-15);  // -ES2
  EXPECT_NEAR(section.mass(0, 1), 0.3 * area, 1e-15);        // rhoS2
  EXPECT_NEAR(section.outline[0][0], 0.8, 1e-15);
}

TEST(Shapes, NeedOneOfPoissonRatioAndShearModulus) {
  const Messages one_of{"give one of 'Poisson Ratio' and 'Shear Modulus'"};
  const Schema schema = CircleSection::schema();
  EXPECT_EQ(mistakes(schema, {{"Radius", 1.0}, {"Young Modulus", 1.0}}), one_of);
  EXPECT_EQ(mistakes(schema, {{"Radius", 1.0},
                              {"Young Modulus", 1.0},
                              {"Poisson Ratio", 0.3},
                              {"Shear Modulus", 1.0}}),
            one_of);
  EXPECT_EQ(mistakes(schema, {{"Radius", 1.0}, {"Young Modulus", 9.0}, {"Shear Modulus", 1.0}}),
            Messages{"implies a Poisson ratio of 3.5, outside (-1, 0.5]; give 'Shear Factor' as "
                     "well"});
}

TEST(TubeType, WallIsNotThickerThanTheRadius) {
  EXPECT_EQ(mistakes(TubeSection::schema(), {{"Outer Radius", 0.1},
                                             {"Wall Thickness", 0.2},
                                             {"Young Modulus", 1.0},
                                             {"Poisson Ratio", 0.3}}),
            Messages{"must be <= the outer radius 0.1 m, got 0.2"});
}

TEST(BoxType, WallsLeaveAHole) {
  EXPECT_EQ(mistakes(BoxSection::schema(), {{"Width", 0.2},
                                            {"Height", 0.3},
                                            {"Flange Thickness", 0.02},
                                            {"Web Thickness", 0.1},
                                            {"Young Modulus", 1.0},
                                            {"Poisson Ratio", 0.3}}),
            Messages{"must be < half of 'Width' 0.2 m, got 0.1"});
}

TEST(StiffnessMatrixType, ReadsAllRowsOrTheUpperTriangle) {
  const Mat6 C = kit::Random(1).positive_matrix<6>();
  std::vector<double> triangle;
  for (int i = 0; i < 6; ++i) {
    for (int j = i; j < 6; ++j) triangle.push_back(C(i, j));
  }
  const Schema schema = StiffnessMatrixSection::schema();
  const auto by_rows = deck_list(schema, {{"Stiffness", rows(C)}, {"rhoA", 2.0}});
  EXPECT_TRUE(mistakes_in(schema, by_rows).empty());
  EXPECT_LT((StiffnessMatrixSection::make(by_rows).stiffness - C).norm(), 1e-15);
  EXPECT_EQ(StiffnessMatrixSection::make(by_rows).mass(0, 0), 2.0);
  const auto by_triangle = deck_list(schema, {{"Stiffness", triangle}});
  EXPECT_TRUE(mistakes_in(schema, by_triangle).empty());
  EXPECT_LT((StiffnessMatrixSection::make(by_triangle).stiffness - C).norm(), 1e-15);
}

TEST(StiffnessMatrixType, RefusesWhatIsNoStiffness) {
  const Schema schema = StiffnessMatrixSection::schema();
  EXPECT_EQ(mistakes(schema, {{"Stiffness", std::vector<double>(30, 1.0)}}),
            Messages{"must have 36 values (rows) or 21 values (upper triangle by rows), got 30"});
  Mat6 C = Mat6::Identity();
  C(0, 1) = C(1, 0) = 2.0;
  EXPECT_EQ(mistakes(schema, {{"Stiffness", rows(C)}}),
            Messages{"the stiffness is not positive semidefinite: its smallest eigenvalue, with "
                     "the diagonal scaled to one, is -1"});
  EXPECT_EQ(mistakes(schema, {{"Stiffness", rows(Mat6::Identity())}, {"rhoS1", 1.0}}),
            Messages{"the mass is not positive semidefinite: its smallest eigenvalue, with the "
                     "diagonal scaled to one, is -1"});
}

TEST(StiffnessMatrixType, TakesItsMassAsAMatrixToo) {
  const Mat3 mass = mass_matrix(
      {.rhoA = 3.0, .rhoI1 = 0.5, .rhoI2 = 0.7, .rhoS1 = 0.3, .rhoS2 = -0.2, .rhoI12 = 0.1});
  const Schema schema = StiffnessMatrixSection::schema();
  const GivenValues stiffness{{"Stiffness", rows(Mat6::Identity())}};
  GivenValues given = stiffness;
  given.emplace_back("Mass", rows(full_mass(mass)));
  EXPECT_TRUE(mistakes(schema, given).empty());
  EXPECT_LT((StiffnessMatrixSection::make(deck_list(schema, given)).mass - mass).norm(), 1e-15);
  given = stiffness;
  given.emplace_back("Mass", std::vector<double>(22, 1.0));
  EXPECT_EQ(mistakes(schema, given),
            Messages{"must have 36 values (rows) or 21 values (upper triangle by rows), got 22"});
  given = stiffness;
  given.insert(given.end(), {{"Mass", rows(full_mass(mass))}, {"rhoI2", 0.7}});
  EXPECT_EQ(mistakes(schema, given), Messages{"the mass is given by 'Mass' already"});
}

TEST(StiffnessMatrixType, HasTheOutlineOfTheDeckWhereItIsPlaced) {
  const Schema schema = StiffnessMatrixSection::schema();
  const GivenValues stiffness{{"Stiffness", rows(Mat6::Identity())}};
  for (const std::vector<double>& corners :
       {std::vector{0.0, 0.0, 2.0, 0.0, 0.0, 1.0}, std::vector{0.0, 1.0, 2.0, 0.0, 0.0, 0.0}}) {
    GivenValues given = stiffness;
    given.insert(given.end(), {{"Outline", corners}, {"Offset", std::vector{0.5, 0.0}}});
    EXPECT_TRUE(mistakes(schema, given).empty());
    const auto outline = StiffnessMatrixSection::make(deck_list(schema, given)).outline;
    ASSERT_EQ(outline.size(), 3U);
    const Vec<2> one = outline[1] - outline[0];
    const Vec<2> other = outline[2] - outline[0];
    EXPECT_EQ(one[0] * other[1] - one[1] * other[0], 2.0);  // counter-clockwise
    EXPECT_EQ((outline[0] + outline[1] + outline[2])[0], 3.5);
  }
  GivenValues flat = stiffness;
  flat.emplace_back("Outline", std::vector{0.0, 0.0, 1.0, 1.0, 2.0, 2.0});
  EXPECT_EQ(mistakes(schema, flat), Messages{"encloses no area"});
}

TEST(StiffnessValuesType, PutsEachValueInItsPlace) {
  const Schema schema = StiffnessValuesSection::schema();
  const auto options = deck_list(schema, {{"EA", 10.0},
                                          {"GA1", 11.0},
                                          {"GA2", 12.0},
                                          {"EI1", 13.0},
                                          {"EI2", 14.0},
                                          {"GIp", 15.0},
                                          {"ES1", 0.1},
                                          {"ES2", 0.2},
                                          {"GS1", 0.3},
                                          {"GS2", 0.4},
                                          {"EI12", 0.5},
                                          {"rhoA", 3.0}});
  EXPECT_TRUE(mistakes_in(schema, options).empty());
  const Section section = StiffnessValuesSection::make(options);
  Mat6 expected;
  expected << 11, 0, 0, 0, 0, -0.3,  //
      0, 12, 0, 0, 0, 0.4,           //
      0, 0, 10, 0.1, -0.2, 0,        //
      0, 0, 0.1, 13, -0.5, 0,        //
      0, 0, -0.2, -0.5, 14, 0,       //
      -0.3, 0.4, 0, 0, 0, 15;
  EXPECT_EQ(section.stiffness, expected);
  EXPECT_EQ(section.mass(0, 0), 3.0);
  EXPECT_TRUE(section.outline.empty());
}

}  // namespace
}  // namespace culm::material
