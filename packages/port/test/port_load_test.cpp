#include <culm/port/port.hpp>
#include <culm/port/projection.hpp>
#include <culm/port/register_port.hpp>

#include "sample.hpp"

#include <culm_kit/batch_laws.hpp>
#include <culm_kit/load_contract.hpp>
#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <string>

namespace culm::kit {
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(LoadContract);  // its resultants are of use, ports
                                                              // have no amplitude
}

namespace culm::port {
namespace {

// Points within elements and at nodes, with offsets, of lines of all orders, of a shell and of a
// body; loads of any size on them.
std::unique_ptr<Port> fill(model::Model& model, const std::string& kind, bool with_slave = false) {
  if (kind == "shell") {
    add_roof(model);
  } else if (kind == "body") {
    add_ball(model, Vec3(0.3, 0.5, -0.2));
  } else {
    add_helix(model, 2, kind.back() - '0');
  }
  kit::Random random(7);
  std::vector<Place> places;
  for (int i = 0; i < 6; ++i) {
    const int cell = kind == "body" ? 0 : i % 2;
    const Eigen::Vector2d natural(random.number(), random.number());
    places.push_back(place_in_cell(model, 0, cell, natural, random.vector()));
  }
  if (with_slave) model.add_rigid_link("link", 0, model.nodes().add(kit::random_node(20)));
  auto port = add_port("skin", places, model);
  std::vector<double> forces, moments;
  for (int i = 0; i < 18; ++i) {
    forces.push_back(2.0 * random.number());
    moments.push_back(random.number());
  }
  port->set_loads(forces, moments);
  return port;
}

const char* const effect = "Port, skin";

class PortLoads : public testing::TestWithParam<std::string> {
 protected:
  kit::FillModel filling(bool with_slave) const {
    return [kind = GetParam(), with_slave](model::Model& model) { fill(model, kind, with_slave); };
  }
};

TEST_P(PortLoads, TangentIsDerivativeOfResidual) {
  for (const bool with_slave : {false, true}) {
    // moments are rational functions of the directors
    kit::expect_tangent_is_derivative(filling(with_slave), effect, 5e-4);
  }
}

TEST_P(PortLoads, NullSpaceResidualIsProjected) {
  for (const bool with_slave : {false, true}) {
    kit::expect_residual_is_projected(filling(with_slave), effect);
  }
}

TEST_P(PortLoads, AssembleAllocatesNothing) { kit::expect_no_allocation(filling(true), effect); }

TEST_P(PortLoads, AttemptsLeaveNoTrace) {
  kit::expect_attempts_leave_no_trace(filling(true), effect);
}

// What the partner books at its points is what the slots do, what the batch books, and what the
// certificate gets; resultants are those of the points at mid-step.
TEST_P(PortLoads, WorkIsTheSameOnBothSides) {
  for (const bool with_slave : {false, true}) {
    model::Model model;
    const auto port = fill(model, GetParam(), with_slave);
    model.freeze(model::Form::multipliers);
    kit::DenseAssembly dense(model);
    const model::Batch* batch = kit::find_batch(model, effect);
    const Stencil stencil = Stencil::midpoint(0.4);
    for (int seed = 1; seed <= 20; ++seed) {
      const model::State state = kit::random_state(model, seed);
      const Eigen::VectorXd residual =
          dense.residual(state, stencil, {kit::find_batch(model, effect)});
      const Eigen::VectorXd forces = -kit::node_rows(model, residual);
      double work = 0.0, scale = 1.0;
      for (int i = 0; i < forces.size(); ++i) {
        const double share = forces[i] * (state.next[static_cast<std::size_t>(i)] -
                                          state.prev[static_cast<std::size_t>(i)]);
        work += share;
        scale += std::abs(share);
      }
      const Exchange exchange = port->exchange(state);
      const model::StepWork booked = batch->step_work(state, stencil);
      EXPECT_GT(std::abs(exchange.work), 1e-3);
      EXPECT_NEAR(exchange.work, work, 1e-13 * scale);
      EXPECT_NEAR(booked.external, work, 1e-13 * scale);
      const kit::Resultant slots = kit::resultant_of(forces, kit::at_theta(state, 0.5));
      EXPECT_LT((slots.force - exchange.force).norm(), 1e-13 * scale);
      EXPECT_LT((slots.moment - exchange.moment).norm(), 1e-13 * scale);
      EXPECT_LT((booked.force - exchange.force).norm(), 1e-13 * scale);
      EXPECT_LT((booked.moment - exchange.moment).norm(), 1e-13 * scale);
    }
  }
}

// A rigid motion of the structure is one of the points, of their rotations and of their rates.
TEST_P(PortLoads, RigidMotionMovesThePointsRigidly) {
  model::Model model;
  const auto port = fill(model, GetParam());
  model.freeze(model::Form::multipliers);
  model::State state = model.initial_state();
  const kit::RigidMotion motion = kit::RigidMotion::random(5);
  const Vec3 v(0.3, -0.1, 0.7), omega(-0.2, 0.9, 0.4);
  state.velocity.assign(state.next.size(), 0.0);
  for (int node = 0; node < model.nodes().size(); ++node) {
    const model::NodeSlots before = model::NodeTable::slots(state.prev, node);
    model::NodeTable::slots(state.next, node) = motion(model::NodeSlots(before), NodeKind::node12);
    auto rates = model::NodeTable::slots(state.velocity, node);
    rates = skew(omega) * before;
    rates.col(0) += v;
  }
  const std::vector<double> reference = port->reference();
  const std::vector<double> position = port->read(Quantity::position, state);
  const std::vector<double> rotation = port->read(Quantity::rotation, state);
  model::State resting = state;
  resting.next = resting.prev;  // no step is open
  const std::vector<double> velocity = port->read(Quantity::velocity, resting);
  const bool is_shell = GetParam() == "shell";
  for (int p = 0; p < port->size(); ++p) {
    const Vec3 X = Eigen::Map<const Vec3>(reference.data() + 3 * p);
    EXPECT_LT(
        (Eigen::Map<const Vec3>(position.data() + 3 * p) - motion.R * X - motion.shift).norm(),
        1e-13);
    const Mat3 R = Eigen::Map<const RowMat<3, 3>>(rotation.data() + 9 * p);
    const Mat3 D =
        model::NodeTable::slots(model.nodes().reference(),
                                port->places()[static_cast<std::size_t>(p)].marker.nodes.front())
            .rightCols<3>();
    if (!is_shell) {
      EXPECT_LT((R * D - motion.R * D).norm(), 1e-13);
    }
    EXPECT_LT(triad_defect(R), 1e-13);
    const Vec3 rate = Eigen::Map<const Vec3>(velocity.data() + 6 * p);
    EXPECT_LT((rate - v - omega.cross(X)).norm(), 1e-13);
    const Vec3 spin = Eigen::Map<const Vec3>(velocity.data() + 6 * p + 3);
    if (!is_shell) {
      EXPECT_LT((spin - omega).norm(), 1e-13);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, PortLoads,
                         testing::Values("line1", "line2", "line3", "shell", "body"),
                         [](const auto& kind) { return kind.param; });

// A closed tube of points round a line bent by 69 degrees: the forces of a constant pressure
// cancel, also as moments; with one cap open they are pressure times its area.
class Tube : public testing::Test {
 protected:
  static constexpr int around = 12, along = 10;

  Tube() {
    add_straight(model_, 4, 2, "beam");
    std::vector<double> points;
    const auto add = [&](double x, double r, double angle) {
      points.insert(points.end(), {x, r * std::cos(angle), r * std::sin(angle)});
    };
    for (int i = 0; i <= along; ++i) {
      for (int k = 0; k < around; ++k) add(10.0 * i / along, 0.5, 2.0 * M_PI * k / around);
    }
    add(0.0, 0.0, 0.0);
    add(10.0, 0.0, 0.0);
    std::string issue;
    port_ = add_port("skin", attach({points, {}}, model_, issue), model_);
    EXPECT_EQ(issue, "");
    model_.freeze(model::Form::multipliers);
    state_ = model_.initial_state();
    for (std::size_t i = 0; i < model_.structures()[0].nodes.size(); ++i) {
      const double s = static_cast<double>(i) / 8.0, angle = 1.2 * s;
      auto slots = model::NodeTable::slots(state_.next, static_cast<int>(i));
      const Mat3 R = exp_rotation(Vec3(0.2 * s, 0.0, angle));
      slots.col(0) = 10.0 / 1.2 * Vec3(std::sin(angle), 1.0 - std::cos(angle), 0.1 * s);
      slots.rightCols<3>() = (R * slots.rightCols<3>()).eval();
    }
    state_.prev = state_.next;
  }

  // Pressure 1 Pa on triangles, a third to each corner.
  std::vector<double> forces(bool both_caps) const {
    const std::vector<double> x = port_->read(Quantity::position, state_);
    std::vector<double> f(x.size(), 0.0);
    const auto add = [&](int a, int b, int c) {
      const auto at = [&](int p) { return Vec3(Eigen::Map<const Vec3>(x.data() + 3 * p)); };
      const Vec3 share = (at(b) - at(a)).cross(at(c) - at(a)) / 6.0;
      for (const int p : {a, b, c}) Eigen::Map<Vec3>(f.data() + 3 * p) += share;
    };
    const int caps = around * (along + 1);
    for (int k = 0; k < around; ++k) {
      const int next = (k + 1) % around;
      for (int i = 0; i < along; ++i) {
        const int a = i * around + k, b = i * around + next;
        add(a, a + around, b);
        add(b, a + around, b + around);
      }
      add(caps, k, next);
      if (both_caps) add(caps + 1, along * around + next, along * around + k);
    }
    return f;
  }

  kit::Resultant on_slots(const std::vector<double>& f) {
    port_->set_loads(f, {});
    kit::DenseAssembly dense(model_);
    const Eigen::VectorXd r = dense.residual(state_, Stencil::midpoint(0.1));
    return kit::resultant_of(-kit::node_rows(model_, r), state_.next);
  }

  model::Model model_;
  std::unique_ptr<Port> port_;
  model::State state_;
};

TEST_F(Tube, ConstantPressureHasNoResultant) {
  const std::vector<double> f = forces(true);
  const kit::Resultant found = on_slots(f);
  double sum = 0.0;
  for (const double one : f) sum += std::abs(one);
  EXPECT_GT(sum, 10.0);
  EXPECT_LT(found.force.norm(), 1e-13 * sum);
  EXPECT_LT(found.moment.norm(), 1e-12 * sum);  // lever of 10 m
}

TEST_F(Tube, AnOpenCapLeavesPressureTimesItsArea) {
  const std::vector<double> f = forces(false);
  const kit::Resultant found = on_slots(f);
  const Exchange exchange = port_->exchange(state_);
  EXPECT_LT((found.force - exchange.force).norm(), 1e-13 * found.force.norm());
  EXPECT_LT((found.moment - exchange.moment).norm(), 1e-13 * found.moment.norm());
  // regular polygon in a cross-section of straight sections: its area is kept
  const double area = 0.5 * around * 0.25 * std::sin(2.0 * M_PI / around);
  EXPECT_NEAR(found.force.norm(), area, 1e-13);
}

TEST(Port, RefusesLoadsOfAnotherSizeAndNoNumbers) {
  model::Model model;
  const auto port = fill(model, "line2");
  const std::vector<Vec3> before = port->forces();
  std::vector<double> loads(18, 1.0);
  try {
    port->set_loads(std::vector<double>(17, 1.0), {});
    FAIL();
  } catch (const UsageError& error) {
    EXPECT_STREQ(error.what(), "port 'skin' has 6 points and takes 18 values of force, got 17");
  }
  loads[7] = std::numeric_limits<double>::quiet_NaN();
  try {
    port->set_loads(std::vector<double>(18, 1.0), loads);
    FAIL();
  } catch (const NonFiniteError& error) {
    EXPECT_STREQ(error.what(), "port 'skin' got (1, nan, 1) for the moment at point 2");
  }
  EXPECT_EQ(port->forces(), before);
}

}  // namespace
}  // namespace culm::port
