#include "strip_kit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <iterator>
#include <memory>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

namespace culm::strip {
namespace {

using std::numbers::pi;
using test::Bent;
using test::effect;
using test::Wind;

Station station(model::Marker point) {
  Station station{std::move(point), 0.8, 1.3, 0.4};
  station.along = Vec3(std::cos(0.2), -std::sin(0.2), 0.0);
  station.across = Vec3(std::sin(0.2), std::cos(0.2), 0.0);
  station.airfoil = std::make_shared<Bent>();
  station.next_airfoil = station.airfoil;
  return station;
}

void fill(model::Model& model, bool with_slave) {
  for (const int seed : {10, 11}) model.nodes().add(kit::random_node(seed));
  const auto amplitude = model::Amplitude::of_time([](double t) { return 1.0 + t; });
  auto load = std::make_unique<StripLoad>(effect, model.nodes(), amplitude,
                                          std::make_shared<Wind>(1.2, Vec3(3.0, 7.0, -2.0)),
                                          StripModel{Lag::jones(), true});
  load->add(station({{0, 1}, {0.3, 0.7}, Vec3::Zero()}));
  load->add(station(model::marker_at(1)));
  model.add_load(std::move(load));
  if (with_slave) model.add_rigid_link("link", 0, model.nodes().add(kit::random_node(20)));
}

TEST(StripLoad, TangentIsDerivativeOfResidual) {
  for (const bool with_slave : {false, true}) {
    kit::expect_tangent_is_derivative([&](model::Model& model) { fill(model, with_slave); }, effect,
                                      1e-4);
  }
}

// As in a wind with shear in all directions, which carries what is induced with it.
TEST(StripLoad, TangentKnowsTheGradientOfTheWind) {
  class Sheared final : public flow::Flow {
   public:
    Sheared() : Flow(1.2) { gradient_ << 0.4, -1.0, 0.7, 0.9, 0.3, -0.5, -0.8, 0.6, 1.1; }
    void velocities(std::span<const Vec3> places, double,
                    std::span<Vec3> velocities) const override {
      for (std::size_t i = 0; i < places.size(); ++i) {
        velocities[i] = Vec3(3.0, 7.0, -2.0) + gradient_ * places[i];
      }
    }
    Mat3 gradient(const Vec3&, double) const override { return gradient_; }

   private:
    Mat3 gradient_;
  };
  // induces a share of what the section feels
  class Slows final : public Inducer {
   public:
    explicit Slows(StripLoad& load) : load_(load) {}
    void induce(const model::State& state, const Stencil& stencil) override {
      InducedVelocity induced;
      const Mat3 share = Vec3(-0.3, -0.2, -0.1).asDiagonal();
      induced.velocity = share * load_.flow_at(0, state, stencil).relative();
      induced.slope.leftCols<3>() = -share;
      load_.set_induced(0, induced);
    }

   private:
    StripLoad& load_;
  };
  std::vector<std::unique_ptr<Slows>> inducers;
  const auto fill_sheared = [&](model::Model& model) {
    for (const int seed : {10, 11}) model.nodes().add(kit::random_node(seed));
    auto load =
        std::make_unique<StripLoad>(effect, model.nodes(), model::Amplitude::constant(),
                                    std::make_shared<Sheared>(), StripModel{Lag::jones(), true});
    load->add(station({{0, 1}, {0.3, 0.7}, Vec3(0.1, -0.2, 0.0)}));
    inducers.push_back(std::make_unique<Slows>(*load));
    load->set_inducer(inducers.back().get());
    model.add_load(std::move(load));
  };
  kit::expect_tangent_is_derivative(fill_sheared, effect, 1e-4);
  kit::expect_no_allocation(fill_sheared, effect);
}

TEST(StripLoad, NullSpaceResidualIsProjected) {
  for (const bool with_slave : {false, true}) {
    kit::expect_residual_is_projected([&](model::Model& model) { fill(model, with_slave); },
                                      effect);
  }
}

TEST(StripLoad, AssembleAllocatesNothing) {
  kit::expect_no_allocation([](model::Model& model) { fill(model, true); }, effect);
}

TEST(StripLoad, AttemptsLeaveNoTrace) {
  kit::expect_attempts_leave_no_trace([](model::Model& model) { fill(model, false); }, effect);
}

// One node whose third director is the span; the tail points along x, positive lift along y.
struct Section {
  Section(const StripModel& strip, const Vec3& wind, double axis_at, SharedAirfoil airfoil) {
    model::NodeSlots slots;
    slots << Vec3::Zero(), Mat3::Identity();
    model.nodes().add(slots);
    auto load = std::make_unique<StripLoad>(effect, model.nodes(), model::Amplitude::constant(),
                                            std::make_shared<Wind>(density, wind), strip);
    Station one{model::marker_at(0), 1.0, 2.0 * b, axis_at, Vec3::UnitX(), Vec3::UnitY()};
    one.airfoil = one.next_airfoil = std::move(airfoil);
    load->add(std::move(one));
    batch = load.get();
    model.add_load(std::move(load));
    model.freeze(model::Form::null_space);
    assembly = std::make_unique<kit::DenseAssembly>(model);
    state.prev = state.next = model.nodes().reference();
    state.velocity.assign(state.prev.size(), 0.0);
    state.acceleration_offset.assign(state.prev.size(), 0.0);
  }
  /// Force and moment about the node.
  Vec6 load(const Stencil& stencil) {
    const Eigen::VectorXd residual = assembly->residual(state, stencil, {batch});
    return -residual.head<6>();
  }

  static constexpr double density = 1.225, b = 0.5;
  model::Model model;
  StripLoad* batch = nullptr;
  std::unique_ptr<kit::DenseAssembly> assembly;
  model::State state;
};

class Flat final : public Airfoil {
 public:
  explicit Flat(double moment = 0.0) : moment_(moment) {}
  Coefficients at(double alpha, Coefficients& slope) const override {
    slope = {2.0 * pi * std::cos(alpha), 0.0, 0.0};
    return {2.0 * pi * std::sin(alpha), 0.0, moment_};
  }

 private:
  double moment_;
};

TEST(StripLoad, SteadyLiftIsAcrossTheWindAtTheQuarterChord) {
  const double alpha = 0.1, V = 20.0;
  Section section({}, V * Vec3(std::cos(alpha), std::sin(alpha), 0.0), 0.4,
                  std::make_shared<Flat>());
  const Vec6 load = section.load(Stencil::statics());
  const double lift = 0.5 * Section::density * V * V * 2.0 * pi * std::sin(alpha);
  EXPECT_NEAR(load[0], -lift * std::sin(alpha), 1e-12 * lift);
  EXPECT_NEAR(load[1], lift * std::cos(alpha), 1e-12 * lift);
  // lift acts 0.15 chords before the axis: nose up, which is about -z
  EXPECT_NEAR(load[5], -0.15 * load[1], 1e-12 * lift);
  EXPECT_FALSE(section.batch->state(0));  // nothing was accepted
  EXPECT_FALSE(section.batch->resultant());
  section.batch->accept(section.state);
  EXPECT_NEAR(section.batch->state(0)->angle, alpha, 1e-15);
  EXPECT_NEAR(section.batch->resultant()->force[1], load[1], 1e-12 * lift);
  EXPECT_NEAR(section.batch->resultant()->moment[2], load[5], 1e-12 * lift);
}

// What was accepted comes back, and what was tried since does not count.
TEST(StripLoad, StationsAreThoseOfTheAcceptedStep) {
  Section section({Lag::jones(), true}, Vec3(20.0, 2.0, 0.0), 0.4, std::make_shared<Flat>());
  section.load(Stencil::statics());
  section.batch->accept(section.state);
  std::vector<double> memory(section.batch->memory_size());
  section.batch->save(model::Items::owned, memory);
  const double angle = section.batch->state(0)->angle;
  const Vec3 force = section.batch->resultant()->force;
  section.state.next[1] += 1.0;
  section.load(Stencil::midpoint(0.1));
  EXPECT_EQ(section.batch->state(0)->angle, angle);
  section.batch->accept(section.state);
  EXPECT_NE(section.batch->state(0)->angle, angle);
  section.batch->restore(memory);
  EXPECT_EQ(section.batch->state(0)->angle, angle);
  EXPECT_EQ(section.batch->resultant()->force, force);
}

TEST(StripLoad, DelaysAreThoseOfTheLag) {
  const auto flat = std::make_shared<Flat>();
  const Section section({Lag::jones(), true}, Vec3(10.0, 0.0, 0.0), 0.4, flat);
  const std::vector<double> delays = section.batch->delays(section.state);
  ASSERT_EQ(delays.size(), 2U);
  EXPECT_DOUBLE_EQ(delays[0], Section::b / (0.0455 * 10.0));
  EXPECT_DOUBLE_EQ(delays[1], Section::b / (0.3 * 10.0));
  const Section calm({Lag::jones(), true}, Vec3::Zero(), 0.4, flat);
  EXPECT_TRUE(calm.batch->delays(calm.state).empty());
  const Section prompt({}, Vec3(10.0, 0.0, 0.0), 0.4, flat);
  EXPECT_TRUE(prompt.batch->delays(prompt.state).empty());
}

TEST(StripLoad, SaysWhereItsMethodEnds) {
  class Limited final : public Airfoil {
   public:
    Coefficients at(double, Coefficients& slope) const override { return slope.setZero(); }
    std::optional<double> good_to() const override { return 0.2; }
  };
  for (const double angle : {0.1, 0.3}) {
    Section section({Lag::jones(), true}, 20.0 * Vec3(std::cos(angle), std::sin(angle), 0.0), 0.25,
                    std::make_shared<Limited>());
    section.load(Stencil::statics());
    section.batch->accept(section.state);
    EXPECT_NEAR(section.batch->range_used(), angle / 0.2, 1e-13);
  }
}

TEST(StripLoad, MomentIsNoseUp) {
  Section section({}, Vec3(20.0, 0.0, 0.0), 0.25, std::make_shared<Flat>(0.1));
  const Vec6 load = section.load(Stencil::statics());
  EXPECT_LT(load.head<5>().norm(), 1e-12);
  EXPECT_NEAR(load[5], -0.5 * Section::density * 400.0 * 0.1, 1e-12);
}

// Jones' approximation of Wagner's function, to rounding: constant downwash from a sudden start.
// @source fluids C2
TEST(StripLoad, SuddenStartFollowsWagner) {
  const double alpha = 1e-4, V = 10.0, h = 0.01;
  Section section({Lag::jones(), false}, V * Vec3(std::cos(alpha), std::sin(alpha), 0.0), 0.25,
                  std::make_shared<Flat>());
  // half chords, and the response after them
  const std::pair<double, double> table[] = {{1, .594165},  {2, .665500},  {4, .761556},
                                             {6, .819045},  {10, .878637}, {20, .932753},
                                             {40, .973264}, {100, .998256}};
  std::size_t known = 0;
  std::vector<double> memory(section.batch->memory_size());
  for (int step = 1; step <= 500; ++step) {
    section.load(Stencil::midpoint(h));
    section.batch->accept(section.state);
    section.batch->save(model::Items::local, memory);
    const double s = V * step * h / Section::b;
    const double share = 0.5 + (memory[1] + memory[2]) / (V * std::sin(alpha));
    const double jones = 1.0 - 0.165 * std::exp(-0.0455 * s) - 0.335 * std::exp(-0.3 * s);
    EXPECT_NEAR(share, jones, 1e-12);
    if (known < std::size(table) && std::abs(s - table[known].first) < 1e-9) {
      EXPECT_NEAR(share, table[known++].second, 1e-6);
    }
  }
  EXPECT_EQ(known, std::size(table));
}

// Loads without circulation of thin-airfoil theory at rest: lift pi rho b^2 (h'' - b a alpha''),
// moment nose up pi rho b^2 (b a h'' - b^2 (1/8 + a^2) alpha''), with h downwards. @source fluids
// B2
TEST(StripLoad, ApparentMassIsTheodorsens) {
  const double a = -0.2;  // axis at 0.4
  Section section({{}, true}, Vec3::Zero(), 0.4, std::make_shared<Flat>());
  const double ma = pi * Section::density * Section::b * Section::b;
  const auto with_acceleration = [&](const Vec3& x, const Vec3& angular) {
    model::NodeSlots acceleration;
    acceleration << x, skew(angular) * Mat3::Identity();
    Eigen::Map<Mat<3, 4>>(section.state.acceleration_offset.data()) = acceleration;
    return section.load(Stencil::midpoint(0.1));
  };
  const double b = Section::b, up = 1.7, nose_up = 2.3;
  const Vec6 plunge = with_acceleration({0.0, up, 0.0}, Vec3::Zero());
  EXPECT_NEAR(plunge[1], -ma * up, 1e-13);
  EXPECT_NEAR(-plunge[5], -ma * b * a * up, 1e-13);
  const Vec6 pitch = with_acceleration(Vec3::Zero(), {0.0, 0.0, -nose_up});
  EXPECT_NEAR(pitch[1], -ma * b * a * nose_up, 1e-13);
  EXPECT_NEAR(-pitch[5], -ma * b * b * (0.125 + a * a) * nose_up, 1e-13);
}

TEST(StripLoad, WorkIsForceTimesMotion) {
  model::Model model;
  fill(model, false);
  model.freeze(model::Form::multipliers);
  kit::DenseAssembly dense(model);
  const model::State state = kit::random_state(model, 3);
  const Stencil stencil = Stencil::midpoint(state.time - state.time_prev);
  model::Batch* batch = kit::find_batch(model, effect);
  const Vec<24> r = dense.residual(state, stencil, {batch}).head<24>();
  const Eigen::Map<const Vec<24>> prev(state.prev.data());
  const Eigen::Map<const Vec<24>> next(state.next.data());
  EXPECT_NEAR(batch->step_work(state, stencil).external, -r.dot(next - prev), 1e-10);
}

}  // namespace
}  // namespace culm::strip
