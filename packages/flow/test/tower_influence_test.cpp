// Winds around a tower, against closed forms.
#include "../src/tower_influence.hpp"

#include "flow_kit.hpp"

#include <cmath>
#include <numbers>
#include <string>

namespace culm::flow {
namespace {

using std::numbers::pi;
using Upstream = TowerInfluence::Upstream;
using Downstream = TowerInfluence::Downstream;

TowerInfluence about(Upstream upstream, Downstream downstream) {
  return {.upstream = upstream, .downstream = downstream, .drag = 0.7, .turbulence = 0.2};
}

Eigen::Vector2d total(const TowerInfluence& influence, double x, double y) {
  return influence.change(x, y) + Eigen::Vector2d(1.0, 0.0);
}

TEST(TowerInfluence, PotentialFlowDoesNotPassTheSurfaceAndHasNoSources) {
  const TowerInfluence flow = about(Upstream::potential, Downstream::none);
  for (int i = 0; i < 24; ++i) {
    const double angle = 2.0 * pi * i / 24.0;
    const Eigen::Vector2d normal(std::cos(angle), std::sin(angle));
    EXPECT_NEAR(normal.dot(total(flow, normal[0], normal[1])), 0.0, 1e-14);
    const Eigen::Vector2d place = 1.7 * normal;
    constexpr double h = 1e-5;
    const double divergence =
        (total(flow, place[0] + h, place[1])[0] - total(flow, place[0] - h, place[1])[0] +
         total(flow, place[0], place[1] + h)[1] - total(flow, place[0], place[1] - h)[1]) /
        (2.0 * h);
    EXPECT_NEAR(divergence, 0.0, 1e-9);
  }
  EXPECT_NEAR(total(flow, 0.0, 1.0)[0], 2.0, 1e-14) << "twice as fast at the sides";
  EXPECT_NEAR(total(flow, -3.0, 0.0)[0], 1.0 - 1.0 / 9.0, 1e-14);
}

TEST(TowerInfluence, BakAddsTheWakeOfTheDrag) {
  const TowerInfluence flow = about(Upstream::bak, Downstream::none);
  const double x = -2.9;  // and a tenth of a radius
  EXPECT_NEAR(flow.change(-3.0, 0.0)[0], -1.0 / (x * x) + 0.7 / (2.0 * pi * x), 1e-14);
  EXPECT_NEAR(flow.change(-0.1, 4.0)[1], 0.7 / (2.0 * pi * 4.0), 1e-14);
}

// The deficit of momentum across the wake of Eames is that of the drag wherever it is looked at.
TEST(TowerInfluence, WakesLackWhatTheTowerTakes) {
  const TowerInfluence eames = about(Upstream::none, Downstream::eames);
  const TowerInfluence powles = about(Upstream::none, Downstream::powles);
  for (const double x : {8.0, 30.0}) {
    double deficit = 0.0;
    constexpr double h = 1e-2;
    for (double y = -60.0; y < 60.0; y += h) deficit -= h * eames.change(x, y)[0];
    EXPECT_NEAR(deficit, 0.7, 1e-4);
    EXPECT_NEAR(powles.change(x, 0.0)[0], -0.7 / std::sqrt(x), 1e-14);
    EXPECT_EQ(powles.change(x, std::sqrt(2.0 * x))[0], 0.0) << "beyond its edge";
  }
  EXPECT_EQ(eames.change(-8.0, 0.0).norm(), 0.0) << "upstream";
  EXPECT_EQ(eames.change(1.0, 0.0)[0], -0.5) << "half of the wind at most";
  EXPECT_EQ(powles.change(1.0, 0.0)[0], -0.5);
}

class WindsWithTowers : public FlowTest {
 protected:
  WindsWithTowers() {
    model::Structure& tower = model_.add_structure("tower");
    for (const double z : {0.0, 40.0, 80.0}) {
      model::NodeSlots node;
      node << Vec3(5.0, 0.0, z), Mat3::Identity();
      tower.nodes.push_back(model_.nodes().add(node));
      tower.line_points.push_back({model::marker_at(tower.nodes.back()), 40.0});
    }
  }
};

TEST_F(WindsWithTowers, FeelItByItsRadiusAtTheirHeight) {
  const kit::GivenValues wind = {{"Density", 1.2}, {"Velocity", std::vector{0.0, 10.0, 0.0}}};
  Options options = kit::deck_list(schema("Uniform"), wind, "wind");
  const SharedFlow free = make("Uniform", wind);
  Options influence("Tower Influence");
  influence.set("Structure", std::string("tower")).set("Diameters", std::vector{6.0, 4.0});
  influence.set("Upstream", std::string("Potential")).set("Downstream", std::string("Powles"));
  influence.set("Drag", 1.0).set("Turbulence", 0.1);
  const SharedFlow shaded = make("Uniform", options.add_list(influence));
  const auto change = [&](const Vec3& place) -> Vec3 {
    return shaded->velocity(place, 0.0) - free->velocity(place, 0.0);
  };
  // 2.5 m is the radius at half the height; the wind blows along y
  EXPECT_LT((change(Vec3(5.0, -7.5, 40.0)) - Vec3(0.0, -10.0 / 9.0, 0.0)).norm(), 1e-12);
  EXPECT_LT((change(Vec3(10.0, 0.0, 40.0)) - Vec3(0.0, 10.0 / 4.0, 0.0)).norm(), 1e-12);
  // above the top it fades within one diameter of 4 m
  EXPECT_LT((change(Vec3(9.0, 0.0, 82.0)) - Vec3(0.0, 0.5 * 10.0 / 4.0, 0.0)).norm(), 1e-12);
  EXPECT_EQ(change(Vec3(9.0, 0.0, 84.1)).norm(), 0.0);
  // along the tower its gradient is not known
  Mat3 directions;
  directions << Vec3::UnitX(), Vec3::UnitY(), Vec3::Zero();
  for (const Vec3& place : {Vec3(9.0, -7.5, 40.0), Vec3(6.0, 10.0, 40.0), Vec3(9.0, 1.0, 82.0)}) {
    expect_gradient(*shaded, place, 0.0, directions);
  }
  // the tower itself stands in the wind that comes
  EXPECT_EQ(shaded->without_structure()->velocity(Vec3(5.0, 0.0, 40.0), 0.0),
            free->velocity(Vec3::Zero(), 0.0));
  EXPECT_EQ(shaded->stands_about(), "tower");
  EXPECT_EQ(free->stands_about(), "");
  EXPECT_EQ(free->without_structure(), nullptr);
  // Powles, four radii behind
  EXPECT_NEAR(change(Vec3(5.0, 10.0, 40.0))[1], -10.0 / 16.0 - 10.0 / 2.0, 1e-12);
}

}  // namespace
}  // namespace culm::flow
