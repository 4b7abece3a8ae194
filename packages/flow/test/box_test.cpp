// Boxes of turbulence, from small files of known values.
#include "boxes.hpp"

#include <cstdint>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

namespace culm::flow {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

// What culm should make of it: value minus intercept over slope.
Vec3 decoded(int t, int z, int y) {
  Vec3 u;
  for (int c = 0; c < 3; ++c) u[c] = (written(t, z, y, c) - 50.0 * c) / (100.0 * (c + 1));
  return u;
}

std::string turbsim(std::int16_t kind, std::int32_t tower = 0) {
  std::string bytes;
  put(bytes, kind);
  for (const std::int32_t n : {nz, ny, tower, nx}) put(bytes, n);
  for (const double x : {dz, dy, dt, speed, 90.0, 80.0}) put(bytes, static_cast<float>(x));
  for (int c = 0; c < 3; ++c) {
    put(bytes, 100.0F * static_cast<float>(c + 1));
    put(bytes, 50.0F * static_cast<float>(c));
  }
  put(bytes, std::int32_t{4});
  bytes += "test";
  for (int t = 0; t < nx; ++t) {
    for (int z = 0; z < nz; ++z)
      for (int y = 0; y < ny; ++y)
        for (int c = 0; c < 3; ++c) put(bytes, static_cast<std::int16_t>(written(t, z, y, c)));
    for (int i = 0; i < 3 * tower; ++i) put(bytes, std::int16_t{-7});
  }
  return bytes;
}

class Boxes : public FlowTest {
 protected:
  SharedFlow box(const std::string& bytes, const kit::GivenValues& more = {}) {
    std::ofstream(folder_ / "wind.bts", std::ios::binary) << bytes;
    kit::GivenValues values = {{"Density", 1.225},
                               {"File Name", (folder_ / "wind.bts").string()},
                               {"Centre", std::vector{0.0, 0.0, 90.0}},
                               {"Delay", 0.0}};
    values.insert(values.end(), more.begin(), more.end());
    return make("TurbSim Box", values);
  }

  std::string objection(const std::string& bytes) {
    return refusal([&] { box(bytes); });
  }
};

TEST_F(Boxes, PointsHaveTheirValues) {
  for (const std::int32_t tower : {0, 2}) {
    const SharedFlow wind = box(turbsim(7, tower));
    for (int t = 0; t < nx; ++t)
      for (int z = 0; z < nz; ++z)
        for (int y = 0; y < ny; ++y)
          expect_near(wind->velocity(point(z, y), t * dt), decoded(t, z, y));
  }
}

TEST_F(Boxes, BetweenPointsTheyAreLinear) {
  const SharedFlow wind = box(turbsim(7));
  Vec3 mean = Vec3::Zero();
  for (int t : {1, 2})
    for (int z : {0, 1})
      for (int y : {1, 2}) mean += 0.125 * decoded(t, z, y);
  expect_near(wind->velocity(Vec3(0.0, 5.0, 90.0), 1.5 * dt), mean);
}

TEST_F(Boxes, PlanesTravelWithTheMeanWind) {
  const SharedFlow wind = box(turbsim(7));
  expect_near(wind->velocity(point(0, 1) + Vec3(speed * dt, 0.0, 0.0), 2.0 * dt), decoded(1, 0, 1));
  const SharedFlow delayed = box(turbsim(7), {{"Delay", dt}});
  expect_near(delayed->velocity(point(0, 1), dt), decoded(2, 0, 1));
}

TEST_F(Boxes, TheyTurnWithTheWind) {
  const SharedFlow wind = box(turbsim(7), {{"Direction", std::vector{0.0, 1.0, 0.0}}});
  const Vec3 u = decoded(0, 1, 2);
  // left of a wind to +y is -x
  expect_near(wind->velocity(Vec3(-10.0, 0.0, 100.0), 0.0), Vec3(-u[1], u[0], u[2]));
}

TEST_F(Boxes, GradientsAreThoseOfTheVelocity) {
  const std::vector<double> direction = {1.0, 0.4, 0.1};
  const Vec3 place(0.3, 4.0, 93.0);
  expect_gradient(*box(turbsim(7), {{"Direction", direction}}), place, 1.2 * dt);
  expect_gradient(*box(turbsim(8), {{"Direction", direction}}), place, -2.4 * dt);
  // what is held does not change outwards
  const SharedFlow held = box(turbsim(7), {{"Outside", std::string("Hold")}});
  expect_gradient(*held, Vec3(0.3, 14.0, 93.0), 1.2 * dt);
  EXPECT_EQ(held->gradient(Vec3(0.3, 14.0, 93.0), 1.2 * dt).col(1).norm(), 0.0);
}

TEST_F(Boxes, PeriodicOnesRepeat) {
  const SharedFlow wind = box(turbsim(8));
  expect_near(wind->velocity(point(1, 0), -dt), decoded(3, 1, 0));
  expect_near(wind->velocity(point(1, 0), (4 * 7 + 2) * dt), decoded(2, 1, 0));
  expect_near(wind->velocity(point(1, 0), 3.5 * dt), 0.5 * (decoded(3, 1, 0) + decoded(0, 1, 0)));
}

TEST_F(Boxes, OutsideIsAnErrorThatNamesPlaceAndTimeOrHeld) {
  const SharedFlow strict = box(turbsim(7));
  const auto answer = [&](const Vec3& place, double time) {
    return refusal([&] { strict->velocity(place, time); });
  };
  EXPECT_THAT(answer(Vec3(0.0, 12.0, 90.0), 0.25),
              HasSubstr("the place {0, 12, 90} m at 0.25 s is outside of the box across the wind"));
  EXPECT_THAT(answer(Vec3(0.0, 0.0, 101.0), 0.0), HasSubstr("upwards"));
  EXPECT_THAT(answer(Vec3(0.0, 0.0, 90.0), 1.75), HasSubstr("in time"));
  const SharedFlow held = box(turbsim(7), {{"Outside", std::string("Hold")}});
  expect_near(held->velocity(Vec3(0.0, 99.0, 999.0), 99.0), decoded(3, 1, 2));
}

TEST_F(Boxes, BrokenFilesGiveOneClearError) {
  const std::string whole = turbsim(7);
  EXPECT_THAT(objection(whole.substr(0, 30)), HasSubstr("ends in its header"));
  EXPECT_THAT(objection(whole.substr(0, whole.size() - 1)), HasSubstr("got 143"));
  EXPECT_THAT(objection(whole + "x"), HasSubstr("must hold 144 bytes"));
  EXPECT_THAT(objection(turbsim(9)), HasSubstr("begins with 9, not with 7 or 8"));
  std::string flat = whole;
  std::memset(flat.data() + 2, 0, 4);
  EXPECT_THAT(objection(flat), HasSubstr("number of points upwards must be at least 2, got 0"));
  std::string huge = whole;
  std::memset(huge.data() + 14, 0x7e, 4);
  EXPECT_THAT(objection(huge), HasSubstr("must hold"));
  std::string still = whole;
  std::memset(still.data() + 30, 0, 4);
  EXPECT_THAT(objection(still), HasSubstr("mean speed must be > 0"));
}

// The integers of the file, divided by that, are no numbers in single precision.
TEST_F(Boxes, VelocitiesStayInRange) {
  std::string bytes = turbsim(7);
  const float slope = 1e-38F;
  constexpr std::size_t place = 2 + 4 * 4 + 6 * 4;  // kind, counts, sizes
  std::memcpy(bytes.data() + place, &slope, sizeof(slope));
  EXPECT_THAT(objection(bytes),
              HasSubstr("a slope of 1e-38 makes velocities up to 3.2768e+42 m/s"));
}

}  // namespace
}  // namespace culm::flow
