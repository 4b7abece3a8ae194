#include <culm/math/rotation.hpp>

#include "strip_kit.hpp"

#include <gtest/gtest.h>

#include <complex>
#include <numbers>
#include <vector>

namespace culm::strip {
namespace {

using namespace test;
using std::numbers::pi;

// Between two nodes, with everything on: twisted, drag, moment, camber, lag, apparent mass.
Station between_nodes() {
  Station station = section(
      0.8, 0.33, airfoil("Thin", {{"Zero Lift", -0.05}, {"Drag", 0.02}, {"Moment", -0.07}}));
  station.point = {{0, 1}, {0.3, 0.7}, Vec3(0.02, -0.01, 0.0)};
  station.along = Vec3(std::cos(0.2), -std::sin(0.2), 0.0);
  station.across = Vec3(std::sin(0.2), std::cos(0.2), 0.0);
  return station;
}

class Effects : public testing::TestWithParam<StripModel> {
 protected:
  static void fill(model::Model& model, const Mat3& turned) {
    for (const int seed : {10, 11}) {
      model.nodes().add(turned * kit::random_node(seed));
    }
    auto load = std::make_unique<StripLoad>(
        effect, model.nodes(), model::Amplitude::constant(),
        std::make_shared<Wind>(1.3, turned * Vec3(9.0, 4.0, -3.0)), GetParam());
    load->add(between_nodes());
    load->set_induced(0, {turned * Vec3(-0.5, 0.3, 0.2)});
    model.add_load(std::move(load));
  }
};

TEST_P(Effects, TurnWithStructureAndWind) {
  const Mat3 turned = exp_rotation(Vec3(0.7, -0.4, 1.1));
  Vec<24> forces[2];
  for (const bool turn : {false, true}) {
    model::Model model;
    fill(model, turn ? turned : Mat3::Identity());
    model.freeze(model::Form::multipliers);
    model::Model plain;
    fill(plain, Mat3::Identity());
    plain.freeze(model::Form::multipliers);
    model::State state = kit::random_state(plain, 5);
    if (turn) {
      for (auto* values : {&state.prev, &state.next, &state.velocity, &state.acceleration_offset}) {
        Eigen::Map<Eigen::Matrix3Xd> columns(values->data(), 3,
                                             static_cast<int>(values->size() / 3));
        columns = (turned * columns).eval();
      }
    }
    kit::DenseAssembly dense(model);
    forces[turn] =
        dense.residual(state, Stencil::midpoint(0.4), {kit::find_batch(model, effect)}).head<24>();
  }
  Eigen::Map<Eigen::Matrix<double, 3, 8>> before(forces[0].data());
  const Eigen::Matrix<double, 3, 8> expected = turned * before;
  EXPECT_LT((Eigen::Map<Eigen::Matrix<double, 3, 8>>(forces[1].data()) - expected).norm(),
            1e-13 * forces[0].norm());
}

INSTANTIATE_TEST_SUITE_P(Strip, Effects,
                         testing::Values(StripModel{}, StripModel{Lag::jones(), false},
                                         StripModel{Lag::airfoil(), false}, StripModel{Lag{}, true},
                                         StripModel{Lag::jones(), true}));

// C1: what C(k) of the lag is for a motion exp(i k s).
std::complex<double> of_frequency(const Lag& lag, double k) {
  std::complex<double> c = 1.0;
  const std::complex<double> ik(0.0, k);
  for (int i = 0; i < lag.states; ++i) c -= lag.amplitude[i] * ik / (ik + lag.rate[i]);
  return c;
}

TEST(Lag, IsTheodorsensFunctionWithinTheErrorOfJones) {
  const double k[] = {0.01, 0.05, 0.1, 0.2, 0.3, 0.5, 1.0, 2.0};
  const std::complex<double> theodorsen[] = {
      {.982422, -.045652}, {.909009, -.130644}, {.831924, -.172302}, {.727580, -.188624},
      {.664971, -.179319}, {.597936, -.150710}, {.539435, -.100273}, {.512955, -.057691}};
  for (int i = 0; i < 8; ++i) {
    EXPECT_LT(std::abs(of_frequency(Lag::jones(), k[i]) - theodorsen[i]),
              0.025 * std::abs(theodorsen[i]))
        << k[i];
  }
}

// C1: lift of a heaving plate over the last of some cycles against that of the frequency domain.
double heave_error(int steps_per_cycle) {
  const double b = 0.5, speed = 10.0, density = 1.225, k = 0.3, height = 1e-4;
  const double omega = k * speed / b;
  const double step = 2.0 * pi / omega / steps_per_cycle;
  MovedSection plate(section(2.0 * b, 0.5, airfoil("Thin", {})), {Lag::jones(), true}, density,
                     Vec3(speed, 0.0, 0.0), step);
  model::Coordinates velocity(12, 0.0);
  plate.start(placed(0, height, 0), velocity);
  std::complex<double> lift = 0.0;
  const int cycles = 30;
  for (int n = 0; n < cycles * steps_per_cycle; ++n) {
    const double force = plate.go(placed(0, height * std::cos(omega * step * (n + 1)), 0)).force[1];
    if (n < (cycles - 1) * steps_per_cycle) continue;
    lift += 2.0 / steps_per_cycle * force *
            std::exp(std::complex<double>(0.0, -omega * step * (n + 0.5)));
  }
  const std::complex<double> ih(0.0, omega * height);
  const std::complex<double> expected =
      pi * density * b * b * omega * omega * height -
      2.0 * pi * density * speed * b * of_frequency(Lag::jones(), k) * ih;
  return std::abs(lift - expected) / std::abs(expected);
}

TEST(StripLoads, HeaveAsTheodorsenSays) {
  const double coarse = heave_error(64), fine = heave_error(128);
  EXPECT_LT(fine, 5e-4);
  EXPECT_NEAR(coarse / fine, 4.0, 0.3);  // second order
}

// A constant turn in a wind: the three-quarter chord sees it, and V times the rate is a force
// there.
TEST(StripLoads, PitchRateActsAsInThinAirfoilTheory) {
  const double b = 0.5, density = 1.2, speed = 20.0, rate = 1e-3, step = 1e-4, a = -0.2;
  MovedSection plate(section(2.0 * b, 0.5 * (1.0 + a), airfoil("Thin", {})), {Lag{}, true}, density,
                     Vec3(speed, 0, 0), step);
  model::Coordinates velocity(12, 0.0);
  velocity[4] = -rate;
  velocity[6] = rate;
  plate.start(placed(0, 0, -0.5 * rate * step), velocity);
  const Resultant load = plate.go(placed(0, 0, 0.5 * rate * step));
  const double downwash = b * (0.5 - a) * rate;
  const double circulatory = 2.0 * pi * density * speed * b * downwash;
  const double carried = pi * density * b * b * speed * rate;
  EXPECT_NEAR(load.force[1], circulatory + carried, 1e-7);
  EXPECT_NEAR(-load.moment[2], b * (0.5 + a) * circulatory - b * (0.5 - a) * carried, 1e-7);
}

TEST(StripLoads, InducedVelocityAddsToTheWind) {
  const Vec3 wind(10.0, 1.0, 0.0), induced(-2.0, 0.5, 0.0);
  Resultant loads[2];
  for (const bool split : {false, true}) {
    MovedSection plate(section(1.5, 0.4, airfoil("Thin", {{"Drag", 0.1}})), {}, 1.2,
                       split ? Vec3(wind - induced) : wind, 0.1);
    if (split) plate.load().set_induced(0, {induced});
    plate.start(placed(0, 0, 0), model::Coordinates(12, 0.0));
    loads[split] = plate.go(placed(0, 0, 0.1));
    if (!split) continue;
    EXPECT_EQ(plate.load().induced(0).velocity, induced);
  }
  EXPECT_LT((loads[0].force - loads[1].force).norm(), 1e-12);
  EXPECT_LT((loads[0].moment - loads[1].moment).norm(), 1e-12);
}

TEST(StripLoads, ShowTheFlowThatStationsMeet) {
  const double step = 0.1;
  MovedSection plate(section(2.0, 0.5, airfoil("Thin", {})), {}, 1.2, Vec3(10, 1, 0), step);
  plate.start(placed(3, 4, 0), model::Coordinates(12, 0.0));
  plate.go(placed(3.2, 4, 0), false);
  const StationFlow found = plate.load().flow_at(0, plate.state(), plate.stencil());
  EXPECT_LT((found.place - Vec3(2.6, 4, 0)).norm(), 1e-14);  // half a metre before the axis
  EXPECT_LT((found.relative() - Vec3(8, 1, 0)).norm(), 1e-13);
  EXPECT_LT((found.along - Vec3::UnitX()).norm(), 1e-15);
  EXPECT_LT((found.across - Vec3::UnitY()).norm(), 1e-15);
  const StationFlow still = plate.load().flow_at(0, plate.state(), Stencil::statics());
  EXPECT_EQ(still.velocity, Vec3(Vec3::Zero()));
}

TEST(StripLoads, RememberTheLagForRunsThatGoOn) {
  const StripModel kind{Lag::jones(), true};
  const Station station = section(1.0, 0.3, airfoil("Thin", {}));
  MovedSection first(station, kind, 1.2, Vec3(10, 0, 0), 0.05);
  MovedSection second(station, kind, 1.2, Vec3(10, 0, 0), 0.05);
  first.start(placed(0, 0, 0), model::Coordinates(12, 0.0));
  for (int n = 1; n < 5; ++n) first.go(placed(0, 0.02 * n, 0.03 * n));
  std::vector<double> memory(first.load().memory_size());
  first.load().save(model::Items::owned, memory);
  second.start(first.state().prev, first.state().velocity);
  second.load().restore(memory);
  const model::Coordinates q = placed(0.0, 0.1, 0.1);
  EXPECT_EQ(first.go(q).force, second.go(q).force);
}

TEST(StripLoads, AreQuietWithoutWind) {
  MovedSection plate(section(1.0, 0.3, airfoil("Thin", {{"Drag", 0.1}})), {Lag::jones(), false},
                     1.2, Vec3::Zero(), 0.05);
  plate.start(placed(0, 0, 0), model::Coordinates(12, 0.0));
  EXPECT_EQ(plate.go(placed(0, 0, 0)).force, Vec3(Vec3::Zero()));
}

}  // namespace
}  // namespace culm::strip
