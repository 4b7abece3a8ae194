#include <culm/base/error.hpp>
#include <culm/control/actuator.hpp>
#include <culm/control/block_batch.hpp>
#include <culm/control/extreme.hpp>
#include <culm/control/integral.hpp>
#include <culm/control/lag.hpp>
#include <culm/control/pi_controller.hpp>
#include <culm/control/product.hpp>
#include <culm/control/table.hpp>
#include <culm/control/weighted_sum.hpp>

#include <culm_kit/batch_laws.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <initializer_list>
#include <memory>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace culm::control {
namespace {

using kit::effect;

struct Subject {
  std::string name;
  std::function<std::unique_ptr<Block>()> make;
  int inputs = 1;
};

void PrintTo(const Subject& subject, std::ostream* out) { *out << subject.name; }

const Limits wide{-10.0, 10.0};
const Limits narrow{-0.01, 0.02};
const Limits wider{-20.0, 20.0};

// The block follows a signal of another block that it is followed by in turn, and functions.
void fill_with_block(const Subject& subject, model::Model& model) {
  auto batch = std::make_unique<BlockBatch>(effect, model);
  const model::Signal tested = batch->add("tested", subject.make());
  const model::Signal other = batch->add("other", std::make_unique<Lag>(0.3, wide, wide, 1.4));
  std::vector<model::Amplitude> inputs = {model::Amplitude::of_signal(other)};
  while (static_cast<int>(inputs.size()) < subject.inputs) {
    inputs.push_back(model::Amplitude::of_time([](double t) { return 0.3 + t * t; }));
  }
  batch->connect(tested, std::move(inputs), 0.1);
  batch->connect(other, {model::Amplitude::of_signal(tested)}, -0.2);
  batch->settle();
  model.add_load(std::move(batch));
}

class Blocks : public testing::TestWithParam<Subject> {};

TEST_P(Blocks, TangentIsDerivativeOfResidual) {
  kit::expect_tangent_is_derivative([](model::Model& model) { fill_with_block(GetParam(), model); },
                                    effect, 1e-3);
}

TEST_P(Blocks, LinearisationIsDerivativeOfResidual) {
  model::Model model;
  fill_with_block(GetParam(), model);
  model.freeze(model::Form::null_space);
  kit::DenseAssembly dense(model);
  const model::State state = kit::random_state(model, 3);
  const Stencil stencil = Stencil::linearisation();
  const Eigen::MatrixXd expected = dense.difference_tangent(state, stencil, {}, 1e-3);
  EXPECT_LT(kit::largest(dense.tangent(state, stencil) - expected),
            1e-11 * (1.0 + kit::largest(expected)));
}

TEST_P(Blocks, AssembleAllocatesNothing) {
  kit::expect_no_allocation([](model::Model& model) { fill_with_block(GetParam(), model); },
                            effect);
}

TEST_P(Blocks, StatesStandStillInStatics) {
  model::Model model;
  fill_with_block(GetParam(), model);
  model.freeze(model::Form::null_space);
  kit::DenseAssembly dense(model);
  model::State state = kit::random_state(model, 3);
  const auto& unknowns = model.own_blocks().front().unknowns;
  for (int i = 0; i < static_cast<int>(unknowns.size()); ++i) {
    if (unknowns[static_cast<std::size_t>(i)].kind != model::UnknownKind::first_order) continue;
    const auto at = static_cast<std::size_t>(model.signal(0, i).index);
    state.own[at] = state.own_prev[at];
    EXPECT_EQ(dense.residual(state, Stencil::statics())[i], 0.0);
  }
}

std::unique_ptr<Block> make_pi(const Limits& limits, double halved_at = 1.0) {
  return std::make_unique<PiController>(0.7, 1.3, 0.9, 1.4, limits, 2.0, halved_at);
}

INSTANTIATE_TEST_SUITE_P(
    All, Blocks,
    testing::Values(
        Subject{"Lag", [] { return std::make_unique<Lag>(0.4, wide, wide, 0.7); }},
        Subject{"LagAtItsRate", [] { return std::make_unique<Lag>(0.4, narrow, wide, 0.7); }},
        Subject{"LagAtItsLimit", [] { return std::make_unique<Lag>(0.4, wide, narrow, 0.7); }},
        Subject{"Actuator", [] { return std::make_unique<Actuator>(2.0, 0.7, wide, wide, 0.5); }},
        Subject{"ActuatorAtItsRate",
                [] { return std::make_unique<Actuator>(2.0, 0.7, narrow, wide, 0.5); }},
        Subject{"Pi", [] { return make_pi(wide); }, 2},
        Subject{"PiAtItsLimit", [] { return make_pi(narrow); }, 2},
        Subject{"PiWithSchedule", [] { return make_pi(wide, 0.4); }, 3},
        Subject{"PiWithScheduleAtItsLimit", [] { return make_pi(narrow, 0.4); }, 3},
        Subject{"Integral", [] { return std::make_unique<Integral>(1.8, 3.0); }},
        Subject{"IntegralAtItsLimit",
                [] { return std::make_unique<Integral>(1.8, 3.0, narrow, 0.3); }},
        Subject{"Table",
                [] {
                  return std::make_unique<Table>(
                      load::PiecewiseLinear({-20.0, 0.0, 20.0}, {3.0, 1.0, 5.0}), wider, 0.6);
                }},
        Subject{"TableBeyondItsPoints",
                [] {
                  return std::make_unique<Table>(load::PiecewiseLinear({40.0, 50.0}, {3.0, 1.0}),
                                                 Limits{40.0, 50.0}, 0.6);
                }},
        Subject{"Product",
                [] {
                  return std::make_unique<Product>(0.8, Eigen::Vector3d(2.0, 1.0, -1.0), wider,
                                                   0.7);
                },
                3},
        Subject{"ProductAtItsLimit",
                [] {
                  return std::make_unique<Product>(-90.0, Eigen::Vector3d(0.0, 1.0, -1.0), narrow,
                                                   0.7);
                },
                3},
        Subject{"Least", [] { return std::make_unique<Extreme>(Extreme::Which::least, 0.7); }, 3},
        Subject{"Greatest", [] { return std::make_unique<Extreme>(Extreme::Which::greatest, 0.7); },
                2},
        Subject{"Sum",
                [] {
                  return std::make_unique<WeightedSum>(0.3, Eigen::Vector3d(1.1, -0.6, 0.9), wide,
                                                       2.0);
                },
                3}),
    [](const auto& tested) { return tested.param.name; });

// A chain that is added from its end: the last one starts at rest with what the first one is told.
TEST(BlockStarts, FollowTheirInputsInAnyOrder) {
  model::Model model;
  BlockBatch batch(effect, model);
  std::vector<model::Signal> lags;
  for (int i = 0; i < 4; ++i) {
    lags.push_back(batch.add("lag", std::make_unique<Lag>(0.3, wide, wide, 1.0)));
  }
  for (std::size_t i = 0; i < 3; ++i) {
    batch.connect(lags[i], {model::Amplitude::of_signal(lags[i + 1])}, {});
  }
  batch.connect(lags[3], {model::Amplitude::constant()}, 0.7);
  batch.settle();
  const model::State state = model.initial_state();
  for (const model::Signal& lag : lags) EXPECT_EQ(lag.in_step(state, 1.0), 0.7);
}

// What follows a controller starts with its integral, and not with 0; errors are not known yet.
TEST(BlockStarts, FollowTheOutputOfAController) {
  model::Model model;
  BlockBatch batch(effect, model);
  const model::Signal lag = batch.add("lag", std::make_unique<Lag>(0.3, wide, wide, 1.0));
  const model::Signal controller =
      batch.add("controller", std::make_unique<PiController>(3.0, 2.0, 0.8, 1.0, wide, 1.0));
  batch.connect(lag, {model::Amplitude::of_signal(controller)}, {});
  batch.connect(controller, {model::Amplitude::constant(), model::Amplitude::constant()}, 0.2);
  batch.settle();
  const model::State state = model.initial_state();
  EXPECT_EQ(controller.in_step(state, 1.0), 0.2);
  EXPECT_EQ(lag.in_step(state, 1.0), 0.2);
}

// The response of a block to an input of 1, step by step, as Newton's method finds it.
class Response {
 public:
  explicit Response(std::unique_ptr<Block> block, double initial = 0.0)
      : system_([&] {
          auto batch = std::make_unique<BlockBatch>(effect, model_);
          output_ = batch->add("block", std::move(block));
          batch->connect(output_, {model::Amplitude::constant(), model::Amplitude::constant(0.0)},
                         initial);
          batch->settle();
          model_.add_load(std::move(batch));
          model_.freeze(model::Form::null_space);
          return kit::DenseAssembly(model_);
        }()),
        state_(model_.initial_state()) {}

  void step(double h) {
    const Stencil stencil = Stencil::midpoint(h);
    state_.time += h;
    for (int iteration = 0; iteration < 3; ++iteration) {
      const Eigen::VectorXd r = system_.residual(state_, stencil);
      system_.move(state_, -system_.tangent(state_, stencil).partialPivLu().solve(r));
    }
    state_.time_prev = state_.time;
    state_.own_prev = state_.own;
  }
  double output() const { return value(0); }
  double value(int place) const { return state_.own[static_cast<std::size_t>(place)]; }

 private:
  model::Model model_;
  model::Signal output_;
  kit::DenseAssembly system_;
  model::State state_;
};

// The mid-point rule swings about a command with steps beyond two time constants; of an actuator
// with zeta = 1.25 and omega = 4 the fastest one is 1/8 s.
TEST(BlockRange, EndsAtTwoTimeConstants) {
  model::Model model;
  BlockBatch batch(effect, model);
  model::State state;
  const auto used = [&](double h) {
    batch.prepare(state, Stencil::midpoint(h));
    batch.accept(state);
    return batch.range_used();
  };
  batch.add("Sum 'all'", std::make_unique<WeightedSum>(0.3, Eigen::Vector2d(1.1, -0.6), wide, 1.0));
  EXPECT_EQ(used(0.1), 0.0);
  batch.add("Lag 'slow'", std::make_unique<Lag>(0.5, wide, wide, 1.0));
  EXPECT_NEAR(used(0.1), 0.1, 1e-8);
  batch.add("Actuator 'fast'", std::make_unique<Actuator>(4.0, 1.25, wide, wide, 1.0));
  EXPECT_NEAR(used(0.5), 2.0, 1e-8);
  EXPECT_EQ(batch.range_warning(2.0),
            "Actuator 'fast' follows within 0.125 s, and steps have up to 0.5 s: where its input "
            "jumps it does not settle but swings about it from step to step; take steps of at most "
            "0.25 s, or its input in its place");
  Response lag(std::make_unique<Lag>(0.01, Limits(), Limits(), 1.0));
  lag.step(0.1);
  EXPECT_GT(lag.output(), 1.6) << "of a command of 1";
}

// Factor of a step of the mid-point rule (1 - h / 2T) / (1 + h / 2T).
TEST(Lag, GoesToItsCommandByTheMidPointRule) {
  Response lag(std::make_unique<Lag>(0.5, Limits(), Limits(), 1.0));
  for (int step = 0; step < 20; ++step) lag.step(0.1);
  EXPECT_NEAR(lag.output(), 1.0 - std::pow(0.9 / 1.1, 20), 1e-14);
}

TEST(Lag, KeepsItsLimits) {
  Response rate(std::make_unique<Lag>(0.01, Limits::symmetric(0.2), Limits(), 1.0));
  for (int step = 0; step < 10; ++step) rate.step(0.1);
  EXPECT_NEAR(rate.output(), 0.2, 1e-14);
  Response limit(std::make_unique<Lag>(0.1, Limits(), Limits{0.0, 0.3}, 1.0));
  for (int step = 0; step < 100; ++step) {
    limit.step(0.1);
    EXPECT_LE(limit.output(), 0.3 + 1e-14);
  }
  EXPECT_NEAR(limit.output(), 0.3, 1e-14);
}

TEST(Actuator, ItsRateStaysWithinItsLimits) {
  Response actuator(std::make_unique<Actuator>(10.0, 0.7, Limits::symmetric(0.5), Limits(), 1.0));
  for (int step = 0; step < 100; ++step) {
    actuator.step(0.01);
    EXPECT_LE(actuator.value(1), 0.5 + 1e-14);
  }
  // the rate is 1 / (2 zeta omega) behind
  EXPECT_NEAR(actuator.output(), 0.5 * (1.0 - 1.0 / 14.0), 1e-3);
}

// At three times the value that halves them gains are a quarter; below zero they are whole.
TEST(PiController, GainsFollowASignal) {
  const PiController scheduled(0.7, 1.2, 0.8, 1.4, Limits(), 1.0, 0.2);
  const auto evaluate = [](const PiController& controller, const Block::Inputs& u) {
    Block::Values values;
    values.f.setZero(2);
    values.by_unknown.setZero(2, 2);
    values.by_input.setZero(2, u.size());
    controller.evaluate(Eigen::Vector2d(0.3, -0.1), u, values);
    return values;
  };
  Block::Inputs u = Eigen::Vector3d(0.4, 1.5, 0.6);
  const Block::Values found = evaluate(scheduled, u);
  const Block::Inputs fixed = u.head(2);
  const PiController quarter(0.7, 0.3, 0.2, 1.4, Limits(), 1.0);
  EXPECT_LT((found.f - evaluate(quarter, fixed).f).norm(), 1e-15);
  for (Eigen::Index k = 0; k < 3; ++k) {
    const double h = 1e-5;
    Block::Inputs ahead = u;
    Block::Inputs behind = u;
    ahead[k] += h;
    behind[k] -= h;
    const Block::Unknowns difference =
        (evaluate(scheduled, ahead).f - evaluate(scheduled, behind).f) / (2.0 * h);
    EXPECT_LT((found.by_input.col(k) - difference).norm(), 1e-8) << k;
  }
  u[2] = -0.6;
  const PiController whole(0.7, 1.2, 0.8, 1.4, Limits(), 1.0);
  EXPECT_EQ(evaluate(scheduled, u).f, evaluate(whole, fixed).f);
}

Block::Values evaluate(const Block& block, const Block::Inputs& u) {
  Block::Values values;
  values.f.setZero(1);
  values.by_unknown.setZero(1, 1);
  values.by_input.setZero(1, u.size());
  block.evaluate(Block::Unknowns::Zero(1), u, values);
  return values;
}

Block::Inputs inputs(std::initializer_list<double> values) {
  Block::Inputs u(static_cast<Eigen::Index>(values.size()));
  std::ranges::copy(values, u.begin());
  return u;
}

TEST(Table, IsLinearBetweenItsPointsAndConstantBeyond) {
  const Table table(load::PiecewiseLinear({1.0, 2.0, 4.0}, {0.0, 3.0, -1.0}), {1.0, 4.0}, 1.0);
  for (const auto& [u, value, slope] :
       {std::tuple{0.0, 0.0, 0.0}, {1.5, 1.5, 3.0}, {3.0, 1.0, -2.0}, {9.0, -1.0, 0.0}}) {
    const Block::Values found = evaluate(table, inputs({u}));
    EXPECT_EQ(found.f[0], value) << u;
    EXPECT_EQ(found.by_input(0, 0), slope) << u;
  }
}

// A power over a speed, held where the rotor stands still; a square with both signs.
TEST(Product, DividesAndKeepsItsLimits) {
  const Product torque(5.0, inputs({-1.0}), {0.0, 8.0}, 1.0);
  EXPECT_EQ(evaluate(torque, inputs({2.0})).f[0], 2.5);
  EXPECT_EQ(evaluate(torque, inputs({2.0})).by_input(0, 0), -1.25);
  const Block::Values held = evaluate(torque, inputs({0.0}));
  EXPECT_EQ(held.f[0], 8.0);
  EXPECT_EQ(held.by_input(0, 0), 0.0);
  const Product square(2.0, inputs({2.0, 1.0}), {}, 1.0);
  const Block::Values negative = evaluate(square, inputs({-3.0, 0.0}));
  EXPECT_EQ(negative.f[0], 0.0);
  EXPECT_EQ(negative.by_input(0, 0), 0.0);
  EXPECT_EQ(negative.by_input(0, 1), 18.0);
}

TEST(Product, SaysWhereItHasNoValueOrSlope) {
  const std::vector<std::pair<double, const char*>> wrong = {{-1.0, "no finite value"},
                                                             {0.5, "an infinite slope"}};
  for (const auto& [power, what] : wrong) {
    model::Model model;
    fill_with_block(
        {"", [power] { return std::make_unique<Product>(1.0, Vec<1>(power), Limits{}, 1.0); }},
        model);
    model.freeze(model::Form::null_space);
    kit::DenseAssembly dense(model);
    model::State state = kit::random_state(model, 3);
    state.own.assign(state.own.size(), 0.0);
    state.own_prev = state.own;
    try {
      dense.tangent(state, Stencil::midpoint(0.1));
      FAIL() << power;
    } catch (const NonFiniteError& error) {
      EXPECT_NE(std::string(error.what()).find(std::string("tested has ") + what),
                std::string::npos)
          << error.what();
    }
  }
}

TEST(Extreme, FollowsOneOfItsInputs) {
  const Extreme least(Extreme::Which::least, 1.0);
  const Extreme greatest(Extreme::Which::greatest, 1.0);
  const Block::Inputs u = inputs({0.5, -2.0, 3.0});
  EXPECT_EQ(evaluate(least, u).f[0], -2.0);
  EXPECT_EQ(evaluate(least, u).by_input, Eigen::RowVector3d(0.0, 1.0, 0.0));
  EXPECT_EQ(evaluate(greatest, u).f[0], 3.0);
  EXPECT_EQ(evaluate(greatest, u).by_input, Eigen::RowVector3d(0.0, 0.0, 1.0));
}

// Driven beyond, it stands T g u behind its limit, and comes back by the mid-point rule.
TEST(Integral, IsHeldByItsLimits) {
  Response integral(std::make_unique<Integral>(2.0, 1.0, Limits{-1.0, 0.4}, 0.05));
  for (int step = 0; step < 200; ++step) integral.step(0.01);
  EXPECT_NEAR(integral.output(), 0.4 + 0.05 * 2.0, 1e-12);
}

// Without the tracking the integral would be -1000 after as many seconds beyond the limit.
TEST(PiController, DoesNotWindUp) {
  Response controller(
      std::make_unique<PiController>(0.0, 2.0, 1.0, 2.0, Limits::symmetric(0.25), 1.0));
  for (int step = 0; step < 1000; ++step) controller.step(1.0);
  EXPECT_EQ(controller.output(), -0.25);
  EXPECT_GT(controller.value(1), -5.0);
}

}  // namespace
}  // namespace culm::control
