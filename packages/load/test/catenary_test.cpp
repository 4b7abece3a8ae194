#include <culm/load/catenary.hpp>
#include <culm/load/catenary_load.hpp>

#include <culm_kit/batch_laws.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

namespace culm::load {
namespace {

constexpr double inextensible = 1e15;

// Digits of the equations of the inextensible line.
TEST(Catenary, HangsFreely) {
  const CatenaryEnds ends = hang({130.0, inextensible, 1000.0, false}, 100.0, 20.0);
  ASSERT_TRUE(ends.found);
  EXPECT_NEAR(ends.horizontal, 39804.646976, 2e-5);
  EXPECT_NEAR(ends.vertical, 76764.775284, 2e-5);
}

// The elastic line by a solution of the equations with 40 digits.
TEST(Catenary, RestsOnTheSeabed) {
  const CatenaryEnds ends = hang({500.0, 1e18, 800.0, true}, 400.0, 200.0);
  ASSERT_TRUE(ends.found);
  EXPECT_NEAR(ends.horizontal, 96643.4804, 1e-4);
  EXPECT_NEAR(ends.vertical, 237751.7901, 1e-4);
  EXPECT_NEAR(ends.grounded, 202.81026, 1e-5);
  const CatenaryEnds elastic = hang({500.0, 7.51e12, 800.0, true}, 400.0, 200.0);
  EXPECT_NEAR(elastic.horizontal, 96643.45354712, 1e-6);
  EXPECT_NEAR(elastic.vertical, 237751.76803420, 1e-6);
  EXPECT_NEAR(elastic.grounded, 202.810289957, 1e-8);
}

// A taut line is a spring along its chord, with half of its weight at each end, up to terms in
// (w L / T)^2: of its length, that is L (1 + T / EA) less (w L cos / T)^2 / 24.
TEST(Catenary, TautLinesAreSprings) {
  for (const double stiffness : {1e6, 1e8, 1e10, 1e12}) {
    for (const double weight : {1e-6, 1e-3, 1.0}) {
      for (const double stretch : {1e-6, 1e-4, 1e-2}) {
        const double length = 100.0, T = stiffness * stretch;
        if (T < 1e3 * weight * length) continue;
        for (const bool flat : {true, false}) {
          const Vec<2> along = flat ? Vec<2>(1.0, 0.0) : Vec<2>(0.6, 0.8);
          const Vec<2> place = (1.0 + stretch) * length * along;
          const CatenaryEnds ends = hang({length, stiffness, weight, false}, place[0], place[1]);
          ASSERT_TRUE(ends.found) << stiffness << ' ' << weight << ' ' << stretch;
          const double ratio = weight * length * along[0] / T;
          const double sag = ratio * ratio / 24.0 * stiffness;  // what it adds to the tension
          EXPECT_NEAR(ends.horizontal, T * along[0], 2.0 * sag + 1e-9 * T);
          EXPECT_NEAR(ends.vertical, T * along[1] + 0.5 * weight * length,
                      2.0 * sag + 1e-9 * T + 2.0 * weight * length * stretch);
        }
      }
    }
  }
}

// h and z of a line with the forces H and V at its fairlead, by sums over pieces of the line.
Vec<2> by_pieces(const CatenaryLine& line, double H, double V) {
  constexpr int pieces = 200000;
  const double ds = line.length / pieces;
  const double grounded = std::max(0.0, line.length - V / line.weight);
  Vec<2> place = Vec<2>::Zero();
  for (int i = 0; i < pieces; ++i) {
    const double s = (i + 0.5) * ds;  // from the anchor
    const double low = line.weight * (s - grounded);
    const double T = low > 0.0 ? std::hypot(H, low)
                               : std::max(H - line.friction * line.weight * (grounded - s), 0.0);
    const double stretched = (1.0 + T / line.stiffness) * ds;
    place += low > 0.0 ? Vec<2>(stretched * Vec<2>(H, low) / T) : Vec<2>(stretched, 0.0);
  }
  return place;
}

// As MoorPy, and as the sum over pieces of a soft line, of which friction holds all or a part.
TEST(Catenary, FrictionTakesFromTheTensionTowardsTheAnchor) {
  const CatenaryLine stiff{500.0, 7.51e12, 800.0, true, 0.1};
  EXPECT_NEAR(hang(stiff, 400.0, 200.0).anchor_tension(stiff), 80418.604, 5e-2);
  for (const double friction : {0.1, 1.0}) {
    const CatenaryLine line{500.0, 2e6, 800.0, true, friction};
    const CatenaryEnds ends = hang(line, 420.0, 200.0);
    ASSERT_TRUE(ends.found);
    ASSERT_GT(ends.grounded, 50.0);
    EXPECT_EQ(ends.anchor_tension(line) == 0.0, friction == 1.0);
    EXPECT_LT((by_pieces(line, ends.horizontal, ends.vertical) - Vec<2>(420.0, 200.0)).norm(),
              1e-5);
    EXPECT_GT(std::abs(ends.horizontal - hang(line.without_friction(), 420.0, 200.0).horizontal),
              1e-3 * ends.horizontal);
  }
}

// All of the line on the ground, of which a part moves or all.
TEST(Catenary, FrictionHoldsALineThatLies) {
  const CatenaryLine line{100.0, 1e6, 50.0, true, 0.5};
  for (const double h : {100.02, 100.2}) {
    const CatenaryEnds ends = hang(line, h, 0.0);
    EXPECT_NEAR(by_pieces(line, ends.horizontal, 0.0)[0], h, 1e-6);
    EXPECT_EQ(ends.anchor_tension(line) > 0.0, h == 100.2);
  }
}

struct Hung {
  double h, z;
  bool on_seabed;
};

// Slack, touching, just lifted, hanging, taut, vertical, level and below the anchor.
const Hung hung[] = {{20.0, 60.0, true},  {45.0, 60.0, true},   {80.0, 30.0, true},
                     {80.0, 1.0, true},   {100.5, 10.0, true},  {80.0, 59.0, true},
                     {80.0, 30.0, false}, {80.0, -30.0, false}, {99.0, 30.0, false},
                     {110.0, 0.0, false}, {1e-6, 50.0, false},  {1e-6, 101.0, false},
                     {50.0, 0.0, false},  {102.0, -1.0, true},  {1e-6, 101.0, true}};

TEST(Catenary, ForcesAreDerivativesOfTheEnergyAndStiffnessOfForces) {
  for (const double EA : {1e5, 1e8}) {
    for (const Hung& at : hung) {
      const CatenaryLine line{100.0, EA, 50.0, at.on_seabed};
      const CatenaryEnds ends = hang(line, at.h, at.z);
      ASSERT_TRUE(ends.found) << at.h << " " << at.z;
      const double step = at.h < 1e-3 ? 1e-9 : 1e-4;
      const double size = std::hypot(ends.horizontal, ends.vertical) + line.weight;
      const auto difference = [&](double h, double z, auto read) {
        return (read(hang(line, at.h + h, at.z + z)) - read(hang(line, at.h - h, at.z - z))) /
               (2.0 * std::hypot(h, z));
      };
      const auto energy = [](const CatenaryEnds& e) { return e.energy; };
      const auto H = [](const CatenaryEnds& e) { return e.horizontal; };
      const auto V = [](const CatenaryEnds& e) { return e.vertical; };
      if (at.h > 1e-3) {
        EXPECT_NEAR(difference(step, 0.0, energy), ends.horizontal, 1e-5 * size) << at.h;
        EXPECT_NEAR(difference(0.0, step, energy), ends.vertical, 1e-5 * size) << at.h;
      }
      const double K = ends.K.norm() + 1.0;
      EXPECT_NEAR(difference(step, 0.0, H), ends.K(0, 0), 1e-4 * K) << at.h << " " << at.z;
      EXPECT_NEAR(difference(step, 0.0, V), ends.K(1, 0), 1e-4 * K) << at.h << " " << at.z;
      if (at.h > 1e-3) {
        EXPECT_NEAR(difference(0.0, step, V), ends.K(1, 1), 1e-4 * K) << at.h << " " << at.z;
      }
    }
  }
}

TEST(Catenary, StiffnessWithFrictionIsDerivativeOfForces) {
  for (const double friction : {0.2, 3.0}) {
    for (const Hung& at : hung) {
      if (!at.on_seabed || at.h < 1e-3) continue;
      const CatenaryLine line{100.0, 1e5, 50.0, true, friction};
      const CatenaryEnds ends = hang(line, at.h, at.z);
      ASSERT_TRUE(ends.found) << at.h << " " << at.z;
      const auto forces = [&](double h, double z) {
        const CatenaryEnds e = hang(line, at.h + h, at.z + z);
        return Vec<2>(e.horizontal, e.vertical);
      };
      constexpr double step = 1e-4;
      const double K = ends.K.norm() + 1.0;
      EXPECT_LT(((forces(step, 0.0) - forces(-step, 0.0)) / (2.0 * step) - ends.K.col(0)).norm(),
                1e-4 * K)
          << at.h << " " << at.z;
      EXPECT_LT(((forces(0.0, step) - forces(0.0, -step)) / (2.0 * step) - ends.K.col(1)).norm(),
                1e-4 * K)
          << at.h << " " << at.z;
    }
  }
}

// What hangs down without reaching the anchor weighs w z, and nothing pulls sideways.
TEST(Catenary, SlackLineHangsStraight) {
  const CatenaryEnds ends = hang({100.0, inextensible, 50.0, true}, 20.0, 60.0);
  EXPECT_EQ(ends.horizontal, 0.0);
  EXPECT_NEAR(ends.vertical, 3000.0, 1e-8);
  EXPECT_NEAR(ends.grounded, 40.0, 1e-9);
  EXPECT_NEAR(ends.energy, 90000.0, 1e-6);
}

using kit::effect;

/// A fairlead off its node, and a line long enough to move slowly, or taut.
void fill(model::Model& model, const CatenaryLine& line, bool with_slave) {
  model.nodes().add(kit::random_node(10));
  auto load = std::make_unique<CatenaryLoad>(effect, model.nodes());
  load->add({0, Vec3(1.2, -1.5, 0.7)}, Vec3(9.0, -7.0, -8.0), Vec3::UnitZ(), line);
  model.add_load(std::move(load));
  if (with_slave) model.add_rigid_link("link", 0, model.nodes().add(kit::random_node(20)));
}

// Slack on the seabed, resting on it, lifted, hanging free, taut.
const CatenaryLine lines[] = {{24.0, 500.0, 0.3, true},      {17.0, 500.0, 0.3, true},
                              {15.5, 500.0, 0.3, true, 0.5}, {15.5, 20.0, 0.3, true, 2.0},
                              {14.6, 500.0, 0.3, true},      {24.0, 500.0, 0.3, false},
                              {12.0, 20.0, 0.3, false}};

TEST(CatenaryLoad, TangentIsDerivativeOfResidual) {
  for (const CatenaryLine& line : lines) {
    for (const bool slave : {false, true}) {
      kit::expect_tangent_is_derivative([&](model::Model& m) { fill(m, line, slave); }, effect,
                                        3e-4);
    }
  }
}

TEST(CatenaryLoad, NullSpaceResidualIsProjected) {
  kit::expect_residual_is_projected([](model::Model& m) { fill(m, lines[0], true); }, effect);
}

TEST(CatenaryLoad, AllocatesNothingAndLeavesNoTrace) {
  kit::expect_no_allocation([](model::Model& m) { fill(m, lines[0], true); }, effect);
  kit::expect_attempts_leave_no_trace([](model::Model& m) { fill(m, lines[0], true); }, effect);
}

TEST(CatenaryLoad, WorkOfAStepIsTheEnergyItStores) {
  for (const CatenaryLine& line : lines) {
    model::Model model;
    fill(model, line, false);
    model.freeze(model::Form::multipliers);
    const model::State state = kit::random_state(model, 3);
    kit::DenseAssembly dense(model);
    model::Batch* batch = kit::find_batch(model, effect);
    const Stencil stencil = Stencil::midpoint(0.4);
    const Eigen::VectorXd r = dense.residual(state, stencil, {batch}).head(12);
    const Eigen::Map<const Eigen::VectorXd> prev(state.prev.data(), 12);
    const Eigen::Map<const Eigen::VectorXd> next(state.next.data(), 12);
    const double stored = batch->stored_energy(state.next) - batch->stored_energy(state.prev);
    EXPECT_GT(std::abs(stored), 1e-3);
    const model::StepWork work = batch->step_work(state, stencil);
    EXPECT_NEAR(r.dot(next - prev), stored - work.external, 1e-11 * (1.0 + std::abs(stored)));
    EXPECT_EQ(work.external == 0.0, line.friction == 0.0);

    EXPECT_NEAR(work.dissipation, 0.0, 1e-11);
  }
}

// The mean force of a step makes up for what rounding leaves of DW over a short one.
TEST(CatenaryLoad, SmallStepsKeepTheEnergyToRounding) {
  for (const CatenaryLine& line : lines) {
    if (line.friction > 0.0) continue;
    model::Model model;
    fill(model, line, false);
    model.freeze(model::Form::multipliers);
    model::State state = kit::random_state(model, 3);
    kit::DenseAssembly dense(model);
    model::Batch* batch = kit::find_batch(model, effect);
    const model::Coordinates end = state.next;
    const double size = std::abs(batch->stored_energy(state.prev)) + line.weight * line.length;
    for (double share = 1.0; share > 1e-12; share *= 0.1) {
      for (std::size_t i = 0; i < end.size(); ++i) {
        state.next[i] = state.prev[i] + share * (end[i] - state.prev[i]);
      }
      const Eigen::VectorXd r = dense.residual(state, Stencil::midpoint(0.4), {batch}).head(12);
      const Eigen::Map<const Eigen::VectorXd> prev(state.prev.data(), 12),
          next(state.next.data(), 12);
      const double stored = batch->stored_energy(state.next) - batch->stored_energy(state.prev);
      EXPECT_NEAR(r.dot(next - prev), stored, 1e-12 * size) << share;
    }
  }
}

}  // namespace
}  // namespace culm::load
