#include <culm/water/dispersion.hpp>
#include <culm/water/spectrum.hpp>

#include "sea_kit.hpp"

#include <cmath>
#include <numbers>

namespace culm::water {
namespace {

using test::make_sea;
using test::mistakes;
using testing::ElementsAre;
using testing::HasSubstr;

using std::numbers::pi;

// @source fluids C16
TEST(Dispersion, KnownNumbers) {
  const double g = 9.80665;
  EXPECT_NEAR(wave_number(2.0 * pi / 10.0, 20.0, g), 0.05183725, 5e-9);
  EXPECT_NEAR(2.0 * pi / wave_number(2.0 * pi / 10.0, 20.0, g), 121.2098, 5e-5);
  EXPECT_NEAR(wave_number(2.0 * pi / 10.0, 50.0, g), 0.04154100, 5e-9);
  EXPECT_NEAR(wave_number(2.0 * pi / 8.0, 30.0, g), 0.06543241, 5e-9);
}

TEST(Dispersion, HoldsToRoundingFromShallowToDeep) {
  for (double period = 0.1; period < 1000.0; period *= 1.7) {
    for (double depth = 0.01; depth < 1e5; depth *= 3.1) {
      const double omega = 2.0 * pi / period;
      const double k = wave_number(omega, depth, 9.81);
      EXPECT_NEAR(9.81 * k * std::tanh(k * depth) / (omega * omega), 1.0, 1e-14)
          << period << " s, " << depth << " m";
    }
  }
}

std::shared_ptr<const Sea> regular(const std::string& stretching, double depth = 20.0) {
  return make_sea("Regular Waves", {{"Depth", depth},
                                    {"Height", 3.0},
                                    {"Period", 9.0},
                                    {"Phase", 0.3},
                                    {"Direction", std::vector{1.0, 1.0, 0.0}},
                                    {"Level", 2.0},
                                    {"Stretching", stretching}});
}

// Continuity, no vorticity, and accelerations and pressure that belong to the velocities.
TEST(Airy, ObeysTheEquationsOfWater) {
  for (const double depth : {5.0, 20.0, 2000.0}) {
    const auto sea = regular("None", depth);
    const Vec3 x(3.0, -2.0, -1.0);
    const double t = 1.3, h = 1e-4;
    const auto u = [&](const Vec3& dx, double dt) { return sea->motion(x + dx, t + dt); };
    Mat3 gradient;
    Vec3 slope;
    for (int i = 0; i < 3; ++i) {
      const Vec3 dx = h * Vec3::Unit(i);
      gradient.col(i) = (u(dx, 0.0).velocity - u(-dx, 0.0).velocity) / (2.0 * h);
      slope[i] = (u(dx, 0.0).pressure - u(-dx, 0.0).pressure) / (2.0 * h);
    }
    const Vec3 rate = (u(Vec3::Zero(), h).velocity - u(Vec3::Zero(), -h).velocity) / (2.0 * h);
    const WaterMotion here = u(Vec3::Zero(), 0.0);
    EXPECT_NEAR(gradient.trace(), 0.0, 1e-8);
    EXPECT_NEAR((gradient - gradient.transpose()).norm(), 0.0, 1e-8);
    EXPECT_NEAR((here.acceleration - rate).norm(), 0.0, 1e-7);
    EXPECT_NEAR((sea->density() * here.acceleration + slope).norm(), 0.0, 1e-4);
  }
}

TEST(Airy, SurfaceMovesWithTheWaterAndCarriesItsPressure) {
  const auto sea = regular("None");
  const Vec3 x(3.0, -2.0, 2.0);  // at still water
  const double t = 1.3, h = 1e-5;
  const double rise = (sea->elevation(x, t + h) - sea->elevation(x, t - h)) / (2.0 * h);
  EXPECT_NEAR(sea->motion(x, t).velocity[2], rise, 1e-8);
  EXPECT_NEAR(sea->motion(x, t).pressure, 1025.0 * 9.81 * sea->elevation(x, t), 1e-9 * 1e4);
  EXPECT_NEAR(sea->motion(Vec3(3.0, -2.0, -18.0), t).velocity[2], 0.0, 1e-15);
}

TEST(Airy, StretchingTakesTheSurfaceOfTheTheoryUp) {
  const double t = 0.4;
  const Vec3 still(3.0, -2.0, 2.0), bed(3.0, -2.0, -18.0);
  const auto wheeler = regular("Wheeler"), vertical = regular("Vertical"), none = regular("None");
  const double eta = none->elevation(still, t);
  const Vec3 crest = still + Vec3(0.0, 0.0, eta);
  ASSERT_GT(eta, 0.5);
  const Vec3 top = none->motion(still, t).velocity;
  EXPECT_EQ(vertical->motion(crest, t).velocity, top);
  EXPECT_NEAR((wheeler->motion(crest, t).velocity - top).norm(), 0.0, 1e-14);
  EXPECT_NEAR((wheeler->motion(bed, t).velocity - none->motion(bed, t).velocity).norm(), 0.0,
              1e-14);
  EXPECT_EQ(none->wet_to(still, t), 0.0);
  EXPECT_EQ(wheeler->wet_to(still, t), eta);
}

// Pieces of 2 m: across the surface and the bed, at a crest and lying.
TEST(Airy, PiecesAreWetBetweenBedAndSurface) {
  const auto still = test::make_sea("Still Water", {{"Depth", 20.0}, {"Level", 3.0}});
  const auto share = [&](double z, const Vec3& extent) {
    return still->share_within(Vec3(1.0, 2.0, z), extent, 0.0);
  };
  EXPECT_EQ(share(0.0, Vec3::UnitZ()), 1.0);
  EXPECT_NEAR(share(3.0, Vec3::UnitZ()), 0.5, 1e-15);
  EXPECT_NEAR(share(3.5, -Vec3::UnitZ()), 0.25, 1e-15);
  EXPECT_NEAR(share(3.2, Vec3(0.8, 0.0, 0.6)), 1.0 / 3.0, 1e-14);
  EXPECT_EQ(share(4.1, Vec3::UnitZ()), 0.0);
  EXPECT_NEAR(share(-17.0, Vec3::UnitZ()), 0.5, 1e-15);
  EXPECT_EQ(share(3.11, Vec3::UnitX()), 0.0);
  const auto waves = test::make_sea(
      "Regular Waves", {{"Depth", 20.0}, {"Height", 2.0}, {"Period", 8.0}, {"Phase", 0.0}});
  EXPECT_NEAR(waves->share_within(Vec3(0.0, 0.0, 1.0), Vec3::UnitZ(), 0.0), 0.5, 1e-12);
}

TEST(Airy, PushIsTheGradientOfThePressure) {
  const double t = 0.4, h = 1e-4;
  for (const char* stretching : {"None", "Vertical", "Wheeler"}) {
    const auto sea = regular(stretching);
    const double above = std::string(stretching) == "None" ? -0.5 : 0.3;
    for (const Vec3& x : {Vec3(3.0, -2.0, -6.0), Vec3(4.0, 1.0, 2.0 + above)}) {
      Vec3 slope;
      for (int i = 0; i < 3; ++i) {
        const Vec3 dx = h * Vec3::Unit(i);
        slope[i] = (sea->motion(x + dx, t).pressure - sea->motion(x - dx, t).pressure) / (2.0 * h);
      }
      EXPECT_NEAR((sea->density() * sea->motion(x, t).push + slope).norm(), 0.0, 1e-3)
          << stretching;
    }
  }
}

// A point with Wheeler, when the surface passes still water. @source fluids C17, welib's test
TEST(Airy, InertiaOfALargeCylinderAtTheSurface) {
  const auto sea = make_sea(
      "Regular Waves", {{"Depth", 30.0}, {"Height", 6.0}, {"Period", 12.0}, {"Phase", 0.5 * pi}});
  const double load = 1025.0 * 2.0 * pi * 9.0 * sea->motion(Vec3::Zero(), 0.0).acceleration[0];
  EXPECT_NEAR(load, 60539.634967, 1e-5);
}

TEST(Airy, WavesDoNotReachTheBedOfDeepWater) {
  const auto sea = make_sea("Regular Waves", {{"Depth", 5000.0}, {"Height", 0.1}, {"Period", 1.5}});
  for (const double z : {-100.0, -2000.0, -4999.0, -5000.0}) {
    const WaterMotion water = sea->motion(Vec3(0.0, 0.0, z), 0.3);
    EXPECT_NEAR(water.velocity.norm() + water.acceleration.norm() + water.pressure, 0.0, 1e-40);
  }
}

TEST(Airy, WavesRiseAsTheyAreTold) {
  const auto sea = make_sea("Regular Waves",
                            {{"Depth", 30.0}, {"Height", 6.0}, {"Period", 12.0}, {"Rise", 24.0}});
  EXPECT_EQ(sea->elevation(Vec3::Zero(), 0.0), 0.0);
  EXPECT_NEAR(sea->elevation(Vec3::Zero(), 12.0), 1.5, 1e-13);
  EXPECT_NEAR(sea->elevation(Vec3::Zero(), 24.0), 3.0, 1e-13);
}

TEST(RegularWaves, BreakAndAreRefused) {
  EXPECT_THAT(mistakes("Regular Waves", {{"Depth", 5.0}, {"Height", 6.0}, {"Period", 8.0}}),
              ElementsAre(HasSubstr("break above 4.004")));
}

TEST(IrregularWaves, BreakAndAreRefused) {
  EXPECT_THAT(mistakes("Irregular Waves", {{"Depth", 30.0}, {"Height", 100.0}, {"Period", 9.0}}),
              ElementsAre(HasSubstr("break above 15.32")));
}

// @source fluids C17
TEST(Spectrum, KnownNumbers) {
  const SeaState young{6.0, 10.0, 3.3}, grown{6.0, 10.0, 1.0};
  EXPECT_NEAR(jonswap(young, 0.1), 69.91836, 5e-6);
  EXPECT_NEAR(jonswap(grown, 0.1), 32.23179, 5e-6);
  for (const SeaState& sea : {young, grown}) {
    double m0 = 0.0, m2 = 0.0;
    const double part = 1e-4;
    for (int i = 0; i < 200000; ++i) {
      const double f = (i + 0.5) * part;
      m0 += part * jonswap(sea, f);
      m2 += part * f * f * jonswap(sea, f);
    }
    EXPECT_NEAR(4.0 * std::sqrt(m0), sea.peak > 1.0 ? 6.00724 : 6.00000, 5e-6);
    // the tail of f^2 S falls with f^-3 and ends at 20 Hz here
    EXPECT_NEAR(std::sqrt(m0 / m2), sea.peak > 1.0 ? 7.7740 : 7.1037, 1e-3);
  }
  EXPECT_EQ(usual_peak(9.0, 10.0), 5.0);
  EXPECT_EQ(usual_peak(4.0, 10.0), 1.0);
  EXPECT_NEAR(usual_peak(4.0, 8.0), std::exp(5.75 - 1.15 * 4.0), 1e-14);
}

kit::GivenValues storm(int seed) {
  return {{"Depth", 50.0}, {"Height", 6.0}, {"Period", 10.0}, {"Seed", seed}, {"Waves", 300}};
}

TEST(IrregularWaves, HaveTheHeightThatIsAskedFor) {
  const auto sea = make_sea("Irregular Waves", storm(1));
  double variance = 0.0;
  for (const Wave& wave : sea->waves()) variance += 0.5 * wave.amplitude * wave.amplitude;
  EXPECT_NEAR(4.0 * std::sqrt(variance), 6.0, 1e-13);
  // and so do five hours of the surface: its variance varies by some parts in a hundred
  double sum = 0.0, squares = 0.0;
  const int count = 18000;
  for (int i = 0; i < count; ++i) {
    const double eta = sea->elevation(Vec3::Zero(), i);
    sum += eta;
    squares += eta * eta;
  }
  EXPECT_NEAR(sum / count, 0.0, 0.02);
  EXPECT_NEAR(4.0 * std::sqrt(squares / count), 6.0, 0.1);
}

TEST(IrregularWaves, GoWhereTheyAreTold) {
  kit::GivenValues values = storm(1);
  values.emplace_back("Direction", std::vector{3.0, 4.0, 1.0});
  const auto sea = make_sea("Irregular Waves", values);
  for (const Wave& wave : sea->waves()) {
    EXPECT_NEAR((wave.direction - Vec3(0.6, 0.8, 0.0)).norm(), 0.0, 1e-15);
    EXPECT_EQ(wave.number, wave_number(wave.frequency, 50.0, 9.81));
  }
}

// The shares of the energy along and across the main direction are (n + 1) / (n + 2) and 1 / (n +
// 2) of a density cos^n, and (1 +- s (s - 1) / ((s + 1) (s + 2))) / 2 of one cos^2s of half the
// angle.
// @source DNV-RP-C205, section 3.5.8; moments of Longuet-Higgins, Cartwright and Smith (1963)
TEST(IrregularWaves, SpreadAsTheyAreTold) {
  const auto shares = [](double exponent, double range) {
    kit::GivenValues values = storm(1);
    values.emplace_back("Direction", std::vector{3.0, 4.0, 0.0});
    values.emplace_back("Spreading", exponent);
    values.emplace_back("Spreading Range", range);
    const auto sea = make_sea("Irregular Waves", values);
    Vec3 sums = Vec3::Zero();
    for (const Wave& wave : sea->waves()) {
      const double along = wave.direction.dot(Vec3(0.6, 0.8, 0.0));
      const double across = wave.direction.dot(Vec3(-0.8, 0.6, 0.0));
      EXPECT_NEAR(wave.direction.norm(), 1.0, 1e-14);
      sums += 8.0 / 36.0 * wave.amplitude * wave.amplitude *
              Vec3(along * along, across * across, along * across);
    }
    return sums;
  };
  for (const double n : {0.0, 2.0, 4.0, 10.0, 60.0}) {
    const Vec3 found = shares(n, pi);
    EXPECT_NEAR(found[0], (n + 1.0) / (n + 2.0), 0.01) << n;
    EXPECT_NEAR(found[1], 1.0 / (n + 2.0), 0.01) << n;
    EXPECT_NEAR(found[2], 0.0, 0.01) << n;
  }
  for (const double s : {1.0, 5.0, 20.0}) {
    const double second = s * (s - 1.0) / ((s + 1.0) * (s + 2.0));
    EXPECT_NEAR(shares(2.0 * s, 2.0 * pi)[0], 0.5 * (1.0 + second), 0.01) << s;
  }
}

TEST(IrregularWaves, RangeNeedsSpreading) {
  kit::GivenValues values = storm(1);
  values.emplace_back("Spreading Range", 1.0);
  EXPECT_THAT(mistakes("Irregular Waves", values), ElementsAre("needs 'Spreading'"));
}

TEST(IrregularWaves, FollowFromTheirSeed) {
  const auto one = make_sea("Irregular Waves", storm(1)),
             same = make_sea("Irregular Waves", storm(1)),
             other = make_sea("Irregular Waves", storm(2));
  EXPECT_EQ(one->elevation(Vec3::Zero(), 7.0), same->elevation(Vec3::Zero(), 7.0));
  EXPECT_GT(std::abs(one->elevation(Vec3::Zero(), 7.0) - other->elevation(Vec3::Zero(), 7.0)), 0.1);
  // of the generator alone, so of every machine
  EXPECT_DOUBLE_EQ(one->waves()[0].phase, 2.0 * pi * 0.9140224628703029);
}

TEST(IrregularWaves, MustHaveTheirPeak) {
  kit::GivenValues values = storm(1);
  values.emplace_back("Lowest", 0.2);
  EXPECT_THAT(mistakes("Irregular Waves", values), ElementsAre(HasSubstr("peak, 0.1 Hz")));
  values = storm(1);
  values.emplace_back("Spectrum", std::string("Pierson Moskowitz"));
  values.emplace_back("Peak", 3.3);
  EXPECT_THAT(mistakes("Irregular Waves", values), ElementsAre(HasSubstr("leave it out")));
  values = storm(1);
  values.emplace_back("Highest", 79.6);
  EXPECT_THAT(mistakes("Irregular Waves", values),
              ElementsAre(HasSubstr("300 waves up to 79.6 Hz are 0.265 Hz apart")));
}

TEST(WaveComponents, AddUp) {
  const kit::GivenValues both = {{"Depth", 30.0},
                                 {"Periods", std::vector{8.0, 11.0}},
                                 {"Heights", std::vector{2.0, 3.0}},
                                 {"Phases", std::vector{0.1, 0.7}},
                                 {"Turns", std::vector{0.0, 0.5 * pi}}};
  const auto sea = make_sea("Wave Components", both);
  const auto first = make_sea("Regular Waves",
                              {{"Depth", 30.0}, {"Height", 2.0}, {"Period", 8.0}, {"Phase", 0.1}});
  const auto second = make_sea("Regular Waves", {{"Depth", 30.0},
                                                 {"Height", 3.0},
                                                 {"Period", 11.0},
                                                 {"Phase", 0.7},
                                                 {"Direction", std::vector{0.0, 1.0, 0.0}}});
  const Vec3 x(5.0, 8.0, -4.0);
  EXPECT_NEAR(sea->elevation(x, 3.0), first->elevation(x, 3.0) + second->elevation(x, 3.0), 1e-14);
  kit::GivenValues wrong = both;
  wrong[2].second = std::vector{2.0};
  EXPECT_THAT(mistakes("Wave Components", wrong),
              ElementsAre(HasSubstr("one value for each of 2 'Periods', got 1")));
}

TEST(Current, FollowsItsProfile) {
  const Vec3 along = Vec3::UnitY();
  EXPECT_EQ(Current().at(-3.0), Vec3::Zero());
  EXPECT_EQ(Current(0.5 * along, 0.0, 20.0).at(-3.0), 0.5 * along);
  const Current grown(0.5 * along, 1.0 / 7.0, 20.0);
  EXPECT_EQ(grown.at(1.0), 0.5 * along);
  EXPECT_NEAR(grown.at(-10.0)[1], 0.5 * std::pow(0.5, 1.0 / 7.0), 1e-15);
  EXPECT_EQ(grown.at(-20.0), Vec3::Zero());
  const Current table(along, {1.0, 5.0, 9.0}, {1.0, 0.6, 0.2});
  EXPECT_NEAR(table.at(0.0)[1], 1.0, 1e-15);
  EXPECT_NEAR(table.at(-3.0)[1], 0.8, 1e-15);
  EXPECT_NEAR(table.at(-8.0)[1], 0.3, 1e-15);
  EXPECT_NEAR(table.at(-50.0)[1], 0.2, 1e-15);
}

}  // namespace
}  // namespace culm::water
