#include <culm/model/turn_law.hpp>

#include "beam_case.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace culm::beam {
namespace {

// A straight element that resists bending only.
template <int Order>
DirectorBeam<Order> bending_element() {
  Slots<4 * (Order + 1)> q;
  for (int a = 0; a <= Order; ++a) {
    q.col(4 * a) = Vec3(0.0, 0.0, static_cast<double>(a) / Order);
    q.template middleCols<3>(4 * a + 1) = Mat3::Identity();
  }
  Mat6 stiffness = Mat6::Zero();
  stiffness(3, 3) = 1.0;
  std::array<Mat6, Order> points;
  points.fill(stiffness);
  std::array<Mat3, Order + 1> mass;
  mass.fill(Mat3::Zero());
  return {q, points, mass};
}

template <int Order>
Slots<4 * (Order + 1)> bent(double turn, double inner) {
  Slots<4 * (Order + 1)> q = Slots<4 * (Order + 1)>::Zero();
  for (int a = 0; a <= Order; ++a) {
    double angle = 0.5 * turn * Lagrange<Order>::node(a);
    if (Order == 3 && (a == 1 || a == 2)) angle = a == 1 ? -inner : inner;
    q.template middleCols<3>(4 * a + 1) = exp_rotation(Vec3(angle, 0.0, 0.0));
  }
  return q;
}

template <int Order>
double energy(double turn, double inner) {
  const DirectorBeam<Order> element = bending_element<Order>();
  double sum = 0.0;
  Vec6 e;
  for (int p = 0; p < Order; ++p) {
    element.strain(p, bent<Order>(turn, inner), e);
    sum += element.energy(p, e);
  }
  return sum;
}

// Least energy over the angle of the inner nodes of order 3.
template <int Order>
double energy(double turn) {
  double inner = turn / 6.0;
  constexpr double d = 1e-3;
  for (int i = 0; i < 30 && Order == 3; ++i) {
    const double ahead = energy<Order>(turn, inner + d);
    const double behind = energy<Order>(turn, inner - d);
    inner -= 0.5 * d * (ahead - behind) / (ahead + behind - 2.0 * energy<Order>(turn, inner));
  }
  return energy<Order>(turn, inner);
}

template <int Order>
void expect_law() {
  for (const double turn : {0.2, 0.5, Order == 1 ? 0.7 : 1.5}) {
    constexpr double d = 1e-3;
    const double ahead = energy<Order>(turn + d);
    const double behind = energy<Order>(turn - d);
    const double here = energy<Order>(turn);
    const double moment = (ahead - behind) / (2.0 * d);
    const model::TurnErrors errors = model::TurnLaw(Order).errors(turn);
    EXPECT_NEAR(errors.moment, 1.0 - moment / turn, 1e-5) << turn;
    EXPECT_NEAR(errors.energy, here / (0.5 * moment * moment) - 1.0, 2e-5) << turn;
    EXPECT_NEAR(errors.stiffness, 1.0 - (ahead - 2.0 * here + behind) / (d * d), 1e-4) << turn;
  }
}

TEST(Turn, LawIsThatOfTheElements) {
  expect_law<1>();
  expect_law<2>();
  expect_law<3>();
}

auto nodes_of(const auto& q) {
  return [&q](int a) { return q.template middleCols<4>(4 * a); };
}

TEST(Turn, IsThatOfTheIntervalTurnedMost) {
  auto q = DirectorBeamCase<2>::reference();
  for (int a = 0; a < 3; ++a) q.middleCols<3>(4 * a + 1) = Mat3::Identity();
  EXPECT_NEAR(DirectorBeam<2>::least_cosine(nodes_of(q)), 1.0, 1e-15);
  q.middleCols<3>(5) = exp_rotation(Vec3(0.0, 0.3, 0.4));
  q.middleCols<3>(9) = exp_rotation(Vec3(0.0, 0.6, 0.8));
  EXPECT_NEAR(DirectorBeam<2>::least_cosine(nodes_of(q)), std::cos(0.5), 1e-15);
  q.middleCols<3>(9) = exp_rotation(Vec3(0.0, 0.7, 0.9));
  EXPECT_LT(DirectorBeam<2>::least_cosine(nodes_of(q)), std::cos(0.5));
}

TEST(Turn, OfALinearBeamIsSeenFromItsFrame) {
  const auto beam = LinearBeamCase<2>::make();
  auto q = LinearBeamCase<2>::reference();
  EXPECT_NEAR(beam.least_cosine(nodes_of(q)), 1.0, 1e-14);
  q = exp_rotation(Vec3(1.0, -0.4, 0.8)) * q;  // all of it
  EXPECT_NEAR(beam.least_cosine(nodes_of(q)), 1.0, 1e-14);
  q.middleCols<3>(9) = exp_rotation(Vec3(0.0, 0.3, 0.0)) * q.middleCols<3>(9);
  EXPECT_NEAR(beam.least_cosine(nodes_of(q)), std::cos(0.3), 1e-14);
}

template <class E>
constexpr bool has_law = model::HasTurn<E>;
static_assert(has_law<KirchhoffBeam<3>> && has_law<LinearBeam<1>>);
static_assert(!has_law<HelicalBeam>, "exact at any turn");

}  // namespace
}  // namespace culm::beam
