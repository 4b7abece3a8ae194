#include <culm/joint/angular_velocity.hpp>
#include <culm/joint/axis_turn.hpp>
#include <culm/joint/joint_angle.hpp>
#include <culm/joint/revolute_joint.hpp>
#include <culm/math/rotation.hpp>

#include <culm_kit/batch_laws.hpp>
#include <culm_kit/no_heap.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

namespace culm::joint {
namespace {

using kit::oblique;
using model::NodeTable;

constexpr double round_off = 1e-14;

class AxisTurns : public testing::TestWithParam<bool> {
 protected:
  static constexpr const char* effect = "tested";
  static TurnAxis turn_axis() { return {oblique, GetParam()}; }

  static void fill(model::Model& model, bool with_slave) {
    model.nodes().add(kit::random_node(10));
    model.add_constraint(AngularVelocity::constraint(effect, "drive", model.nodes(), 0, oblique));
    auto batch = std::make_unique<AngularVelocity>(effect, model);
    const Prescribed velocity{1.5, model::Amplitude::of_time([](double t) { return t * t; })};
    batch->add(0, turn_axis(), velocity, effect);
    model.add_load(std::move(batch));
    if (with_slave) model.add_rigid_link("link", 0, model.nodes().add(kit::random_node(20)));
  }
  static Mat3 triad(const model::Coordinates& q) { return NodeTable::slots(q, 0).rightCols<3>(); }
};

TEST_P(AxisTurns, BothFormsSeeTheSameTurnAndMoment) {
  model::Model model;
  fill(model, false);
  model.freeze(model::Form::null_space);
  const model::State state = kit::random_state(model, 3);
  for (const double theta : {0.5, 0.75, 1.0}) {
    const auto at = [&](const model::Coordinates& q) {
      return kit::null_space_matrix(model.nodes(), q);
    };
    const AxisTurn<model::NullSpace> reduced(turn_axis(), triad(state.prev), triad(state.next),
                                             theta);
    const AxisTurn<model::FullSpace> full(turn_axis(), triad(state.prev), triad(state.next), theta);
    EXPECT_LT((at(kit::at_theta(state, theta)).transpose() * full.moment - reduced.moment).norm(),
              round_off);
    EXPECT_LT((at(state.next).transpose() * full.gradient - reduced.gradient).norm(), round_off);
    EXPECT_EQ(full.turn, reduced.turn);
  }
}

TEST_P(AxisTurns, AUnitMomentDoesTheWorkOfTheTurn) {
  model::Model model;
  fill(model, false);
  model.freeze(model::Form::multipliers);
  const model::State state = kit::random_state(model, 3);
  const AxisTurn<model::FullSpace> turn(turn_axis(), triad(state.prev), triad(state.next), 0.5);
  const Eigen::Map<const Vec<12>> prev(state.prev.data());
  const Eigen::Map<const Vec<12>> next(state.next.data());
  EXPECT_NEAR(turn.moment.dot(next - prev), turn.turn, round_off);
  EXPECT_GT(std::abs(turn.turn), 0.1);
  // and the drive books it: the first and only multiplier of its own
  kit::DenseAssembly dense(model);
  const Stencil stencil = Stencil::midpoint(0.4);
  model::Batch* batch = kit::find_batch(model, effect);
  const Eigen::VectorXd r = dense.residual(state, stencil, {batch});
  EXPECT_NEAR(-r.head<12>().dot(next - prev), batch->step_work(state, stencil).drives, round_off);
}

TEST_P(AxisTurns, TurnIsTwiceTheTangentOfHalfTheAngle) {
  const Mat3 prev = kit::random_node(1).rightCols<3>();
  const Vec3 n = GetParam() ? Vec3(prev * oblique) : oblique;
  const Mat3 next = exp_rotation(1.2 * n) * prev;
  const AxisTurn<model::NullSpace> turn(turn_axis(), prev, next, 0.5);
  EXPECT_NEAR(turn.turn, 2.0 * std::tan(0.6), round_off);
  EXPECT_LT((turn.axis - n).norm(), round_off);
}

TEST_P(AxisTurns, RowAsksForTheAngleOfTheStep) {
  model::Model model;
  fill(model, false);
  model.freeze(model::Form::null_space);
  kit::DenseAssembly dense(model);
  model::State state = model.initial_state();
  state.time_prev = 0.3;
  state.time = 0.7;
  const double angle = 1.5 * (std::pow(0.7, 3) - std::pow(0.3, 3)) / 3.0;
  const Mat3 D = triad(state.prev);
  const Vec3 n = GetParam() ? Vec3(D * oblique) : oblique;
  NodeTable::slots(state.next, 0).rightCols<3>() = exp_rotation(angle * n) * D;
  model::Batch* batch = kit::find_batch(model, effect);
  const Eigen::VectorXd r = dense.residual(state, Stencil::midpoint(0.4), {batch});
  EXPECT_LT(kit::largest(r), round_off);
}

TEST_P(AxisTurns, TangentIsDerivativeOfResidual) {
  for (const bool with_slave : {false, true}) {
    kit::expect_tangent_is_derivative([&](model::Model& model) { this->fill(model, with_slave); },
                                      effect, 1e-3);
  }
}

TEST_P(AxisTurns, StaticsKnowsNoVelocity) {
  model::Model model;
  fill(model, false);
  model.freeze(model::Form::null_space);
  kit::DenseAssembly dense(model);
  const model::State state = kit::random_state(model, 3);
  model::Batch* batch = kit::find_batch(model, effect);
  const Eigen::VectorXd r = dense.residual(state, Stencil::statics(), {batch});
  EXPECT_EQ(kit::largest(r.head<6>()), 0.0);
  EXPECT_EQ(r[6], state.own[0]);
  EXPECT_EQ(batch->step_work(state, Stencil::statics()).drives, 0.0);
}

TEST_P(AxisTurns, AssembleAllocatesNothing) {
  for (const model::Form form : {model::Form::null_space, model::Form::multipliers}) {
    model::Model model;
    fill(model, true);
    model.freeze(form);
    kit::DenseAssembly dense(model);
    const model::State state = kit::random_state(model, 3);
    const kit::DenseAssembly::Batches tested = {kit::find_batch(model, effect)};
    kit::NoHeap guard;
    EXPECT_EQ(dense.assemble(state, Stencil::midpoint(0.4), Want::residual_and_tangent, tested),
              Verdict::ok);
  }
}

INSTANTIATE_TEST_SUITE_P(Axis, AxisTurns, testing::Bool(),
                         [](const auto& tested) { return tested.param ? "Local" : "Space"; });

// A drive that follows a signal with a rate.
model::Amplitude follow_signal(model::Model& model) {
  const int block =
      model.add_own_block({"signal", {{"output", model::UnknownKind::first_order, 0.8}, {"rate"}}});
  return model::Amplitude::of_signal(model.signal(block, 0));
}

TEST(AngularVelocity, FollowsASignalWithItsTangent) {
  kit::expect_tangent_is_derivative(
      [](model::Model& model) {
        model.nodes().add(kit::random_node(10));
        auto batch = std::make_unique<AngularVelocity>("tested", model);
        batch->add(0, {oblique, true}, {1.5, follow_signal(model)}, "tested");
        model.add_load(std::move(batch));
      },
      "tested", 1e-3);
}

TEST(JointAngle, FollowsASignalWithItsTangent) {
  kit::expect_tangent_is_derivative(
      [](model::Model& model) {
        for (const int seed : {10, 11}) model.nodes().add(kit::random_node(seed));
        const MarkerPair pair(model.nodes(), 0, 1, Vec3(0.1, 0.2, 0.3));
        model::Constraint joint = joint_angle(pair, oblique, {1.3, follow_signal(model)});
        joint.name = joint.type = "tested";
        model.add_constraint(std::move(joint));
      },
      "tested", 1e-3);
}

TEST(Prescribed, HasTheIntegralOfARate) {
  const auto integral = [](const model::Amplitude& function, double start, double end,
                           double theta = 1.0) {
    model::State state;
    state.time_prev = start;
    state.time = end;
    return Prescribed{2.0, function}.integral(state, theta);
  };
  const auto wave =
      model::Amplitude::of_time([](double t) { return std::exp(-t) * std::sin(7.0 * t); });
  const auto primitive = [](double t) {
    return -std::exp(-t) * (std::sin(7.0 * t) + 7.0 * std::cos(7.0 * t)) / 50.0;
  };
  for (const double end : {0.01, 0.7, 5.0}) {
    EXPECT_NEAR(integral(wave, 0.0, end), 2.0 * (primitive(end) - primitive(0.0)), round_off);
  }
  EXPECT_EQ(integral(wave, 1.0, 3.0, 0.0), 0.0);
  EXPECT_EQ(integral(model::Amplitude::constant(3.0), 1.0, 3.0, 0.5), 6.0);
  const auto square = [](double t) { return t <= 0.15 ? 1.0 : 0.0; };
  const auto pulse = model::Amplitude::of_time(square).with_corners({0.0, 0.15});
  EXPECT_NEAR(integral(pulse, 0.1, 0.2), 0.1, round_off);
  // a jump and a corner that nobody knows
  const auto jump = model::Amplitude::of_time([](double t) { return t < 1.0 / 3.0 ? 0.0 : 1.0; });
  EXPECT_NEAR(integral(jump, 0.0, 1.0), 4.0 / 3.0, 2e-4);
  const auto bend = model::Amplitude::of_time([](double t) { return std::abs(t - 1.0 / 3.0); });
  EXPECT_NEAR(integral(bend, 0.0, 1.0), 5.0 / 9.0, 1e-8);
}

// A turn of both nodes, and of the second one further by the angle.
TEST(JointAngle, HoldsAfterTheExactRotation) {
  NodeTable nodes;
  nodes.add(kit::random_node(1));
  nodes.add(kit::random_node(2));
  const Prescribed motion{2.0, model::Amplitude::of_time([](double t) { return t; })};
  model::Constraint joint = joint_angle(MarkerPair(nodes, 0, 1, Vec3::Zero()), oblique, motion);
  for (const double time : {0.0, 0.4, 1.3, -2.0}) {
    joint.drive(time, joint.rows);
    const Mat3 R = exp_rotation(Vec3(0.3, 0.9, -0.4));
    Eigen::Matrix<double, 3, 8> q;
    q << NodeTable::slots(nodes.reference(), 0), NodeTable::slots(nodes.reference(), 1);
    q = R * q.eval();
    q.rightCols<3>() = exp_rotation(2.0 * time * R * oblique) * q.rightCols<3>().eval();
    const model::ConstraintRow& row = joint.rows.front();
    const Vec3 P = q * Eigen::Map<const Vec<8>>(row.alpha.data());
    const Vec3 Q = row.direction + q * Eigen::Map<const Vec<8>>(row.beta.data());
    EXPECT_NEAR(P.dot(Q) - row.constant, 0.0, round_off);
  }
}

}  // namespace
}  // namespace culm::joint
