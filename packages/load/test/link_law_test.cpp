#include <culm/load/link_load.hpp>
#include <culm/math/rotation.hpp>

#include <culm_kit/batch_laws.hpp>
#include <culm_kit/load_contract.hpp>
#include <culm_kit/no_heap.hpp>
#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <numbers>
#include <ostream>
#include <string>

namespace culm::load {
namespace {

using kit::DenseAssembly;
using kit::effect;
using kit::oblique;
using model::Coordinates;
using model::NodeTable;

// long levers, so that distances are some metres and high derivatives small
const LinkPoint first{0, Vec3(1.2, -1.5, 0.7)};
const LinkPoint second{1, Vec3(-0.9, 0.8, 1.6)};

struct LinkCase {
  std::string name;
  int num_nodes;
  bool momentum;  ///< keeps linear and angular momentum
  std::function<Link(const NodeTable&)> make;
};

void PrintTo(const LinkCase& tested, std::ostream* out) { *out << tested.name; }

const LinkCase cases[] = {
    {"Distance", 2, true, [](const NodeTable& n) { return distance_link(n, first, second); }},
    {"Directed", 2, false,
     [](const NodeTable& n) { return directed_link(n, first, second, oblique, false); }},
    {"DirectedNode", 2, true,
     [](const NodeTable& n) { return directed_link(n, first, second, oblique, true); }},
    {"Ground", 1, false,
     [](const NodeTable& n) { return ground_link(n, first, Vec3(3.0, -2.0, 1.5)); }},
    {"DirectedGround", 1, false,
     [](const NodeTable& n) { return directed_ground_link(n, first, oblique, false); }},
    {"DirectedGroundNode", 1, false,
     [](const NodeTable& n) { return directed_ground_link(n, first, oblique, true); }},
    {"PlaneGround", 1, false,
     [](const NodeTable& n) { return plane_ground_link(n, first, oblique); }},
    {"Angle", 2, true, [](const NodeTable& n) {
       return angle_link(joint::MarkerPair(n, 0, 1, Vec3::Zero()), oblique);
     }}};

// F(0) = 0.4, softer beyond 5, and damping that is not odd
PiecewiseLinear spring_force() { return {{-5.0, 5.0, 6.0}, {-9.6, 10.4, 11.0}}; }
PiecewiseLinear damper_force() { return {{-20.0, 0.0, 20.0}, {-30.0, 0.0, 50.0}}; }

std::unique_ptr<LinkLaw> spring() { return std::make_unique<SpringLaw>(spring_force()); }
std::unique_ptr<LinkLaw> damper() { return std::make_unique<DamperLaw>(damper_force()); }
std::unique_ptr<LinkLaw> drive() {
  return std::make_unique<DriveLaw>(3.0, model::Amplitude::of_time([](double t) { return t * t; }));
}

class LinkLaws : public testing::TestWithParam<LinkCase> {
 protected:
  using Law = std::unique_ptr<LinkLaw> (*)();

  static void fill(model::Model& model, Law law, bool with_slave) {
    for (int node = 0; node < GetParam().num_nodes; ++node) {
      model.nodes().add(kit::random_node(10 + node));
    }
    auto load = std::make_unique<LinkLoad>(effect, model.nodes(), law());
    load->add(GetParam().make(model.nodes()));
    model.add_load(std::move(load));
    if (with_slave) model.add_rigid_link("link", 0, model.nodes().add(kit::random_node(20)));
  }

  /// A step of the conserving scheme in the coordinates of the multiplier form.
  struct Step {
    model::Model model;
    model::State state;
    Stencil stencil = Stencil::midpoint(0.4);
    Eigen::VectorXd force;  ///< on the slots
    model::Batch* batch = nullptr;

    double work() const {
      const Eigen::Map<const Eigen::VectorXd> prev(state.prev.data(), force.size());
      const Eigen::Map<const Eigen::VectorXd> next(state.next.data(), force.size());
      return force.dot(next - prev);
    }
  };
  static void make_step(Step& step, Law law, int seed, double shrink = 1.0) {
    fill(step.model, law, false);
    step.model.freeze(model::Form::multipliers);
    step.state = kit::random_state(step.model, seed);
    for (int node = 0; node < GetParam().num_nodes && shrink < 1.0; ++node) {
      const auto prev = NodeTable::slots(step.state.prev, node);
      auto next = NodeTable::slots(step.state.next, node);
      next.col(0) = prev.col(0) + shrink * (next.col(0) - prev.col(0));
      const Mat3 turn = next.rightCols<3>() * prev.rightCols<3>().transpose();
      next.rightCols<3>() = exp_rotation(shrink * log_rotation(turn)) * prev.rightCols<3>();
    }
    DenseAssembly dense(step.model);
    dense.prepare(step.state, step.stencil);
    step.batch = kit::find_batch(step.model, effect);
    step.force =
        -dense.residual(step.state, step.stencil, {step.batch}).head(12 * GetParam().num_nodes);
  }
};

TEST_P(LinkLaws, TangentIsDerivativeOfResidual) {
  for (const Law law : {&spring, &damper, &drive}) {
    for (const bool with_slave : {false, true}) {
      kit::expect_tangent_is_derivative(
          [&](model::Model& model) { this->fill(model, law, with_slave); }, effect, 3e-4);
    }
  }
}

TEST_P(LinkLaws, NullSpaceResidualIsProjected) {
  for (const bool with_slave : {false, true}) {
    kit::expect_residual_is_projected(
        [&](model::Model& model) { this->fill(model, &spring, with_slave); }, effect);
  }
}

TEST_P(LinkLaws, WorkOfASpringIsTheEnergyItStores) {
  for (const double size : {1.0, 1e-3, 1e-6, 1e-9}) {
    Step step;
    make_step(step, &spring, 3, size);
    const double stored =
        step.batch->stored_energy(step.state.next) - step.batch->stored_energy(step.state.prev);
    EXPECT_NEAR(-step.work(), stored, 2e-14);
    EXPECT_NEAR(step.batch->step_work(step.state, step.stencil).dissipation, 0.0, 1e-14);
    EXPECT_GT(std::abs(stored), 0.01 * size);
  }
}

TEST_P(LinkLaws, DampersTakeEnergyAndBookIt) {
  for (int seed = 3; seed < 20; ++seed) {
    Step step;
    make_step(step, &damper, seed);
    const model::StepWork work = step.batch->step_work(step.state, step.stencil);
    EXPECT_GT(work.damping, 0.0);
    EXPECT_NEAR(-step.work(), work.damping, 2e-14 * (1.0 + work.damping));
    EXPECT_EQ(step.batch->stored_energy(step.state.next), 0.0);
  }
}

TEST_P(LinkLaws, DrivesBookTheirWork) {
  Step step;
  make_step(step, &drive, 3);
  EXPECT_NEAR(step.work(), step.batch->step_work(step.state, step.stencil).external, 1e-14);
  EXPECT_GT(std::abs(step.work()), 1e-3);
}

TEST_P(LinkLaws, ForcesBetweenNodesKeepTheMomenta) {
  Step step;
  make_step(step, &spring, 3);
  const kit::Resultant total =
      kit::resultant_of(step.force, kit::at_theta(step.state, step.stencil.theta));
  const model::StepWork work = step.batch->step_work(step.state, step.stencil);
  EXPECT_LT((total.force - work.force).norm(), 1e-13);
  EXPECT_LT((total.moment - work.moment).norm(), 1e-13);
  EXPECT_EQ(total.force.norm() + total.moment.norm() < 1e-13, GetParam().momentum);
  EXPECT_GT(step.force.norm(), 0.01);
}

TEST_P(LinkLaws, StaticForceIsTheDerivativeOfTheEnergy) {
  model::Model model;
  fill(model, &spring, false);
  model.freeze(model::Form::multipliers);
  DenseAssembly dense(model);
  model::Batch* batch = kit::find_batch(model, effect);
  model::State state = kit::random_state(model, 3);
  dense.prepare(state, Stencil::statics());
  const Eigen::VectorXd force = dense.residual(state, Stencil::statics(), {batch});
  const double h = 1e-5;
  for (int i = 0; i < 12 * GetParam().num_nodes; ++i) {
    const auto energy = [&](double change) {
      Coordinates q = state.next;
      q[static_cast<std::size_t>(i)] += change;
      return batch->stored_energy(q);
    };
    EXPECT_NEAR(force[i], (energy(h) - energy(-h)) / (2.0 * h), 1e-8);
  }
}

TEST_P(LinkLaws, RigidMotionOfBothNodesStoresNothing) {
  if (!GetParam().momentum) return;
  Step step;
  make_step(step, &spring, 3);
  const kit::RigidMotion motion = kit::RigidMotion::random(4);
  Coordinates q = step.state.next;
  for (int node = 0; node < 2; ++node) {
    auto slots = NodeTable::slots(q, node);
    slots = motion(Slots<4>(slots), NodeKind::node12);
  }
  EXPECT_NEAR(step.batch->stored_energy(q), step.batch->stored_energy(step.state.next), 1e-13);
}

TEST_P(LinkLaws, AttemptsLeaveNoTrace) {
  kit::expect_attempts_leave_no_trace([&](model::Model& model) { fill(model, &spring, true); },
                                      effect);
}

TEST_P(LinkLaws, AssembleAllocatesNothing) {
  for (const model::Form form : {model::Form::null_space, model::Form::multipliers}) {
    model::Model model;
    fill(model, &spring, true);
    model.freeze(form);
    DenseAssembly dense(model);
    const model::State state = kit::random_state(model, 3);
    const Stencil stencil = Stencil::midpoint(0.4);
    const DenseAssembly::Batches tested = {kit::find_batch(model, effect)};
    kit::NoHeap guard;
    tested.front()->prepare(state, stencil);
    tested.front()->extrapolate(state, stencil, state.velocity);
    EXPECT_EQ(dense.assemble(state, stencil, Want::residual_and_tangent, tested), Verdict::ok);
  }
}

INSTANTIATE_TEST_SUITE_P(Links, LinkLaws, testing::ValuesIn(cases),
                         [](const auto& tested) { return tested.param.name; });

/// One link with a spring or damper on the given nodes, in statics or a step.
struct OneLink {
  model::Model model;
  LinkLoad* load = nullptr;
  std::unique_ptr<DenseAssembly> dense;
  model::State state;

  void add(std::unique_ptr<LinkLaw> law, const std::function<Link(const NodeTable&)>& make) {
    auto owned = std::make_unique<LinkLoad>("one", model.nodes(), std::move(law));
    load = owned.get();
    load->add(make(model.nodes()));
    model.add_load(std::move(owned));
    model.freeze(model::Form::null_space);
    dense = std::make_unique<DenseAssembly>(model);
    state = model.initial_state();
    state.velocity.assign(state.prev.size(), 0.0);
  }
};

model::NodeSlots node_at(const Vec3& x) {
  model::NodeSlots slots;
  slots << x, Mat3::Identity();
  return slots;
}

// It counts full turns: spring and energy know of three turns and a half.
TEST(AngleLink, CountsFullTurns) {
  OneLink one;
  one.model.nodes().add(node_at(Vec3::Zero()));
  one.model.nodes().add(node_at(Vec3::UnitX()));
  one.add(std::make_unique<SpringLaw>(PiecewiseLinear::proportional(2.0)), [](const NodeTable& n) {
    return angle_link(joint::MarkerPair(n, 0, 1, Vec3::Zero()), oblique);
  });
  double angle = 0.0;
  for (int step = 0; step < 11; ++step) {
    one.dense->accept(one.state);
    one.state.prev = one.state.next;
    angle += 2.0;
    NodeTable::slots(one.state.next, 1).rightCols<3>() = exp_rotation(angle * oblique);
    one.dense->prepare(one.state, Stencil::statics());
    const Eigen::VectorXd r = one.dense->residual(one.state, Stencil::statics());
    EXPECT_NEAR(r.segment<3>(9).dot(oblique), 2.0 * angle, 1e-12);
    EXPECT_LT((r.segment<3>(3) + r.segment<3>(9)).norm(), 1e-12);
    EXPECT_NEAR(one.load->stored_energy(one.state.next), angle * angle, 1e-11);
  }
  // a load made anew, as by a run that goes on, does not know them unless it is told
  std::vector<double> memory(one.load->memory_size());
  one.load->save(model::Items::owned, memory);
  EXPECT_EQ(memory.size(), 3U);
  const double energy = one.load->stored_energy(one.state.next);
  std::vector<double> fresh(3, 0.0);
  fresh[0] = 1.0;
  one.load->restore(fresh);
  EXPECT_LT(one.load->stored_energy(one.state.next), std::numbers::pi * std::numbers::pi);
  one.load->restore(memory);
  EXPECT_EQ(one.load->stored_energy(one.state.next), energy);
}

// At no length the force has no direction but its stiffness does, k 1, and so has a damper: c /
// h 1. Rounding of the places, and whether a table has a point there, change nothing.
TEST(GroundLink, HasStiffnessAndDampingAtNoLength) {
  const Vec3 offset(0.07, 0.03, 0.01);
  const Vec3 place(0.1, 0.2, 0.3);
  const auto spring = [](std::vector<double> x, std::vector<double> F) {
    return [=]() -> std::unique_ptr<LinkLaw> {
      return std::make_unique<SpringLaw>(PiecewiseLinear(x, F));
    };
  };
  const auto damper = []() -> std::unique_ptr<LinkLaw> {
    return std::make_unique<DamperLaw>(PiecewiseLinear({-1.0, 1.0}, {-7.0, 7.0}));
  };
  const std::vector<std::function<std::unique_ptr<LinkLaw>()>> laws = {
      spring({0.0, 1.0, 2.0}, {0.0, 7.0, 9.0}), spring({-1.0, 1.0}, {-7.0, 7.0}), damper};
  for (std::size_t law = 0; law < laws.size(); ++law) {
    for (const bool plane : {false, true}) {
      OneLink one;
      one.model.nodes().add(node_at(place));
      one.add(laws[law](), [&](const NodeTable& n) {
        return plane ? plane_ground_link(n, {0, offset}, Vec3::UnitZ())
                     : ground_link(n, {0, offset}, place + offset);
      });
      for (const Stencil& stencil : {Stencil::statics(), Stencil::midpoint(0.1)}) {
        one.dense->prepare(one.state, stencil);
        EXPECT_LT(kit::largest(one.dense->residual(one.state, stencil)), 1e-14);
        const double h = stencil.step;
        const double slope = law < 2 ? 7.0 * stencil.theta : h > 0.0 ? 7.0 / h : 0.0;
        Mat3 expected = slope * Mat3::Identity();
        if (plane) expected(2, 2) = 0.0;
        EXPECT_LT(
            kit::largest(one.dense->tangent(one.state, stencil).topLeftCorner<3, 3>() - expected),
            1e-13)
            << law << plane << h;
        EXPECT_EQ(one.load->sample(0, one.state).force, 0.0);
      }
    }
  }
}

}  // namespace
}  // namespace culm::load
