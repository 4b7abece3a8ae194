// Boxes of three files, from small files of known values.
#include "boxes.hpp"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

namespace culm::flow {
namespace {

using testing::HasSubstr;

// A number of its own for each value; y counts from the right, seen along the wind.
float stored(int c, int x, int y, int z) {
  return static_cast<float>(std::sin(1.0 + 17 * c + 5.0 * x + 3.0 * y + 7.0 * z));
}
Vec3 known(int x, int y, int z) {
  return {stored(0, x, y, z), stored(1, x, y, z), stored(2, x, y, z)};
}

class MannBoxes : public FlowTest {
 protected:
  MannBoxes() {
    for (int c = 0; c < 3; ++c) {
      std::ofstream file(path(c), std::ios::binary);
      for (int x = 0; x < nx; ++x)
        for (int y = ny - 1; y >= 0; --y)
          for (int z = 0; z < nz; ++z) {
            const float value = stored(c, x, y, z);
            file.write(reinterpret_cast<const char*>(&value), sizeof(value));
          }
    }
  }

  std::filesystem::path path(int c) const { return folder_ / ("box_" + std::to_string(c)); }

  SharedFlow box(const kit::GivenValues& more = {}) {
    kit::GivenValues values = {
        {"Density", 1.225},
        {"File Names", std::vector{path(0).string(), path(1).string(), path(2).string()}},
        {"Points", std::vector{nx, ny, nz}},
        {"Spacing", std::vector{dx, dy, dz}},
        {"Centre", std::vector{0.0, 0.0, height}},
        {"Speed", speed},
        {"Height", height},
        {"Delay", 0.0}};
    values.insert(values.end(), more.begin(), more.end());
    return make("Mann Box", values);
  }

  std::string objection(const kit::GivenValues& more = {}) {
    return refusal([&] { box(more); });
  }
};

TEST_F(MannBoxes, FluctuationsAreAddedToTheMeanWind) {
  const SharedFlow wind = box();
  for (int x = 0; x < nx; ++x)
    for (int y = 0; y < ny; ++y)
      for (int z = 0; z < nz; ++z) {
        const Vec3 place = point(z, y);
        const Vec3 mean(speed * std::pow(place[2] / height, 0.2), 0.0, 0.0);
        const Vec3 found = wind->velocity(place, x * dt);
        EXPECT_LT((found - mean - known(x, y, z)).norm(), 1e-6) << x << y << z;
      }
}

TEST_F(MannBoxes, GradientsHaveThatOfTheMeanWind) {
  const Vec3 place = 0.4 * point(0, 0) + 0.6 * point(1, 1);
  expect_gradient(*box(), place, 0.3 * dt);
  expect_gradient(*box({{"Roughness", 0.1}}), place, 0.3 * dt);
}

TEST_F(MannBoxes, TheyRepeatAlongTheWind) {
  const SharedFlow wind = box();
  const double period = nx * dt;
  for (const double time : {0.1, 0.7, 1.9}) {
    EXPECT_LT((wind->velocity(point(0, 1), time) - wind->velocity(point(0, 1), time + 3.0 * period))
                  .norm(),
              1e-6);
  }
}

TEST_F(MannBoxes, DeviationsAreThoseAskedFor) {
  const SharedFlow wind = box({{"Exponent", 0.0}, {"Deviations", std::vector{2.0, 0.0, 0.5}}});
  Vec3 sum = Vec3::Zero();
  Vec3 squares = Vec3::Zero();
  for (int x = 0; x < nx; ++x)
    for (int y = 0; y < ny; ++y)
      for (int z = 0; z < nz; ++z) {
        const Vec3 u = wind->velocity(point(z, y), x * dt) - Vec3(speed, 0.0, 0.0);
        sum += u;
        squares += u.cwiseProduct(u);
      }
  constexpr double count = nx * ny * nz;
  const Vec3 variance = squares / count - (sum / count).cwiseProduct(sum / count);
  EXPECT_NEAR(variance[0], 4.0, 1e-5);
  EXPECT_EQ(variance[1], 0.0);
  EXPECT_NEAR(variance[2], 0.25, 1e-6);
  EXPECT_THAT(objection({{"Deviations", std::vector{1e300, 0.0, 0.0}}}),
              HasSubstr("component 1 of the box cannot be scaled to"));
}

TEST_F(MannBoxes, MeansOfPointsAreTakenAwayIfAskedFor) {
  const SharedFlow wind = box({{"Without Means", true}, {"Factors", std::vector{2.0, 1.0, 1.0}}});
  for (int y = 0; y < ny; ++y)
    for (int z = 0; z < nz; ++z) {
      double mean = 0.0;
      for (int x = 0; x < nx; ++x) mean += known(x, y, z)[0] / nx;
      const Vec3 profile(speed * std::pow(point(z, y)[2] / height, 0.2), 0.0, 0.0);
      const Vec3 rest = wind->velocity(point(z, y), dt) - profile;
      EXPECT_NEAR(rest[0], 2.0 * (known(1, y, z)[0] - mean), 1e-5);
      EXPECT_NEAR(rest[1], known(1, y, z)[1], 1e-6);
    }
}

TEST_F(MannBoxes, FactorsAndALogarithmicMeanWindStandInPlaceOfTheOthers) {
  const SharedFlow wind = box({{"Roughness", 0.05}, {"Factors", std::vector{2.0, 0.0, 0.5}}});
  const Vec3 place = point(1, 1);
  const double mean = speed * std::log(place[2] / 0.05) / std::log(height / 0.05);
  const Vec3 expected = Vec3(mean, 0.0, 0.0) + known(0, 1, 1).cwiseProduct(Vec3(2.0, 0.0, 0.5));
  EXPECT_LT((wind->velocity(place, 0.0) - expected).norm(), 1e-6);
}

TEST_F(MannBoxes, FilesThatDoNotFitAreRefused) {
  EXPECT_THAT(objection({{"Points", std::vector{5, ny, nz}}}),
              HasSubstr("must hold 120 bytes by the 'Points' of the deck, got 96"));
  std::fstream file(path(1), std::ios::binary | std::ios::in | std::ios::out);
  const float wrong = std::numeric_limits<float>::quiet_NaN();
  file.seekp(4 * 7);
  file.write(reinterpret_cast<const char*>(&wrong), sizeof(wrong));
  file.close();
  EXPECT_THAT(objection(), HasSubstr("box_1: value 7 of 24 is no finite number"));
  std::filesystem::remove(path(2));
  EXPECT_THAT(objection({}), HasSubstr("box_1"));
}

}  // namespace
}  // namespace culm::flow
