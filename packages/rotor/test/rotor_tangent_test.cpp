// Derivatives of what a rotor induces.
#include <culm/rotor/induction.hpp>
#include <culm/rotor/rotor_load.hpp>

#include "rotor_kit.hpp"

#include <Eigen/Geometry>
#include <culm_kit/batch_laws.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace culm::rotor {
namespace {

using std::numbers::pi;
using test::element;

LiftDrag section(double alpha) {
  strip::Coefficients slope;
  const strip::Coefficients c = test::Airfoil().at(alpha, slope);
  return {c[0], c[1], slope[0], slope[1]};
}

// Differences of second order.
Mat<2, 3> difference(const BladeElement& e) {
  Mat<2, 3> slope;
  constexpr double h = 1e-5;
  for (int k = 0; k < 3; ++k) {
    const auto at = [&](double step) {
      BladeElement moved = e;
      if (k == 0) moved.axial += step;
      if (k == 1) moved.tangential += step;
      const Induction i = solve_induction(
          moved, [&](double alpha) { return section(k == 2 ? alpha + step : alpha); });
      return Vec<2>(i.axial, i.tangential);
    };
    slope.col(k) = (at(h) - at(-h)) / (2.0 * h);
  }
  return slope;
}

TEST(InductionSlope, IsThatOfTheBalance) {
  bool heavy = false;
  for (const double axial : {-9.0, 3.0, 8.0, 14.0}) {
    for (const double tangential : {12.0, 40.0, 80.0}) {
      for (const double twist : {-0.15, 0.0, 0.1, 0.4}) {
        for (const bool drag : {true, false}) {
          BladeElement e = element(axial, tangential, axial < 0.0 ? -twist : twist);
          e.drag_induces = drag;
          const Induction i = solve_induction(e, section);
          if (!i.found) continue;
          heavy = heavy || i.axial > 0.4;
          const Mat<2, 3> expected = difference(e);
          EXPECT_LT((i.slope - expected).norm(), 1e-6 * (1.0 + expected.norm()))
              << axial << ' ' << tangential << ' ' << twist;
        }
      }
    }
  }
  EXPECT_TRUE(heavy);
}

TEST(InductionNearby, IsTheSame) {
  for (const double axial : {-8.0, 8.0}) {
    const Induction cold = solve_induction(element(axial, 60.0, 0.02), section);
    const double angles[] = {cold.inflow_angle, 1.1 * cold.inflow_angle, 0.5 * cold.inflow_angle,
                             std::copysign(1.5, axial), -cold.inflow_angle};
    for (const double near : angles) {
      const Induction warm = solve_induction(element(axial, 60.0, 0.02), section, near);
      EXPECT_NEAR(warm.inflow_angle, cold.inflow_angle, 1e-14);
      EXPECT_NEAR(warm.axial, cold.axial, 1e-13);
      EXPECT_NEAR(warm.tangential, cold.tangential, 1e-13);
      EXPECT_LT((warm.slope - cold.slope).norm(), 1e-7 * cold.slope.norm());
    }
  }
}

// One node carries the hub, and one each blade, which moves by itself.
class Rotor {
 public:
  static constexpr int num_blades = 2, num_stations = 3;
  static constexpr double h = 0.01, omega = 6.0;

  explicit Rotor(RotorModel kind) {
    const model::NodeSlots hub = kit::random_node(7);
    axis_ = hub.col(1);
    auto wind = std::make_shared<test::Wind>(1.2, Mat3(hub.rightCols<3>()) * Vec3(8.0, 0.5, -0.3));
    for (int i = 0; i <= num_blades; ++i) model_.nodes().add(hub);
    std::vector<strip::StripLoad*> blades;
    for (int b = 0; b < num_blades; ++b) {
      const Mat3 turn =
          Eigen::AngleAxisd(2.0 * pi * b / num_blades, Vec3::UnitX()).toRotationMatrix();
      auto blade = std::make_unique<strip::StripLoad>("strips " + std::to_string(b), model_.nodes(),
                                                      model::Amplitude::constant(), wind,
                                                      strip::StripModel{});
      for (int i = 0; i < num_stations; ++i) {
        strip::Station station{model::marker_at(1 + b), 2.0, 0.8, 0.4};
        station.point.offset = turn * Vec3(0.3, 0.1, 3.0 + 2.0 * i);
        station.along = turn * Vec3(std::sin(0.1), std::cos(0.1), 0.0);
        station.across = turn * Vec3(std::cos(0.1), -std::sin(0.1), 0.0);
        station.airfoil = station.next_airfoil = std::make_shared<test::Airfoil>();
        blade->add(std::move(station));
      }
      blades.push_back(blade.get());
      model_.add_load(std::move(blade));
    }
    model_.add_load(std::make_unique<RotorLoad>("rotor", model_.nodes(), RotorHub{0, Vec3::UnitX()},
                                                blades, kind));
    model_.freeze(model::Form::null_space);
    dense_ = std::make_unique<kit::DenseAssembly>(model_);
    state_ = model_.initial_state();
    state_.velocity.assign(state_.prev.size(), 0.0);
    state_.acceleration_offset.assign(state_.prev.size(), 0.0);
  }

  // Turns all nodes, and blades some way of their own, as far as the number says.
  void move(double vibration) {
    state_.next = state_.prev;
    kit::Random random(5);
    for (int node = 0; node <= num_blades; ++node) {
      auto slots = model::NodeTable::slots(state_.next, node);
      Vec3 turn = omega * h * axis_;
      if (node > 0) {
        turn += 0.1 * vibration * h * random.vector();
        slots.col(0) += vibration * h * random.vector();
      }
      slots.rightCols<3>() = Mat3(exp_rotation(turn) * slots.rightCols<3>());
    }
    state_.time = state_.time_prev + h;
    dense_->prepare(state_, stencil());
    dense_->residual(state_, stencil());
  }
  void accept() {
    dense_->accept(state_);
    state_.prev = state_.next;
    state_.time_prev = state_.time;
  }
  // Of blades by blades: how far the tangent is from differences, and from those of air of which
  // nothing follows the motion, over the largest entry.
  double error() {
    const Eigen::MatrixXd K = dense_->tangent(state_, stencil());
    const Eigen::MatrixXd expected = dense_->difference_tangent(state_, stencil(), {}, 2e-5);
    const int first = 6, size = 6 * num_blades;
    return kit::largest((K - expected).block(first, first, size, size)) / kit::largest(expected);
  }

 private:
  static Stencil stencil() { return Stencil::midpoint(h); }

  Vec3 axis_;
  model::Model model_;
  std::unique_ptr<kit::DenseAssembly> dense_;
  model::State state_;
};

// The rest of the slope is that of the section by itself, which has a test of its own.
TEST(RotorTangent, IsTheDerivativeByTheMotionOfTheBlades) {
  for (const Follow follow : {Follow::none, Follow::frozen, Follow::steady, Follow::dynamic}) {
    SCOPED_TRACE(static_cast<int>(follow));
    Rotor rotor({follow, {}, true, false});
    rotor.move(0.5);
    EXPECT_LT(rotor.error(), 1e-7);
    rotor.accept();
    rotor.move(2.0);
    EXPECT_LT(rotor.error(), 1e-7);
  }
}

}  // namespace
}  // namespace culm::rotor
