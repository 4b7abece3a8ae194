#include "strip_kit.hpp"

#include <culm_kit/temporary_folder.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

namespace culm::strip {
namespace {

using namespace test;
using std::numbers::pi;

constexpr double degree = pi / 180.0;

// A polar with the features of real ones: camber, stall at 12 degrees on one side and -10 on the
// other, deep stall, lift that comes back.
kit::GivenValues stalling() {
  std::vector<double> angles, lift, drag, moment;
  const double rows[][4] = {{-180, 0, .02, 0},    {-90, -.1, 1.4, .3},  {-45, -.8, .8, .2},
                            {-20, -.7, .25, .05}, {-10, -.8, .02, 0},   {-4, -.05, .01, -.08},
                            {0, .4, .009, -.09},  {5, .95, .01, -.1},   {9, 1.3, .014, -.1},
                            {12, 1.4, .03, -.09}, {16, 1.1, .12, -.12}, {25, .8, .35, -.2},
                            {45, 1.0, .9, -.3},   {90, .1, 1.4, -.4},   {180, 0, .02, 0}};
  for (const auto& row : rows) {
    angles.push_back(row[0] * degree);
    lift.push_back(row[1]);
    drag.push_back(row[2]);
    moment.push_back(row[3]);
  }
  angles.front() = -pi;
  angles.back() = pi;
  return {{"Angles", angles}, {"Lift", lift}, {"Drag", drag}, {"Moment", moment}};
}

SharedAirfoil polar() { return airfoil("Polar", stalling()); }

// The lift of a steady flow is that of its attached and its separated share.
TEST(Separations, GiveBackTheLiftOfTheSteadyFlow) {
  const SharedAirfoil airfoil = polar();
  ASSERT_NE(airfoil->separation(), nullptr);
  const Separation& separation = *airfoil->separation();
  EXPECT_NEAR(separation.zero_lift, (-4.0 + 4.0 / 9.0) * degree, 1e-14);
  for (double alpha = -1.0; alpha < 1.0; alpha += 0.003) {
    Coefficients slope;
    const double lift = airfoil->at(alpha, slope)[0];
    const Attachment found = separation.at(alpha, lift, slope[0]);
    EXPECT_GE(found.share, 0.0);
    EXPECT_LE(found.share, 1.0);
    EXPECT_NEAR(found.share * separation.attached(alpha) + (1.0 - found.share) * found.separated,
                lift, 1e-14)
        << alpha;
  }
}

TEST(Separations, HaveTheDerivativesThatTheySay) {
  const SharedAirfoil airfoil = polar();
  const double h = 1e-6;
  for (double alpha = -0.33; alpha < 0.5; alpha += 0.0171) {
    const auto at = [&](double angle) {
      Coefficients slope;
      const double lift = airfoil->at(angle, slope)[0];
      return airfoil->separation()->at(angle, lift, slope[0]);
    };
    const Attachment low = at(alpha - h), here = at(alpha), high = at(alpha + h);
    EXPECT_NEAR(here.share_slope, (high.share - low.share) / (2 * h), 1e-6) << alpha;
    EXPECT_NEAR(here.separated_slope, (high.separated - low.separated) / (2 * h), 1e-6) << alpha;
  }
}

TEST(Separations, AreNoneWithoutLift) {
  const SharedAirfoil cylinder = airfoil(
      "Polar", {{"Angles", std::vector{-pi, 0.0, pi}}, {"Lift", std::vector{0.0, 0.0, 0.0}}});
  EXPECT_EQ(cylinder->separation(), nullptr);
}

class Stalls : public testing::TestWithParam<Stall> {
 protected:
  static StripModel kind() {
    return {GetParam() == Stall::four_states ? Lag::airfoil() : Lag{}, false, GetParam()};
  }
  static Station station(double blend) {
    Station one = section(1.2, 0.33, polar());
    one.next_airfoil = airfoil("Thin", {{"Drag", 0.02}});
    one.blend = blend;
    return one;
  }
  static void fill(model::Model& model, double speed, double blend) {
    for (const int seed : {10, 11}) model.nodes().add(kit::random_node(seed));
    auto load = std::make_unique<StripLoad>(
        effect, model.nodes(), model::Amplitude::constant(),
        std::make_shared<Wind>(1.3, speed * Vec3(9.0, 4.0, -3.0)), kind());
    Station one = station(blend);
    one.point = {{0, 1}, {0.3, 0.7}, Vec3(0.02, -0.01, 0.0)};
    load->add(one);
    model.add_load(std::move(load));
  }
};

TEST_P(Stalls, TangentIsDerivativeOfResidual) {
  for (const double speed : {0.5, 1.0, 3.0}) {
    for (const double blend : {0.0, 0.4}) {
      SCOPED_TRACE(testing::Message() << speed << " " << blend);
      kit::expect_tangent_is_derivative([&](model::Model& model) { fill(model, speed, blend); },
                                        effect, 2e-4);
    }
  }
}

TEST_P(Stalls, AssembleAllocatesNothing) {
  kit::expect_no_allocation([](model::Model& model) { fill(model, 1.0, 0.4); }, effect);
}

TEST_P(Stalls, AttemptsLeaveNoTrace) {
  kit::expect_attempts_leave_no_trace([](model::Model& model) { fill(model, 1.0, 0.4); }, effect);
}

// A plate at rest: statics, and any time after long enough, give the polar.
TEST_P(Stalls, EndInTheSteadyFlow) {
  const double speed = 30.0;
  for (const double angle : {-20.0, -3.0, 4.0, 11.0, 15.0, 30.0, 47.0, 60.0}) {
    const double alpha = angle * degree;
    MovedSection plate(station(0.0), kind(), 1.2, speed * Vec3(std::cos(alpha), std::sin(alpha), 0),
                       0.5);
    plate.start(placed(0, 0, 0), model::Coordinates(12, 0.0));
    for (int n = 0; n < 400; ++n) plate.go(placed(0, 0, 0));
    Coefficients slope;
    const Coefficients expected = polar()->at(alpha, slope);
    EXPECT_LT((plate.load().state(0)->coefficients - expected).norm(), 1e-9) << angle;
    plate.resultant(Stencil::statics());
    plate.load().accept(plate.state());
    EXPECT_LT((plate.load().state(0)->coefficients - expected).norm(), 1e-12) << angle;
  }
}

// Up and down through stall the lift is not the same: more on the way up.
TEST_P(Stalls, MakeLoops) {
  const double speed = 30.0, omega = 5.0, step = 2.0 * pi / omega / 400.0;  // k = 0.1
  MovedSection plate(station(0.0), kind(), 1.2, Vec3(speed, 0, 0), step);
  plate.start(placed(0, 0, 13 * degree), model::Coordinates(12, 0.0));
  double up = 0.0, down = 0.0;
  for (int n = 1; n <= 1600; ++n) {
    plate.go(placed(0, 0, (13 + 6 * std::sin(omega * step * n)) * degree));
    if (n == 1200) up = plate.load().state(0)->coefficients[0];
    if (n == 1400) down = plate.load().state(0)->coefficients[0];
  }
  EXPECT_GT(up, down + 0.1);
}

INSTANTIATE_TEST_SUITE_P(Strip, Stalls, testing::Values(Stall::oye, Stall::four_states));

// C26: from attached to the share of the steady flow, with the time 6 c / 2 V.
TEST(Stall, OyesShareFollowsExponentially) {
  const double chord = 3.0, speed = 60.0, alpha = 14.0 * degree, step = 0.01;
  MovedSection plate(section(chord, 0.25, polar()), {Lag{}, false, Stall::oye}, 1.2,
                     speed * Vec3(std::cos(alpha), std::sin(alpha), 0), step);
  plate.start(placed(0, 0, 0), model::Coordinates(12, 0.0));
  Coefficients slope;
  const double lift = polar()->at(alpha, slope)[0];
  const double end = polar()->separation()->at(alpha, lift, slope[0]).share;
  for (int n = 1; n <= 10; ++n) plate.go(placed(0, 0, 0));
  const double T = 6.0 * chord / (2.0 * speed);
  EXPECT_NEAR(plate.load().state(0)->attached, end + (1.0 - end) * std::exp(-0.1 / T), 1e-14);
  EXPECT_NEAR(0.4 + 0.6 * std::exp(-0.1 / T), 0.708050, 1e-6);
}

// Of a plate of two airfoils that stall, each kind of states counts once.
TEST(Stall, DelaysAreThoseOfItsStates) {
  const double chord = 3.0, speed = 60.0, alpha = 14.0 * degree, half = chord / (2.0 * speed);
  const auto delays = [&](StripModel kind) {
    Station station = section(chord, 0.25, polar());
    station.next_airfoil = polar();
    station.blend = 0.3;
    MovedSection plate(station, kind, 1.2, speed * Vec3(std::cos(alpha), std::sin(alpha), 0), 0.1);
    plate.start(placed(0, 0, 0), model::Coordinates(12, 0.0));
    return plate.load().delays(plate.state());
  };
  const auto near = [&](double relative) { return testing::DoubleNear(relative * half, 1e-14); };
  EXPECT_THAT(delays({Lag{}, false, Stall::oye}), testing::ElementsAre(near(6.0)));
  EXPECT_THAT(delays({Lag::airfoil(), false, Stall::four_states}),
              testing::ElementsAre(near(1.0 / 0.14), near(1.0 / 0.53), near(1.7), near(3.0)));
  // what has the time of a state of the lag moves away from it
  const Lag same{1, {1.0, 0.0}, {1.0 / 1.7, 1.0}};
  const std::vector<double> apart = delays({same, false, Stall::four_states});
  ASSERT_EQ(apart.size(), 3U);
  EXPECT_NEAR(apart[1] / apart[0], 1.0002, 1e-9);
}

class AeroDynFiles : public testing::Test {
 protected:
  SharedAirfoil read(const std::string& text) {
    std::ofstream(folder_ / "polar.dat") << text;
    AirfoilRegistry registry;
    register_airfoils(registry);
    Options options = kit::deck_list(
        registry.variants().at("Polar"),
        {{"File Name", (folder_ / "polar.dat").string()}, {"File Format", std::string("AeroDyn")}});
    return registry.make("Polar", options);
  }
  std::string mistake(const std::string& text) {
    try {
      read(text);
    } catch (const InputError& error) {
      return error.what();
    }
    return {};
  }
  kit::TemporaryFolder folder_;
  const std::string head_ = "! a comment\n  1   NumTabs  ! tables\n \"DEFAULT\" InterpOrd\n";
  const std::string rows_ = "!  Alpha Cl Cd Cm\n!\n-180 0 .1 0\n 0 .2 .01 -.05\n 180.0 0 .1 0\n";
};

TEST_F(AeroDynFiles, AreRead) {
  const SharedAirfoil airfoil = read(head_ + "  3  NumAlf ! rows\n" + rows_);
  Coefficients slope;
  EXPECT_LT((airfoil->at(0.5 * pi, slope) - Coefficients(0.1, 0.055, -0.025)).norm(), 1e-15);
}

TEST_F(AeroDynFiles, SayWhatIsWrong) {
  using testing::HasSubstr;
  EXPECT_THAT(mistake(head_ + "4 NumAlf\n" + rows_), HasSubstr("3 of 4 rows"));
  EXPECT_THAT(mistake(head_ + rows_), HasSubstr("NumAlf"));
  EXPECT_THAT(mistake("2 NumTabs\n"), HasSubstr("must be 1"));
  EXPECT_THAT(mistake(head_ + "3 NumAlf\n-180 0 x 0\n"), HasSubstr("angle in degrees"));
  EXPECT_THAT(mistake(head_ + "3 NumAlf\n-170 0 0 0\n0 0 0 0\n180 0 0 0\n"), HasSubstr("-180"));
}

}  // namespace
}  // namespace culm::strip
