#include "flow_kit.hpp"

#include <cmath>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

namespace culm::flow {
namespace {

using std::numbers::pi;
using testing::ElementsAre;
using testing::HasSubstr;

// Winds with a reference height, at places in deck coordinates.
class Winds : public FlowTest {
 protected:
  SharedFlow gust(const std::string& shape, const kit::GivenValues& more = {}) {
    kit::GivenValues values = {{"Density", 1.225},  {"Speed", 11.4},  {"Height", 90.0},
                               {"Exponent", 0.0},   {"Shape", shape}, {"Class", std::string("1A")},
                               {"Diameter", 126.0}, {"Start", 5.0}};
    values.insert(values.end(), more.begin(), more.end());
    return make("Gust", values);
  }

  SharedFlow table(const std::string& lines, const std::string& format = "CSV") {
    std::ofstream(folder_ / "wind.csv") << lines;
    return make("Table", {{"Density", 1.225},
                          {"File Name", (folder_ / "wind.csv").string()},
                          {"File Format", format},
                          {"Height", 90.0},
                          {"Length", 126.0}});
  }

  const Vec3 hub = Vec3(0.0, 0.0, 90.0);
};

// What rounding of a handful of products leaves of winds of 10 m/s.
void expect_same(const Vec3& actual, const Vec3& expected) {
  EXPECT_LT((actual - expected).norm(), 1e-13) << actual.transpose();
}

TEST_F(Winds, PowerLawGrowsWithHeightAndStopsAtTheGround) {
  const SharedFlow wind =
      make("Power Law", {{"Density", 1.2}, {"Speed", 8.0}, {"Height", 90.0}, {"Exponent", 0.5}});
  expect_same(wind->velocity(hub, 0.0), Vec3(8.0, 0.0, 0.0));
  expect_same(wind->velocity(Vec3(7.0, -3.0, 22.5), 9.0), Vec3(4.0, 0.0, 0.0));
  expect_same(wind->velocity(Vec3(0.0, 0.0, -1.0), 0.0), Vec3::Zero());
}

TEST_F(Winds, KnowWhereTheGroundIs) {
  const Vec3 above(3.0, -7.0, 0.1), at(3.0, -7.0, 0.0), below(0.0, 0.0, -2.0);
  const kit::GivenValues values = {{"Density", 1.2}, {"Speed", 8.0}, {"Height", 90.0}};
  kit::GivenValues power = values, log = values;
  power.emplace_back("Exponent", 0.0);
  log.emplace_back("Roughness", 0.05);
  for (const SharedFlow& wind : {make("Power Law", power), make("Log Law", log), gust("EOG"),
                                 table("0, 10, 0, 0, 0, 0, 0, 0\n")}) {
    EXPECT_TRUE(wind->is_above_ground(above));
    EXPECT_FALSE(wind->is_above_ground(at));
    EXPECT_FALSE(wind->is_above_ground(below));
    EXPECT_EQ(wind->velocity(below, 0.0), Vec3::Zero());
  }
}

TEST_F(Winds, DirectionsNeedNotBeUnitVectors) {
  const SharedFlow wind = make("Power Law", {{"Density", 1.2},
                                             {"Speed", 10.0},
                                             {"Height", 40.0},
                                             {"Exponent", 1.0},
                                             {"Direction", std::vector{0.0, 6.0, 8.0}},
                                             {"Up", std::vector{5.0, 0.0, 0.0}}});
  expect_same(wind->velocity(Vec3(20.0, 1.0, 2.0), 0.0), Vec3(0.0, 3.0, 4.0));
  EXPECT_THAT(mistakes("Power Law", {{"Density", 1.2},
                                     {"Speed", 10.0},
                                     {"Height", 40.0},
                                     {"Exponent", 1.0},
                                     {"Direction", std::vector{0.0, 0.0, -2.0}}}),
              ElementsAre(HasSubstr("must not be parallel")));
}

TEST_F(Winds, GradientsAreThoseOfTheVelocity) {
  const std::vector<double> direction = {3.0, 1.0, 0.4}, up = {0.1, 0.2, 1.0};
  const Vec3 place(12.0, -31.0, 71.0), low(1.0, 2.0, -40.0);
  const kit::GivenValues values = {{"Density", 1.2}, {"Speed", 8.0},
                                   {"Height", 90.0}, {"Direction", direction},
                                   {"Up", up},       {"Function", "growing"}};
  kit::GivenValues power = values, log = values;
  power.emplace_back("Exponent", 0.3);
  log.emplace_back("Roughness", 0.05);
  for (const auto& [type, given] : {std::pair{"Power Law", power}, std::pair{"Log Law", log}}) {
    const SharedFlow wind = make(type, given);
    expect_gradient(*wind, place, 1.5);
    EXPECT_EQ(wind->gradient(low, 1.5).norm(), 0.0) << "below the ground";
  }
  expect_gradient(*table("0, 10, 30, 1, 0.4, 0.2, 0.1, 2\n"), place, 0.0);
  for (const char* shear : {"Vertical", "Horizontal"}) {
    expect_gradient(*gust("EWS", {{"Shear", std::string(shear)}}), place, 9.0);
  }
}

TEST_F(Winds, LogLawVanishesAtTheRoughness) {
  const SharedFlow wind =
      make("Log Law", {{"Density", 1.2}, {"Speed", 8.0}, {"Height", 100.0}, {"Roughness", 0.01}});
  expect_same(wind->velocity(Vec3(0.0, 0.0, 100.0), 0.0), Vec3(8.0, 0.0, 0.0));
  expect_same(wind->velocity(Vec3(0.0, 0.0, 1.0), 0.0), Vec3(4.0, 0.0, 0.0));
  expect_same(wind->velocity(Vec3(0.0, 0.0, 0.005), 0.0), Vec3::Zero());
  EXPECT_THAT(
      mistakes("Log Law", {{"Density", 1.2}, {"Speed", 8.0}, {"Height", 1.0}, {"Roughness", 2.0}}),
      ElementsAre(HasSubstr("less than 'Height'")));
}

TEST_F(Winds, LawsOfTheHeightFollowAFunction) {
  const std::string growing = "growing";  // 2 t
  kit::GivenValues values = {{"Density", 1.2}, {"Speed", 8.0}, {"Height", 100.0}};
  values.insert(values.end(), {{"Function", growing}, {"Exponent", 0.5}});
  const SharedFlow power = make("Power Law", values);
  expect_same(power->velocity(Vec3(0.0, 0.0, 25.0), 1.5), Vec3(12.0, 0.0, 0.0));
  values.back() = {"Roughness", 0.01};
  const SharedFlow logarithmic = make("Log Law", values);
  expect_same(logarithmic->velocity(Vec3(0.0, 0.0, 1.0), 1.5), Vec3(12.0, 0.0, 0.0));
  values[3] = {"Function", std::string("noise")};
  EXPECT_EQ(make("Log Law", values), nullptr);
  EXPECT_THROW(issues_.throw_if_any(), InputError);
}

TEST_F(Winds, TablesAreLinearInTimeHeldOutsideAndJumpAtEqualTimes) {
  const SharedFlow wind = table(
      "# a step at 4 s\n0, 6, 0, 0, 0, 0, 0, 0\n4, 8, 0, 0, 0, 0, 0, 0\n"
      "4, 12, 0, 0, 0, 0, 0, 0\n8, 12, 0, 2, 0, 0, 0, 1\n");
  EXPECT_EQ(wind->velocity(hub, -1.0), Vec3(6.0, 0.0, 0.0));
  EXPECT_EQ(wind->velocity(hub, 1.0), Vec3(6.5, 0.0, 0.0));
  EXPECT_EQ(wind->velocity(hub, 4.0), Vec3(12.0, 0.0, 0.0));
  EXPECT_EQ(wind->velocity(hub, 6.0), Vec3(12.5, 0.0, 1.0));
  EXPECT_EQ(wind->velocity(hub, 99.0), Vec3(13.0, 0.0, 2.0));
}

// By these a motion tells of gusts that its steps pass over.
TEST_F(Winds, TablesNoteTheirSpeedAndDirection) {
  table("0, 6, 0, 0, 0, 0, 0, 1\n4, 8, 0, 0, 0, 0, 0, 1\n4, 12, 90, 0, 0, 0, 0, 1\n");
  const model::Amplitude& speed = model_.functions().at("wind, speed");
  EXPECT_THAT(speed.corners(), ElementsAre(0.0, 4.0));
  EXPECT_EQ(speed.at(2.0), 8.0);
  EXPECT_EQ(speed.at(4.0), 13.0);
  EXPECT_EQ(model_.functions().at("wind, direction").at(4.0), 0.5 * pi);
}

TEST_F(Winds, DirectionsOfTablesTurnClockwiseFromAbove) {
  const SharedFlow wind = table("0, 10, 90, 0, 0.5, 0, 0, 0\n");
  // blows to -y; across it, to the left, is +x, where the shear adds
  expect_same(wind->velocity(Vec3(63.0, 5.0, 90.0), 0.0), Vec3(0.0, -12.5, 0.0));
}

TEST_F(Winds, TablesShearWithHeight) {
  const SharedFlow wind = table("0, 10, 0, 0, 0, 1, 0.2, 0\n");
  expect_same(wind->velocity(Vec3(0.0, 0.0, 153.0), 0.0),
              Vec3(10.0 * 153.0 / 90.0 + 1.0, 0.0, 0.0));
}

TEST_F(Winds, FilesOfOpenFastAreTheSameTables) {
  const SharedFlow wind =
      table("! a comment\n 0 +6 0 0\t0 0 0 0 ! at rest\n\n4 8.0E+00 0 0 0 0 0 1 0\n", "OpenFAST");
  EXPECT_EQ(wind->velocity(hub, 2.0), Vec3(7.5, 0.0, 0.0));
}

TEST_F(Winds, BadTablesNameFileAndLine) {
  const auto objection = [&](const std::string& lines, const std::string& format = "CSV") {
    try {
      table(lines, format);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(objection("0, 6, 0\n"), HasSubstr("wind.csv:1: must be 8 numbers"));
  EXPECT_THAT(objection("1,6,0,0,0,0,0,0\n0,6,0,0,0,0,0,0\n"), HasSubstr("wind.csv:2: times must"));
  EXPECT_THAT(objection("0,6,359,0,0,0,0,0\n1,6,1,0,0,0,0,0\n"),
              HasSubstr("wind.csv:2: from 359 to 1 degrees the wind would turn by more than half a "
                        "turn within a line: write 361, or a line in between where it does so"));
  EXPECT_EQ(objection("0,6,0,0,0,0,0,0\n1,6,180,0,0,0,0,0\n1,6,-179,0,0,0,0,0\n"), "");
  EXPECT_THAT(objection("# nothing\n"), HasSubstr("at least one line"));
  EXPECT_THAT(objection("0 6 0\n", "OpenFAST"), HasSubstr("wind.csv:1: must be 8 numbers"));
  EXPECT_THAT(objection("0 6 0 0 0 0 0 0 5\n", "OpenFAST"), HasSubstr("an upward angle"));
}

// Class 1A, 11.4 m/s, hub 90 m, diameter 126 m: sigma = 0.16 (0.75 11.4 + 5.6) = 2.264 m/s, and
// Lambda = 42 m, so that diameter and length are as 3 to 1.
constexpr double deviation = 2.264;

TEST_F(Winds, OperatingGustDipsRisesAndEnds) {
  const SharedFlow wind = gust("EOG");
  const double size = 3.3 * deviation / 1.3;
  expect_same(wind->velocity(hub, 5.0 + 5.25), Vec3(11.4 + 0.74 * size, 0.0, 0.0));
  expect_same(wind->velocity(hub, 5.0 + 10.5 / 6.0), Vec3(11.4 - 0.185 * size, 0.0, 0.0));
  for (const double time : {4.0, 5.0, 15.5, 20.0})
    expect_same(wind->velocity(hub, time), Vec3(11.4, 0.0, 0.0));
}

TEST_F(Winds, DirectionChangeIsKept) {
  const double full = 4.0 * std::atan(deviation / (11.4 * 1.3));
  const auto turned = [](double angle) {
    return Vec3(11.4 * std::cos(angle), -11.4 * std::sin(angle), 0.0);
  };
  expect_same(gust("EDC")->velocity(hub, 5.0 + 3.0), turned(0.5 * full));
  expect_same(gust("EDC")->velocity(hub, 99.0), turned(full));
  expect_same(gust("EDC", {{"Reversed", true}})->velocity(hub, 99.0), turned(-full));
}

TEST_F(Winds, CoherentGustRisesBy15MetresPerSecondAndTurns) {
  const double angle = 4.0 * pi / 11.4;
  expect_same(gust("ECD")->velocity(hub, 15.0),
              Vec3(26.4 * std::cos(angle), -26.4 * std::sin(angle), 0.0));
  const SharedFlow weak = gust("ECD", {{"Speed", 3.0}});
  expect_same(weak->velocity(hub, 15.0), Vec3(-18.0, 0.0, 0.0));
}

TEST_F(Winds, ShearGustActsUpwardsOrAcross) {
  const double size = 2.5 + 1.28 * deviation * std::pow(3.0, 0.25);
  const Vec3 above = hub + Vec3(0.0, 0.0, 63.0);
  const Vec3 left = hub + Vec3(0.0, 63.0, 0.0);
  const Vec3 more(11.4 + size, 0.0, 0.0);
  const Vec3 same(11.4, 0.0, 0.0);
  expect_same(gust("EWS")->velocity(above, 11.0), more);
  expect_same(gust("EWS")->velocity(left, 11.0), same);
  const SharedFlow across = gust("EWS", {{"Shear", std::string("Horizontal")}});
  expect_same(across->velocity(left, 11.0), more);
  expect_same(across->velocity(above, 11.0), same);
  expect_same(across->velocity(left, 17.0), same);
}

}  // namespace
}  // namespace culm::flow
