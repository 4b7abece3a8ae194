#include <culm/port/point_motion.hpp>
#include <culm/port/register_port.hpp>
#include <culm/port/report.hpp>

#include "sample.hpp"

#include <culm_kit/rigid_motion.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace culm::port {
namespace {

std::vector<Place> attach_to(const model::Model& model, const std::vector<double>& points,
                             std::vector<std::string> structures = {}) {
  std::string issue;
  auto places = attach({points, std::move(structures)}, model, issue);
  EXPECT_EQ(issue, "");
  return places;
}

// A straight line with a surface around it is bent to a circle of radius 4 m, and the surface with
// it. @return the largest distance from where the surface of the circle is [m]
double error_of_bent_surface(int cells, Weights weights) {
  model::Model model;
  add_straight(model, cells, 1, "beam");
  std::vector<double> points;
  constexpr int along = 400;
  for (int i = 0; i <= along; ++i) points.insert(points.end(), {10.0 * i / along, 0.5, 0.0});
  std::string issue;
  const auto places = attach({points, {}, 1.0, weights}, model, issue);
  EXPECT_EQ(issue, "");
  const double radius = 4.0;
  const auto bent = [radius](double s) {
    const double angle = s / radius;
    model::NodeSlots slots;
    slots.col(0) = radius * Vec3(std::sin(angle), 1.0 - std::cos(angle), 0.0);
    slots.rightCols<3>() << -std::sin(angle), 0.0, std::cos(angle), std::cos(angle), 0.0,
        std::sin(angle), 0.0, 1.0, 0.0;
    return slots;
  };
  model::Coordinates q = model.nodes().reference();
  for (int node = 0; node < model.nodes().size(); ++node) {
    model::NodeTable::slots(q, node) = bent(10.0 * node / cells);
  }
  double error = 0.0;
  for (int i = 0; i <= along; ++i) {
    const model::NodeSlots exact = bent(10.0 * i / along);
    const Vec3 x = position(places[static_cast<std::size_t>(i)].marker, q);
    error = std::max(error, (x - exact.col(0) - 0.5 * exact.col(1)).norm());
  }
  return error;
}

// Linear weights: a h^2 / 8 of the curvature of axis and lever, as an independent program found
// them; cubic ones are of third order.
TEST(Projection, SmoothWeightsFollowABentSurface) {
  EXPECT_NEAR(error_of_bent_surface(5, Weights::elements), 1.1e-1, 1e-2);
  EXPECT_NEAR(error_of_bent_surface(10, Weights::elements), 2.7e-2, 1e-3);
  EXPECT_NEAR(error_of_bent_surface(20, Weights::elements), 6.8e-3, 1e-4);
  const double coarse = error_of_bent_surface(20, Weights::smooth);
  const double fine = error_of_bent_surface(40, Weights::smooth);
  EXPECT_LT(coarse, 5e-4);
  EXPECT_NEAR(std::log2(coarse / fine), 3.0, 0.15);
}

// The shape of the partner's surface is met in the reference, whatever the order.
TEST(Projection, MeetsEveryPointOfACurvedAndTwistedLine) {
  // also with weights of four neighbouring nodes, three at the ends
  for (const auto& [order, weights] : {std::pair(1, Weights::elements),
                                       {2, Weights::elements},
                                       {3, Weights::elements},
                                       {1, Weights::smooth},
                                       {2, Weights::smooth}}) {
    model::Model model;
    add_helix(model, 6, order);
    kit::Random random(3);
    std::vector<double> points;
    for (int i = 0; i < 400; ++i) {
      const int node = i % model.nodes().size();
      const auto slots = model::NodeTable::slots(model.nodes().reference(), node);
      const Vec3 x = slots.col(0) + slots.rightCols<3>() * (2.0 * random.vector());
      points.insert(points.end(), x.begin(), x.end());
    }
    std::string issue;
    const std::vector<Place> places = attach({points, {}, 4.0, weights}, model, issue);
    EXPECT_EQ(issue, "");
    int inside = 0;
    for (std::size_t p = 0; p < places.size(); ++p) {
      const Vec3 x = position(places[p].marker, model.nodes().reference());
      EXPECT_LT((x - Eigen::Map<const Vec3>(points.data() + 3 * p)).norm(), 1e-12);
      EXPECT_LT(places[p].distance, 3.5);
      if (places[p].marker.nodes.size() > 1) ++inside;
    }
    EXPECT_GT(inside, 300);
  }
}

TEST(Projection, MeetsEveryPointNearAShell) {
  model::Model model;
  add_roof(model);
  kit::Random random(3);
  std::vector<double> points;
  for (int i = 0; i < 200; ++i) {
    const double angle = 0.45 + 0.5 * random.number(), radius = 5.0 + 0.3 * random.number();
    points.insert(points.end(), {radius * std::sin(angle), 2.0 + 2.5 * random.number(),
                                 radius * std::cos(angle)});
  }
  const auto places = attach_to(model, points);
  bool any_beyond = false;
  for (std::size_t p = 0; p < places.size(); ++p) {
    const Vec3 x = position(places[p].marker, model.nodes().reference());
    EXPECT_LT((x - Eigen::Map<const Vec3>(points.data() + 3 * p)).norm(), 1e-12);
    any_beyond |= places[p].beyond > 0.0;
  }
  EXPECT_TRUE(any_beyond);
}

TEST(Projection, TakesTheNearestStructure) {
  model::Model model;
  add_straight(model, 4, 2, "keel");
  add_straight(model, 4, 2, "mast", Vec3(0.0, 0.0, 3.0));
  add_ball(model, Vec3(-1.0, 0.0, 0.0));
  const auto places = attach_to(model, {5.1, 0.0, 0.4, 5.1, 0.0, 2.5, -0.9, 0.1, 0.0});
  EXPECT_EQ(places[0].structure, 0);
  EXPECT_EQ(places[1].structure, 1);
  EXPECT_EQ(places[2].structure, 2);
  for (const Place& place : places) EXPECT_EQ(place.rival, -1);
  EXPECT_NEAR(places[0].distance, 0.4, 1e-14);
  EXPECT_EQ(places[0].beyond, 0.0);
}

// Round a point between two lines, and between the legs of one that turns back.
TEST(Projection, TellsWhereAnotherPlaceIsAboutAsNear) {
  model::Model model;
  add_straight(model, 4, 2, "keel");
  add_straight(model, 4, 2, "mast", Vec3(0.0, 0.0, 3.0));
  add_line(model, "hairpin", 30, 1, [](double s) {
    const double angle = M_PI * std::clamp((s - 0.4) / 0.2, 0.0, 1.0);
    const double back = std::max(0.0, s - 0.6), out = std::min(s, 0.4);
    model::NodeSlots slots;
    slots.col(0) = Vec3(10.0 * (out - back) + std::sin(angle), 100.0, 1.0 - std::cos(angle));
    slots.rightCols<3>() = triad_along(Vec3(std::cos(angle), 0.0, std::sin(angle)), Vec3::UnitY());
    return slots;
  });
  const auto places = attach_to(model, {5.0, 0.0, 1.45, 1.0, 100.0, 0.95, 1.0, 100.0, 0.2});
  EXPECT_EQ(places[0].structure, 0);
  EXPECT_EQ(places[0].rival, 1);
  EXPECT_EQ(places[1].structure, 2);
  EXPECT_EQ(places[1].rival, 2);
  EXPECT_EQ(places[2].rival, -1);
  auto port = add_port("skin", places, model);
  const auto found = doubts(*port, model);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_THAT(found[0], testing::HasSubstr("2 points nearly as near to another place"));
  EXPECT_THAT(found[0], testing::HasSubstr("point 0 at (5, 0, 1.45): 'keel' was taken, 'mast'"));
}

TEST(Projection, BelongsToTheNodePastAnEnd) {
  model::Model model;
  add_straight(model, 4, 2, "keel");
  const auto places = attach_to(model, {10.7, 0.2, 0.1, 3.0, 0.0, 0.2});
  EXPECT_EQ(places[0].marker.nodes, std::vector<int>{8});
  EXPECT_LT((places[0].marker.offset - Vec3(0.2, 0.1, 0.7)).norm(), 1e-14);
  EXPECT_NEAR(places[0].beyond, 0.7, 1e-14);
  const auto port = add_port("skin", places, model);
  EXPECT_EQ(describe(*port, model),
            "port 'skin': 2 points, 2 on 'keel', up to 0.734847 m away, 1 past ends or rims by up "
            "to 0.7 m, 5 of 9 nodes of 'keel' without points, 'keel/0' the first");
}

TEST(Projection, TellsTheSideOnWhichAllPointsAre) {
  model::Model model;
  add_straight(model, 4, 2, "keel");
  const auto side = [&](const std::vector<double>& points) {
    const std::string text = describe(*add_port("skin", attach_to(model, points), model), model);
    const std::size_t at = text.find(" away");
    return text.substr(at, text.find(", ", text.find(')', at)) - at);
  };
  EXPECT_EQ(side({2.0, -0.2, 0.0, 3.0, -0.1, 0.0, 4.0, 0.0, 0.0}), " away towards (0, -1, 0)");
  EXPECT_EQ(side({2.0, 0.3, 0.4}), " away towards (0, 0.6, 0.8)");
  EXPECT_THAT(side({2.0, -0.2, 0.0, 3.0, 0.2, 0.0}), testing::Not(testing::HasSubstr("towards")));
  EXPECT_THAT(side({2.0, 0.0, 0.0}), testing::Not(testing::HasSubstr("towards")));
}

// Inside of a sharp bend the cross-sections of a line meet.
TEST(Projection, TellsWhereCrossSectionsNearlyOverlap) {
  model::Model model;
  add_line(model, "bow", 8, 2, [](double s) {
    const double angle = 2.0 * s;
    model::NodeSlots slots;
    slots.col(0) = Vec3(std::cos(angle), std::sin(angle), 0.0);
    slots.rightCols<3>() = triad_along(Vec3(-std::sin(angle), std::cos(angle), 0.0), Vec3::UnitZ());
    return slots;
  });
  const auto places = attach_to(model, {0.1 * std::cos(0.9), 0.1 * std::sin(0.9), 0.0,
                                        0.7 * std::cos(0.9), 0.7 * std::sin(0.9), 0.0});
  EXPECT_NEAR(places[0].fibre, 0.1, 0.02);
  EXPECT_NEAR(places[1].fibre, 0.7, 0.02);
  const auto port = add_port("skin", {places[0]}, model);
  ASSERT_EQ(doubts(*port, model).size(), 1u);
  EXPECT_TRUE(doubts(*add_port("outside", {places[1]}, model), model).empty());
}

TEST(Projection, SaysWhichPointsAreTooFarAway) {
  model::Model model;
  add_straight(model, 4, 2, "keel");
  add_roof(model);
  std::string issue;
  attach({{5.0, 0.0, 0.4, 5.0, 3.0, 0.0, 1.0, 7.0, 0.0}, {"keel"}, 1.5}, model, issue);
  EXPECT_EQ(
      issue,
      "2 of 3 points belong to no structure, the first of them point 1 at (5, 3, 0), 3 m away "
      "where at most 1.5 m are allowed");
  issue.clear();
  attach({{0.0, -5.0, 5.0}, {"roof"}}, model, issue);
  EXPECT_EQ(issue,
            "1 of 1 points belong to no structure, the first of them point 0 at (0, -5, 5), more "
            "than half an element past the rim");
  issue.clear();
  attach({{0.0, 0.0, 0.0}, {"rof"}}, model, issue);
  EXPECT_EQ(issue, "unknown structure 'rof' – did you mean 'roof'?");
}

}  // namespace
}  // namespace culm::port
