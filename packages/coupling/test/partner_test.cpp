#include <culm/coupling/partner.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>

namespace culm::coupling {
namespace {

using Eigen::VectorXd;

// What a partner gives is what it loses, in any window, whatever is asked of it in between.
TEST(Partners, KeepTheirBooks) {
  for (const std::string& name : partner_names()) {
    const auto partner = find_partner(name, {2.0, 3.0, 50.0});
    partner->begin(VectorXd::LinSpaced(6, -1.0, 1.0));
    double work = 0.0, size = 0.0;
    for (int i = 0; i < 100; ++i) {
      const double h = 0.01 + 0.005 * (i % 3);
      const VectorXd moved = VectorXd::LinSpaced(6, -0.02, 0.03) * std::sin(0.3 * i);
      partner->forces(7.0 * moved, 2.0 * h);  // an attempt that is forgotten
      const double one = partner->forces(moved, h).dot(moved);
      partner->accept(moved, h);
      work += one;
      size += std::abs(one);
    }
    EXPECT_GT(size, 1e-3) << name;
    EXPECT_NEAR(work + partner->energy() + partner->dissipated(), 0.0, 1e-12 * size) << name;
  }
}

// How far forces change with motion is what a partner says.
TEST(Partners, AreAsStiffAsTheySay) {
  for (const std::string& name : partner_names()) {
    const auto partner = find_partner(name, {2.0, 3.0, 50.0});
    partner->begin(VectorXd::Zero(3));
    const double h = 0.02;
    const double change =
        (partner->forces(VectorXd::Ones(3), h) - partner->forces(VectorXd::Zero(3), h))
            .lpNorm<Eigen::Infinity>();
    EXPECT_LE(change, partner->stiffness(h)) << name;
    EXPECT_GT(change, 0.4 * partner->stiffness(h)) << name;
  }
}

// A mass on a spring at a point that stands swings as it should, to second order.
TEST(Partners, TheOscillatorSwings) {
  const double mass = 2.0, stiffness = 8.0;  // two radians per second
  const auto swing = [&](double h) {
    const auto partner = make_oscillator(mass, stiffness);
    partner->begin(VectorXd::Constant(1, 1.0));
    const VectorXd still = VectorXd::Zero(1);
    for (int i = 0; i < std::lround(1.0 / h); ++i) partner->accept(still, h);
    return std::abs(partner->forces(still, 1e-9)[0] - stiffness * 0.5 * std::sin(2.0));
  };
  EXPECT_LT(swing(0.01), 1e-3);
  EXPECT_NEAR(std::log2(swing(0.02) / swing(0.01)), 2.0, 0.05);
}

}  // namespace
}  // namespace culm::coupling
