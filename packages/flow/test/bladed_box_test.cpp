// Boxes of Bladed, from small files of known values.
#include "boxes.hpp"

#include <cmath>
#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

namespace culm::flow {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const Vec3 percent(12.0, 9.0, 6.0);

void put_floats(std::string& bytes, const std::vector<double>& numbers) {
  for (const double number : numbers) put(bytes, static_cast<float>(number));
}

struct Written {
  std::int16_t kind = 4;
  std::int32_t components = 3;
  int planes = nx;
};

std::string bladed(const Written& file = {}) {
  std::string bytes;
  put(bytes, std::int16_t{-99});
  put(bytes, file.kind);
  if (file.kind == 4) {
    put(bytes, file.components);
    put_floats(bytes, {54.0, 0.03, 90.0, percent[0], percent[1], percent[2]});
  }
  if (file.kind == 7 || file.kind == 8) {
    put(bytes, std::int32_t{file.kind == 7 ? 92 : 148});
    put(bytes, file.components);
  }
  put_floats(bytes, {dz, dy, dx});
  put(bytes, std::int32_t{nx / 2});
  put_floats(bytes, {speed, 1.0, 2.0, 3.0});
  for (const std::int32_t n : {0, 4711, nz, ny}) put(bytes, n);
  if (file.components == 3) put_floats(bytes, std::vector(6, 5.0));
  if (file.kind == 7) put_floats(bytes, {12.0, 340.0});
  if (file.kind == 8) put_floats(bytes, std::vector(16, 0.0));
  if (file.kind == 7 || file.kind == 8) {
    EXPECT_EQ(bytes.size(), file.kind == 7 ? 92U : 148U);  // as it says itself
  }
  for (int t = 0; t < file.planes; ++t)
    for (int z = 0; z < nz; ++z)
      for (int y = 0; y < ny; ++y)
        for (int c = 0; c < file.components; ++c)
          put(bytes, static_cast<std::int16_t>(written(t, z, y, c)));
  return bytes;
}

class BladedBoxes : public FlowTest {
 protected:
  kit::GivenValues values(const kit::GivenValues& more) const {
    kit::GivenValues values = {{"Density", 1.225},
                               {"File Name", (folder_ / "wind.wnd").string()},
                               {"Centre", std::vector{0.0, 0.0, 90.0}},
                               {"Delay", 0.0}};
    values.insert(values.end(), more.begin(), more.end());
    return values;
  }
  SharedFlow box(const std::string& bytes, const kit::GivenValues& more = {}) {
    std::ofstream(folder_ / "wind.wnd", std::ios::binary) << bytes;
    return make("Bladed Box", values(more));
  }
  std::string objection(const std::string& bytes, const kit::GivenValues& more = {}) {
    return refusal([&] { box(bytes, more); });
  }
};

const kit::GivenValues intensities = {{"Intensities", std::vector{0.2, 0.1, 0.05}}};

// What stands there times the intensities; `across` is the sign of the lateral component.
Vec3 fluctuation(int t, int z, int y, const Vec3& intensity, double across = -1.0) {
  Vec3 u;
  for (int c = 0; c < 3; ++c) u[c] = 1e-3 * intensity[c] * speed * written(t, z, y, c);
  u[1] *= across;
  return u;
}

TEST_F(BladedBoxes, PointsHaveTheirValues) {
  const SharedFlow wind = box(bladed());
  for (int t = 0; t < nx; ++t)
    for (int z = 0; z < nz; ++z)
      for (int y = 0; y < ny; ++y)
        expect_near(wind->velocity(point(z, y), t * dt),
                    Vec3(speed, 0.0, 0.0) + fluctuation(t, z, y, 0.01 * percent));
}

TEST_F(BladedBoxes, HeadersOfOtherSpectraAreKnown) {
  for (const std::int16_t kind : std::vector<std::int16_t>{3, 5, 7, 8}) {
    const SharedFlow wind = box(bladed({kind, 3, 4}), intensities);
    expect_near(wind->velocity(point(1, 2), 2.0 * dt),
                Vec3(speed, 0.0, 0.0) + fluctuation(2, 1, 2, Vec3(0.2, 0.1, 0.05)));
  }
  const SharedFlow single = box(bladed({2, 1, 4}), intensities);
  expect_near(single->velocity(point(1, 2), 0.0),
              Vec3(speed + 1e-3 * 0.2 * speed * written(0, 1, 2, 0), 0.0, 0.0));
}

TEST_F(BladedBoxes, SidesAreThoseThatTheDeckNames) {
  const Vec3 mean(speed, 0.0, 0.0);
  const SharedFlow left = box(bladed(), {{"Components Across", std::string("Left")}});
  expect_near(left->velocity(point(0, 0), 0.0), mean + fluctuation(0, 0, 0, 0.01 * percent, 1.0));
  const SharedFlow mirrored = box(bladed(), {{"Points From", std::string("Left")}});
  expect_near(mirrored->velocity(point(0, 0), 0.0),
              mean + fluctuation(0, 0, ny - 1, 0.01 * percent));
}

TEST_F(BladedBoxes, AMeanWindIsAddedToFluctuations) {
  const Vec3 place = point(1, 1);
  const Vec3 there = fluctuation(1, 1, 1, 0.01 * percent);
  const SharedFlow power = box(bladed(), {{"Height", 90.0}, {"Exponent", 0.3}});
  expect_near(power->velocity(place, dt),
              there + Vec3(speed * std::pow(100.0 / 90.0, 0.3), 0.0, 0.0));
  const SharedFlow logarithmic = box(bladed(), {{"Height", 90.0}, {"Roughness", 0.03}});
  expect_near(logarithmic->velocity(place, dt),
              there + Vec3(speed * std::log(100.0 / 0.03) / std::log(90.0 / 0.03), 0.0, 0.0));
}

TEST_F(BladedBoxes, AnotherSpeedMovesAndScalesThem) {
  const SharedFlow wind = box(bladed(), {{"Speed", 2.0 * speed}});
  expect_near(wind->velocity(point(0, 1), 0.5 * dt),
              2.0 * (Vec3(speed, 0.0, 0.0) + fluctuation(1, 0, 1, 0.01 * percent)));
}

TEST_F(BladedBoxes, TheyRepeatOrEnd) {
  const SharedFlow endless = box(bladed());
  expect_near(endless->velocity(point(0, 1), -dt), endless->velocity(point(0, 1), 3.0 * dt));
  const SharedFlow odd = box(bladed({4, 3, nx + 1}));
  expect_near(odd->velocity(point(0, 1), -dt), odd->velocity(point(0, 1), 4.0 * dt));
  const SharedFlow single = box(bladed(), {{"Periodic", false}});
  EXPECT_THROW(single->velocity(point(0, 1), 3.5 * dt), InputError);
}

TEST_F(BladedBoxes, MistakesAreNamed) {
  EXPECT_THAT(objection(bladed({7, 3, 4})), HasSubstr("does not say its turbulence intensities"));
  EXPECT_THAT(objection(bladed({9, 3, 4})), HasSubstr("spectrum of kind 9"));
  EXPECT_THAT(objection(bladed({4, 5, 4})), HasSubstr("has 5 components"));
  std::string old = bladed();
  old[0] = -3;
  EXPECT_THAT(objection(old), HasSubstr("begins with -3, not with -99"));
  EXPECT_THAT(mistakes("Bladed Box", values({{"Exponent", 0.1}})),
              ElementsAre(HasSubstr("belongs to a mean wind, which needs 'Height'")));
  EXPECT_THAT(
      mistakes("Bladed Box", values({{"Height", 9.0}, {"Exponent", 0.1}, {"Roughness", 0.1}})),
      ElementsAre(HasSubstr("stands in place of 'Exponent'")));
}

// Wherever a file is cut it is refused; what else is damaged is refused, or a wind all the same.
TEST_F(BladedBoxes, DamagedFilesAreRefusedOrRead) {
  for (const Written& file : {Written{}, Written{7, 3, 4}, Written{8, 3, 4}}) {
    const std::string whole = bladed(file);
    for (int share = 0; share < 20; ++share) {
      const std::string cut = whole.substr(0, whole.size() * static_cast<std::size_t>(share) / 20);
      EXPECT_NE(objection(cut, intensities), "none") << share;
    }
    std::uint32_t random = 1;
    const auto draw = [&random](std::size_t below) {
      random = random * 1664525U + 1013904223U;
      return static_cast<std::size_t>(random >> 8U) % below;
    };
    int refused = 0;
    for (int i = 0; i < 500; ++i) {
      std::string damaged = whole;
      const std::size_t bit = draw(8 * damaged.size());
      damaged[bit / 8] = static_cast<char>(damaged[bit / 8] ^ (1 << (bit % 8)));
      try {
        const SharedFlow wind = box(damaged, intensities);
        const kit::GivenValues hold = {{"Outside", std::string("Hold")}};
        EXPECT_TRUE(box(damaged, {intensities.front(), hold.front()})
                        ->velocity(Vec3(0.0, 0.0, 90.0), 0.3)
                        .allFinite());
      } catch (const InputError&) {
        ++refused;
      }
    }
    EXPECT_GT(refused, 10);
  }
}

}  // namespace
}  // namespace culm::flow
