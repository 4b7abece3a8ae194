// The load Rotor on blades that one node carries.
#include <culm/rotor/induction.hpp>
#include <culm/rotor/rotor_load.hpp>
#include <culm/rotor/skewed_wake.hpp>

#include "rotor_kit.hpp"

#include <Eigen/Geometry>
#include <culm_kit/batch_laws.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

namespace culm::rotor {
namespace {

using std::numbers::pi;
using test::Airfoil;
using test::Wind;

constexpr int num_blades = 3, num_stations = 4;
constexpr double root = 2.0, tip = 10.0, chord = 0.8, twist = 0.1;
constexpr double h = 1e-4, omega = 6.0;  // the turn in a step is so small that its chord is its arc

// The axis is director 1; blade 1 points along director 3 and moves towards -2, or +2 if it turns
// the other way. Anywhere in space.
class Turbine {
 public:
  explicit Turbine(RotorModel kind, double sense = 1.0, double acting = 1.0) : sense_(sense) {
    slots_ = kit::random_node(7);
    model_.nodes().add(slots_);
    std::vector<strip::StripLoad*> blades;
    wind_ = std::make_shared<Wind>(1.2, axis() * 8.0);
    for (int b = 0; b < num_blades; ++b) {
      const Mat3 turn =
          Eigen::AngleAxisd(2.0 * pi * b / num_blades, Vec3::UnitX()).toRotationMatrix();
      auto blade = std::make_unique<strip::StripLoad>(
          "strips", model_.nodes(), model::Amplitude::constant(acting), wind_, strip::StripModel{});
      for (int i = 0; i < num_stations; ++i) {
        strip::Station station{model::marker_at(0), width(), chord, 0.25};
        station.point.offset = turn * Vec3(0.0, 0.0, radius(i));
        station.along = turn * Vec3(std::sin(twist), sense * std::cos(twist), 0.0);
        station.across = turn * Vec3(std::cos(twist), -sense * std::sin(twist), 0.0);
        station.airfoil = station.next_airfoil = std::make_shared<Airfoil>();
        blade->add(std::move(station));
      }
      blades.push_back(blade.get());
      model_.add_load(std::move(blade));
    }
    auto load = std::make_unique<RotorLoad>("tested", model_.nodes(), RotorHub{0, Vec3::UnitX()},
                                            blades, kind);
    rotor_ = load.get();
    model_.add_load(std::move(load));
    model_.freeze(model::Form::multipliers);
    dense_ = std::make_unique<kit::DenseAssembly>(model_);
    state_ = model_.initial_state();
    state_.velocity.assign(state_.prev.size(), 0.0);
    state_.acceleration_offset.assign(state_.prev.size(), 0.0);
  }

  // One evaluation of a step in which the rotor turns.
  void attempt(double speed, double step = h) {
    state_.next = state_.prev;
    const Mat3 turn = Eigen::AngleAxisd(sense_ * speed * step, axis()).toRotationMatrix();
    auto next = model::NodeTable::slots(state_.next, 0);
    next.rightCols<3>() = Mat3(turn * next.rightCols<3>());
    state_.time = state_.time_prev + step;
    const Stencil stencil = step > 0.0 ? Stencil::midpoint(step) : Stencil::statics();
    dense_->prepare(state_, stencil);
    dense_->residual(state_, stencil);
  }
  void accept() {
    dense_->accept(state_);
    state_.prev = state_.next;
    state_.time_prev = state_.time;
  }

  static double width() { return (tip - root) / num_stations; }
  static double radius(int i) { return root + (i + 0.5) * width(); }
  Vec3 axis() const { return slots_.col(1); }
  // In the directors of blade 1: along the axis, and against the motion.
  Induced induced(int station, int blade = 0) const {
    const auto now = model::NodeTable::slots(state_.next, 0);
    const Mat3 turn =
        Eigen::AngleAxisd(2.0 * pi * blade / num_blades, Vec3::UnitX()).toRotationMatrix();
    const Vec3 u = turn.transpose() *
                   (now.rightCols<3>().transpose() *
                    rotor_->blades()[static_cast<std::size_t>(blade)]->induced(station).velocity);
    return {u[0], sense_ * u[1]};
  }
  // What the balance gives by itself.
  Induced balance(int station, double wind, const Losses& losses = {}, double acting = 1.0) const {
    const double r = radius(station);
    const auto section = [](double alpha) {
      strip::Coefficients slope;
      const strip::Coefficients c = Airfoil().at(alpha, slope);
      return LiftDrag{c[0], c[1]};
    };
    const Induction found = solve_induction(
        {{num_blades, r, root, tip}, losses, acting * chord, twist, wind, omega * r}, section);
    return {-found.axial * wind, found.tangential * omega * r};
  }

  RotorLoad& rotor() { return *rotor_; }
  const model::Coordinates& reference() const { return model_.nodes().reference(); }
  Wind& wind() { return *wind_; }

 private:
  double sense_;
  model::NodeSlots slots_;
  model::Model model_;
  std::shared_ptr<Wind> wind_;
  RotorLoad* rotor_ = nullptr;
  std::unique_ptr<kit::DenseAssembly> dense_;
  model::State state_;
};

// Of the motion in a step: places and speeds differ by (omega h)^2 / 8.
constexpr double tolerance = 1e-5;

TEST(RotorLoad, InducesWhatTheBalanceOfEachStationAsksFor) {
  for (const double sense : {1.0, -1.0}) {
    Turbine turbine({Follow::steady}, sense);
    turbine.attempt(omega);
    for (int blade = 0; blade < num_blades; ++blade) {
      for (int i = 0; i < num_stations; ++i) {
        EXPECT_LT((turbine.induced(i, blade) - turbine.balance(i, 8.0)).norm(), tolerance);
      }
    }
    EXPECT_LT(turbine.induced(2)[0], -1.0);
  }
}

// As if the chord were so long.
TEST(RotorLoad, InducesByTheShareOfTheForcesThatActs) {
  for (const double acting : {0.5, 0.0}) {
    Turbine turbine({Follow::steady}, 1.0, acting);
    turbine.attempt(omega);
    EXPECT_LT((turbine.induced(2) - turbine.balance(2, 8.0, {}, acting)).norm(), tolerance);
  }
}

TEST(RotorLoad, LossesAreThoseThatAreNamed) {
  const Losses none{false, false};
  Turbine turbine({Follow::steady, none});
  turbine.attempt(omega);
  EXPECT_LT((turbine.induced(3) - turbine.balance(3, 8.0, none)).norm(), tolerance);
  EXPECT_GT((turbine.induced(3) - turbine.balance(3, 8.0)).norm(), 0.1);
}

TEST(RotorLoad, NothingIsInducedWithoutInductionAtRestAndByTipsSlowerThanTheWind) {
  Turbine off({Follow::none});
  off.attempt(omega);
  EXPECT_EQ(off.induced(2), Induced::Zero());
  Turbine still({Follow::dynamic});
  still.attempt(0.0, 0.0);
  EXPECT_EQ(still.induced(2), Induced::Zero());
  still.attempt(0.99 * 8.0 / tip);
  EXPECT_EQ(still.induced(2), Induced::Zero());
  still.attempt(1.5 * 8.0 / tip);
  EXPECT_LT(still.induced(2)[0], 0.0);
}

// The wind grows in the second step, which is tried twice before it is accepted.
TEST(RotorLoad, WakesFollowWithTheirLagsOncePerAcceptedStep) {
  Turbine turbine({Follow::dynamic});
  turbine.attempt(omega);
  turbine.accept();
  const InflowState before = InflowState::steady(turbine.balance(1, 8.0));
  EXPECT_LT((turbine.induced(1) - before.induced).norm(), tolerance);
  const double mean = turbine.rotor().state()->induction;
  EXPECT_GT(mean, 0.1);
  turbine.wind().velocity *= 1.25;
  const double step = 1e-3;
  const InflowTimes first = inflow_times(mean, 8.0, tip, Turbine::radius(1) / tip);
  const Induced asked = turbine.balance(1, 10.0);
  const InflowState after = before.after(step, first, asked, asked);
  for (int attempt = 0; attempt < 2; ++attempt) {
    turbine.attempt(omega, step);
    EXPECT_LT((turbine.induced(1) - 0.5 * (before.induced + after.induced)).norm(), tolerance);
  }
  turbine.accept();
  const InflowTimes second =
      inflow_times(turbine.rotor().state()->induction, 10.0, tip, Turbine::radius(1) / tip);
  const InflowState last = after.after(step, second, asked, asked);
  turbine.attempt(omega, step);
  EXPECT_LT((turbine.induced(1) - 0.5 * (after.induced + last.induced)).norm(), tolerance);
}

TEST(RotorLoad, FrozenWakesStay) {
  Turbine turbine({Follow::frozen});
  turbine.attempt(omega);
  turbine.accept();
  const Induced before = turbine.induced(1);
  turbine.wind().velocity *= 1.25;
  turbine.attempt(omega);
  EXPECT_LT((turbine.induced(1) - before).norm(), 1e-12);
}

TEST(RotorLoad, RestoredWakesGoOnAsTheyWere) {
  Turbine turbine({Follow::dynamic});
  turbine.attempt(omega);
  turbine.accept();
  std::vector<double> memory(turbine.rotor().memory_size());
  turbine.rotor().save(model::Items::local, memory);
  turbine.wind().velocity *= 1.25;
  turbine.attempt(omega);
  const Induced first = turbine.induced(1);
  turbine.accept();
  turbine.attempt(omega);
  EXPECT_NE(turbine.induced(1), first);
  turbine.rotor().restore(memory);
  std::vector<double> again(memory.size());
  turbine.rotor().save(model::Items::local, again);
  EXPECT_EQ(memory, again);
}

TEST(RotorLoad, SkewedWakesInduceMoreDownwind) {
  Turbine plain({Follow::steady, {}, true, false});
  Turbine skewed({Follow::steady, {}, true, true});
  for (Turbine* turbine : {&plain, &skewed}) {
    turbine->wind().velocity = 8.0 * turbine->axis() + 2.0 * turbine->axis().unitOrthogonal();
    turbine->attempt(omega);
  }
  const Vec3 sideways = plain.axis().unitOrthogonal();
  const double skew = wake_skew(std::atan2(2.0, 8.0), 0.0);
  const auto slots = kit::random_node(7);
  const double cosine = Vec3(slots.col(3)).dot(sideways);
  EXPECT_NEAR(skewed.induced(2)[0] / plain.induced(2)[0],
              skew_factor(skew, Turbine::radius(2) / tip, std::acos(cosine)), 1e-3);
  EXPECT_NEAR(skewed.induced(2)[1], plain.induced(2)[1], 1e-12);
}

TEST(RotorLoad, KnowsItsMotionAndItsWind) {
  Turbine turbine({Follow::steady});
  EXPECT_FALSE(turbine.rotor().state());
  turbine.attempt(omega);
  EXPECT_FALSE(turbine.rotor().state());
  turbine.accept();
  const RotorState seen = *turbine.rotor().state();
  EXPECT_NEAR(seen.speed, omega, 1e-9);
  EXPECT_LT((seen.axis - turbine.axis()).norm(), 1e-12);
  EXPECT_LT((seen.wind - 8.0 * turbine.axis()).norm(), 1e-12);
  EXPECT_NEAR(turbine.rotor().tip_radius(), tip, 1e-12);
}

TEST(RotorLoad, AzimuthGoesRoundWithTheHubAndNotWithItsAxis) {
  Turbine turbine({Follow::steady});
  const Vec3 axis = turbine.axis();
  const Vec3 sideways = axis.unitOrthogonal();
  const auto azimuth = [&](double turn, double lean) {
    model::Coordinates q = turbine.reference();
    auto slots = model::NodeTable::slots(q, 0);
    const Mat3 both = Eigen::AngleAxisd(lean, sideways).toRotationMatrix() *
                      Eigen::AngleAxisd(turn, axis).toRotationMatrix();
    slots.rightCols<3>() = Mat3(both * slots.rightCols<3>());
    return turbine.rotor().azimuth(q);
  };
  for (const double lean : {0.0, 0.3}) {
    for (const double turn : {0.0, 0.5, 3.0, 3.5, 6.0}) {
      EXPECT_NEAR(azimuth(turn, lean), turn, 1e-12) << lean;
    }
    EXPECT_NEAR(azimuth(2.0 * pi, lean), 0.0, 1e-12);
    EXPECT_NEAR(azimuth(-0.5, lean), 2.0 * pi - 0.5, 1e-12);
  }
}

}  // namespace
}  // namespace culm::rotor
