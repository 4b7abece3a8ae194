#include <culm/deck/units.hpp>

#include <gtest/gtest.h>

#include <numbers>
#include <string>

namespace culm::deck {
namespace {

double si(const std::string& unit, double value = 1.0) {
  const auto found = find_unit(unit);
  EXPECT_TRUE(found) << unit;
  return found ? found->to_si(value) : 0.0;
}

bool same(const std::string& a, const std::string& b) {
  return find_unit(a)->same_dimension(*find_unit(b));
}

TEST(Units, NamesHaveTheirSize) {
  EXPECT_EQ(si("mm"), 1e-3);
  EXPECT_EQ(si("in"), 0.0254);
  EXPECT_EQ(si("t"), 1e3);
  EXPECT_EQ(si("min"), 60.0);
  EXPECT_EQ(si("GPa", 210), 210e9);
  EXPECT_EQ(si("%", 5), 0.05);
  EXPECT_EQ(si("deg", 180), std::numbers::pi);
  EXPECT_DOUBLE_EQ(si("rpm", 60), 2 * std::numbers::pi);
}

TEST(Units, ProductsQuotientsAndPowersAreRead) {
  EXPECT_EQ(si("kg/m^3"), 1.0);
  EXPECT_EQ(si("N mm"), 1e-3);
  EXPECT_EQ(si("kN*m"), 1e3);
  EXPECT_EQ(si("g/cm^3"), 1e3);
  EXPECT_EQ(si("N/mm^2"), si("MPa"));
  EXPECT_EQ(si("m^-1"), 1.0);
  EXPECT_EQ(si("J/(kg K)"), 1.0);
  EXPECT_TRUE(same("N m", "J"));
  EXPECT_TRUE(same("N/m^2", "Pa"));
  EXPECT_TRUE(same("m/s/s", "m/s^2"));
  EXPECT_TRUE(same("1/s", "Hz"));
  EXPECT_TRUE(same("J/s", "W"));
}

TEST(Units, ADivisionHoldsForTheNextUnitOnly) {
  EXPECT_TRUE(same("N/m s", "N s/m"));
  EXPECT_FALSE(same("N/m s", "N/(m s)"));
}

TEST(Units, ConversionOfDecimalsIsExact) {
  for (int i = 1; i < 1000; ++i) {
    EXPECT_EQ(si("mm", i), std::stod(std::to_string(i) + "e-3")) << i;
  }
}

TEST(Units, AngularVelocityIsNoFrequency) { EXPECT_FALSE(same("rad/s", "Hz")); }

TEST(Units, EveryNameIsRead) {
  for (const std::string& name : unit_names()) EXPECT_TRUE(find_unit(name)) << name;
}

TEST(Units, NonsenseIsRefused) {
  for (const char* text :
       {"", " ", "mmm", "m^", "m^x", "m^99", "/m", "m/", "(m", "m)", "m**2", "2", "m^2.5", "µm",
        "((((((((((((((((((m))))))))))))))))))", "(((m^12)^12)^12)^12"}) {
    EXPECT_FALSE(find_unit(text)) << text;
  }
}

}  // namespace
}  // namespace culm::deck
