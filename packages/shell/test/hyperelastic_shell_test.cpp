#include <culm/shell/hyperelastic_shell.hpp>

#include "shell_case.hpp"
#include "shell_model.hpp"

#include <Eigen/Dense>
#include <culm_kit/finite_difference.hpp>
#include <culm_kit/no_heap.hpp>
#include <gtest/gtest.h>

#include <cmath>

namespace culm::shell {
namespace {

using Strain = ShellForms::Strain;
using Internals = HyperelasticShell::Internals;
using Answer = Response<ShellForms::num_strains>;
constexpr int M = ShellForms::num_strains;

const Stencil stencils[] = {
    Stencil::statics(), Stencil::midpoint(0.1), {0.1, 0.5, 0.75}, {0.1, 0.5, 1.0}};

std::shared_ptr<const material::Layup> rubber() {
  const material::Material soft{material::NeoHooke::from_moduli(2.0, 0.4), 1.2};
  const material::Material hard{material::NeoHooke::from_moduli(5.0, 0.2), 1.7};
  return std::make_shared<material::Layup>(material::Layup{{{soft, 0.1, 0.0}, {hard, 0.05, 0.3}}});
}

Strain strain(const ShellForms& element, const Nodes& q) {
  Strain y;
  element.strain(0, q, y);
  return y;
}

// A step from a configuration in equilibrium to another.
struct Step {
  explicit Step(const HyperelasticShell& shell, double size = 1.0)
      : element(shell),
        prev(strain(shell, random_state(1))),
        next(strain(shell, random_state(1) + size * (random_state(2) - random_state(1)))) {
    Answer ignored;
    EXPECT_EQ(element.respond(0, prev, prev, alpha_prev, Stencil::statics(), alpha_prev, ignored),
              Verdict::ok);
  }
  Answer respond(const Strain& y, const Stencil& stencil, Internals& alpha) const {
    Answer answer;
    alpha = alpha_prev;
    EXPECT_EQ(element.respond(0, prev, y, alpha_prev, stencil, alpha, answer), Verdict::ok);
    return answer;
  }

  const HyperelasticShell& element;
  Strain prev, next;
  Internals alpha_prev = Internals::Zero();
};

const HyperelasticShell& rubber_shell() {
  static const HyperelasticShell shell(warped_reference(), rubber());
  return shell;
}

TEST(HyperelasticShell, IsTheElasticShellForProportionalStress) {
  for (const Enhancement& enhancement : {Enhancement{4, 4}, Enhancement{0, 0}, Enhancement{7, 1}}) {
    const ShellOptions options{.enhancement = enhancement};
    const HyperelasticShell shell(warped_reference(), mixed_layup(), options);
    const ElasticShell elastic(warped_reference(), mixed_layup(), options);
    const Step step(shell);
    for (const Stencil& stencil : stencils) {
      Internals alpha;
      const Answer answer = step.respond(step.next, stencil, alpha);
      Answer expected;
      elastic.respond(0, step.prev, step.next, stencil, expected);
      EXPECT_LT(kit::relative_difference(answer.stress, expected.stress), 1e-12);
      EXPECT_LT(kit::relative_difference(answer.tangent, expected.tangent), 1e-12);
    }
    EXPECT_NEAR(shell.energy(0, step.prev, step.alpha_prev), elastic.energy(0, step.prev),
                1e-13 * elastic.energy(0, step.prev));
    EXPECT_LT(kit::relative_difference(shell.resultants(0, step.prev, step.alpha_prev),
                                       elastic.resultants(0, step.prev)),
              1e-11);
    EXPECT_EQ(shell.mass(), elastic.mass());
  }
}

TEST(HyperelasticShell, StressIsEnergyDerivative) {
  const Step step(rubber_shell());
  Internals alpha;
  const Answer answer = step.respond(step.next, Stencil::statics(), alpha);
  const auto difference = kit::central_difference<1, M>(
      [&](const Strain& y) {
        Internals at;
        step.respond(y, Stencil::statics(), at);
        return Vec<1>(step.element.energy(0, y, at));
      },
      step.next);
  EXPECT_LT(kit::relative_difference(difference.transpose(), answer.stress), 2e-9);
}

TEST(HyperelasticShell, TangentIsStressDerivative) {
  const Step step(rubber_shell());
  for (const Stencil& stencil : stencils) {
    Internals alpha;
    const Answer answer = step.respond(step.next, stencil, alpha);
    const auto difference = kit::central_difference<M, M>(
        [&](const Strain& y) {
          Internals at;
          return step.respond(y, stencil, at).stress;
        },
        step.next);
    EXPECT_LT(kit::relative_difference(difference, answer.tangent), 5e-9);
  }
}

TEST(HyperelasticShell, StressOfAStepDoesTheStoredWork) {
  // steps on both sides of the change of formula
  for (const double size : {1.0, 1e-1, 1e-2, 1e-3, 3e-4, 1e-4, 1e-5}) {
    const Step step(rubber_shell(), size);
    Internals alpha;
    const Answer answer = step.respond(step.next, Stencil::midpoint(0.1), alpha);
    const double stored = step.element.energy(0, step.next, alpha) -
                          step.element.energy(0, step.prev, step.alpha_prev);
    const double scale = step.element.energy(0, step.prev, step.alpha_prev);
    EXPECT_NEAR(answer.stress.dot(step.next - step.prev), stored, 1e-13 * scale) << size;
  }
}

TEST(HyperelasticShell, DissipationTakesEnergy) {
  const Step step(rubber_shell());
  for (const double weight : {0.75, 1.0}) {
    Internals alpha;
    const Answer answer = step.respond(step.next, {0.1, 0.5, weight}, alpha);
    const double stored = step.element.energy(0, step.next, alpha) -
                          step.element.energy(0, step.prev, step.alpha_prev);
    EXPECT_GT(answer.stress.dot(step.next - step.prev) - stored, 0.0);
  }
}

TEST(HyperelasticShell, StepWithoutMotionHasTheStressOfItsEnds) {
  const Step step(rubber_shell());
  Internals alpha;
  const Answer still = step.respond(step.prev, Stencil::midpoint(0.1), alpha);
  const Answer at_rest = step.respond(step.prev, Stencil::statics(), alpha);
  EXPECT_LT(kit::relative_difference(still.stress, at_rest.stress), 1e-12);
  // all but the weight of the new strain
  EXPECT_LT(kit::relative_difference(2.0 * still.tangent, at_rest.tangent), 1e-12);
}

TEST(HyperelasticShell, KernelsAllocateNothing) {
  const Step step(rubber_shell());
  Answer answer;
  Internals alpha = step.alpha_prev;
  double energy = 0.0;
  {
    const kit::NoHeap guard;
    for (const Stencil& stencil : stencils) {
      step.element.respond(0, step.prev, step.next, step.alpha_prev, stencil, alpha, answer);
    }
    energy = step.element.energy(0, step.next, alpha);
  }
  EXPECT_TRUE(std::isfinite(energy));
}

TEST(HyperelasticShell, CollapseHasAVerdict) {
  const HyperelasticShell& shell = rubber_shell();
  Nodes flat = warped_reference();
  for (int a = 0; a < 4; ++a) flat.col(2 * a + 1) *= 0.0;
  Answer answer;
  Internals alpha = Internals::Zero();
  const Strain y = strain(shell, flat);
  EXPECT_EQ(shell.respond(0, y, y, alpha, Stencil::statics(), alpha, answer),
            Verdict::law_out_of_range);
  EXPECT_TRUE(answer.stress.allFinite());
  EXPECT_TRUE(std::isnan(shell.energy(0, y, alpha)));
}

// 500 steps of four elements that spin and vibrate: energy and both momenta stay.
template <class Shell>
void expect_conservation(const std::shared_ptr<const material::Layup>& layup) {
  NodeColumns nodes(3, 18);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      nodes.col(2 * (3 * i + j)) = Vec3(i, j, 0.1 * i * j);
      nodes.col(2 * (3 * i + j) + 1) = Vec3(-0.1 * j, -0.1 * i, 1.0).normalized();
    }
  }
  ShellModel<Shell> model(nodes);
  for (int i = 0; i < 2; ++i) {
    for (int j = 0; j < 2; ++j) {
      const std::array<int, 4> quad{3 * i + j, 3 * i + j + 3, 3 * i + j + 4, 3 * i + j + 1};
      model.add({ShellModel<Shell>::gather(nodes, quad), layup, {}}, quad);
    }
  }
  const Vec3 spin(0.3, -0.5, 0.8);
  kit::Random random(1);
  model.velocity = NodeColumns(3, 18);
  for (int s = 0; s < 18; ++s) {
    model.velocity.col(s) = spin.cross(nodes.col(s)) + 0.1 * random.vector();
  }
  const auto start = model.motion();
  const double energy = start.kinetic + model.stored_energy();
  for (int step = 0; step < 500; ++step) ASSERT_TRUE(model.advance(0.05)) << step;
  const auto end = model.motion();
  EXPECT_GT(model.stored_energy(), 1e-3 * energy);
  EXPECT_NEAR(end.kinetic + model.stored_energy(), energy, 1e-10 * energy);
  EXPECT_LT((end.linear - start.linear).norm(), 1e-10 * start.linear.norm());
  EXPECT_LT((end.angular - start.angular).norm(), 1e-10 * start.angular.norm());
}

TEST(FreeFlight, ElasticShellConserves) { expect_conservation<ElasticShell>(mixed_layup()); }

TEST(FreeFlight, NeoHookeShellConserves) { expect_conservation<HyperelasticShell>(rubber()); }

}  // namespace
}  // namespace culm::shell
