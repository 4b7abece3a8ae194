#include <culm/strip/shared_chord.hpp>

#include "strip_kit.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <utility>

namespace culm::strip {
namespace {

using test::section;

struct SharedChord : testing::Test {
  SharedChord() {
    for (const int seed : {1, 2}) model.nodes().add(kit::random_node(seed));
  }

  StripLoad load(Station station, model::Amplitude amplitude = model::Amplitude::constant()) {
    StripLoad load(test::effect, model.nodes(), std::move(amplitude),
                   std::make_shared<test::Wind>(1.2, Vec3::UnitX()), StripModel{});
    load.add(std::move(station));
    return load;
  }
  bool shares(const Station& one, const Station& other) {
    const StripLoad a = load(one), b = load(other);
    EXPECT_EQ(share_chord(a, b, model), share_chord(b, a, model));
    return share_chord(a, b, model);
  }

  model::Model model;
  const Station wing = section(2.0, 0.25, nullptr);  // from -0.5 to 1.5 m
};

TEST_F(SharedChord, IsThatOfOneNode) {
  EXPECT_TRUE(shares(wing, wing));
  Station elsewhere = wing;
  elsewhere.point = model::marker_at(1);
  EXPECT_FALSE(shares(wing, elsewhere));
}

TEST_F(SharedChord, IsMoreThanAnEdge) {
  EXPECT_FALSE(shares(wing, section(0.5, -3.0, nullptr)));  // from 1.5 m
  EXPECT_TRUE(shares(wing, section(0.5, -2.9, nullptr)));
}

TEST_F(SharedChord, IsSeenFromBothEnds) {
  Station reversed = section(0.5, -1.5, nullptr);  // from 0.75 to 1.25 m, or there before the nose
  EXPECT_TRUE(shares(wing, reversed));
  reversed.along = -Vec3::UnitX();
  EXPECT_FALSE(shares(wing, reversed));
}

TEST_F(SharedChord, IsNoneWhereChordsCross) {
  Station fin = wing;
  fin.along = Vec3::UnitY();
  EXPECT_FALSE(shares(wing, fin));
}

TEST_F(SharedChord, IsLoadedTwiceByMoreThanTheWhole) {
  const auto twice = [&](double one, double other) {
    const StripLoad a = load(wing, model::Amplitude::constant(one));
    const StripLoad b = load(wing, model::Amplitude::constant(other));
    return count_twice(a, b, {}, Stencil::statics());
  };
  EXPECT_TRUE(twice(1.0, 1.0));
  EXPECT_TRUE(twice(0.6, 0.5));
  EXPECT_TRUE(twice(2.0, 0.1));
  EXPECT_FALSE(twice(0.5, 0.5));
  EXPECT_FALSE(twice(2.0, 0.0));
}

}  // namespace
}  // namespace culm::strip
