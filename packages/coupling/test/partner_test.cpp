#include <culm/coupling/point_partner.hpp>
#include <culm/coupling/test_partners.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <memory>
#include <string>

namespace culm::coupling {
namespace {

using Eigen::VectorXd;
using port::Quantity;

constexpr int points = 2;

std::map<std::string, std::unique_ptr<PointModel>> models() {
  std::map<std::string, std::unique_ptr<PointModel>> all;
  all["mass"] = make_added_mass(2.0);
  all["dashpot"] = make_dashpot(3.0);
  all["oscillator"] = make_oscillator(2.0, 50.0);
  return all;
}

Beginning beginning() {
  Beginning at;
  at.port = "skin";
  at.reference.assign(3 * points, 0.1);
  for (int i = 0; i < 6 * points; ++i) at.velocity.push_back(0.2 * i - 1.0);
  return at;
}

Window window(int number) {
  Window w;
  w.number = number;
  w.start = 0.02 * number;
  w.end = w.start + 0.01 + 0.005 * (number % 3);
  for (int i = 0; i < 6 * points; ++i) {
    w.of(Quantity::motion).push_back((0.01 * i - 0.03) * std::sin(0.3 * number));
  }
  return w;
}

double work(const VectorXd& loads, const Window& w) {
  const std::vector<double>& moved = w.of(Quantity::motion);
  return loads.dot(Eigen::Map<const VectorXd>(moved.data(), loads.size()));
}

// What a partner gives is what it loses, in any window, however many steps it makes in it, whatever
// is asked of it in between, and also after it was set back.
TEST(Partners, KeepTheirBooks) {
  for (const int steps : {1, 8}) {
    for (auto& [name, model] : models()) {
      if (name == "mass" && steps > 1) continue;  // it would see no acceleration
      PointPartner partner(std::move(model), steps, WindowLoad::mean);
      partner.begin(beginning());
      double sum = 0.0, size = 0.0;
      Snapshot kept;
      for (int i = 0; i < 100; ++i) {
        partner.loads(window(7 * i));  // an attempt that is forgotten
        const VectorXd loads = partner.loads(window(i));
        if (i == 50) partner.save("partner/", kept);
        partner.accept(window(i));
        sum += work(loads, window(i));
        size += std::abs(work(loads, window(i)));
      }
      EXPECT_GT(size, 1e-3) << name;
      EXPECT_NEAR(sum + partner.books().energy + partner.books().dissipated, 0.0, 1e-12 * size)
          << name << ", " << steps;
      const VectorXd last = partner.loads(window(100));
      partner.restore("partner/", kept);
      for (int i = 50; i < 100; ++i) partner.accept(window(i));
      EXPECT_EQ(partner.loads(window(100)), last) << name;
    }
  }
}

// The load at the end of a window in place of the mean: energy comes from nowhere.
TEST(Partners, LastLoadsAreNotConjugateToTheMotion) {
  PointPartner partner(make_oscillator(2.0, 50.0), 8, WindowLoad::last);
  partner.begin(beginning());
  double sum = 0.0, size = 0.0;
  for (int i = 0; i < 100; ++i) {
    const double one = work(partner.loads(window(i)), window(i));
    partner.accept(window(i));
    sum += one;
    size += std::abs(one);
  }
  EXPECT_GT(std::abs(sum + partner.books().energy), 1e-3 * size);
}

// A mass on a spring at a point that stands swings as it should, to second order.
TEST(Partners, TheOscillatorSwings) {
  const double mass = 2.0, stiffness = 8.0;  // two radians per second
  const auto swing = [&](double h) {
    const auto model = make_oscillator(mass, stiffness);
    model->begin(VectorXd::Zero(1), VectorXd::Constant(1, 1.0));
    const VectorXd still = VectorXd::Zero(1);
    for (int i = 0; i < std::lround(1.0 / h); ++i) model->accept(still, h);
    return std::abs(model->forces(still, 1e-9)[0] - stiffness * 0.5 * std::sin(2.0));
  };
  EXPECT_LT(swing(0.01), 1e-3);
  EXPECT_NEAR(std::log2(swing(0.02) / swing(0.01)), 2.0, 0.05);
}

TEST(Partners, RandomForcesBelongToTheirWindow) {
  RandomPartner one(5.0, 1), other(5.0, 2);
  const VectorXd loads = one.loads(window(3));
  EXPECT_EQ(one.loads(window(3)), loads);
  EXPECT_NE(one.loads(window(4)), loads);
  EXPECT_NE(other.loads(window(3)), loads);
  EXPECT_LE(loads.lpNorm<Eigen::Infinity>(), 5.0);
  EXPECT_GT(loads.lpNorm<Eigen::Infinity>(), 0.5);
  EXPECT_TRUE(loads.segment<3>(3).isZero(0.0));
}

}  // namespace
}  // namespace culm::coupling
