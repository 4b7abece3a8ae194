#include <culm/shell/element_batches.hpp>

#include "shell_case.hpp"

#include <Eigen/Eigenvalues>
#include <culm_kit/batch_laws.hpp>
#include <gtest/gtest.h>

#include <cmath>

namespace culm::shell {
namespace {

using kit::effect;

// Faces that relax on a core that does not, all with one Poisson ratio.
material::Layup sandwich(double ratio) {
  const material::Material::Law law = material::IsotropicMaterial::law(3.0, 0.3);
  const material::Material face{law, 1.5, 0.0, 0.0, {{0.2, {ratio}}}};
  const material::Material core{law, 1.0};
  return {{{face, 0.02, 0.0}, {core, 0.06, 0.0}, {face, 0.02, 0.0}}};
}

// Plies with times of their own and one that they share.
std::shared_ptr<const material::Layup> relaxing_layup() {
  material::Layup layup = *mixed_layup();
  layup.layers[0].material.relaxation = {{0.3, {0.5}}, {2.0, {0.4}}};
  layup.layers[1].material.relaxation = {{0.3, {1.5}}};
  layup.layers[2].material.relaxation = {{0.05, {0.2}}};
  return std::make_shared<material::Layup>(std::move(layup));
}

Nodes centred_reference() {
  Nodes q = Nodes::Zero();
  q.col(0) = Vec3(-0.5, -0.4, 0);
  q.col(2) = Vec3(0.5, -0.4, 0);
  q.col(4) = Vec3(0.5, 0.4, 0);
  q.col(6) = Vec3(-0.5, 0.4, 0);
  for (int a = 0; a < 4; ++a) q.col(2 * a + 1) = Vec3::UnitZ();
  return q;
}

double energy(const ShellForms::Stiffness& C, const ElasticShell& shell, const Nodes& q) {
  ShellForms::Strain y;
  shell.strain(0, q, y);
  return 0.5 * y.dot(C * y);
}

TEST(BranchStiffness, OfLayersThatRelaxAlikeIsTheirRatio) {
  material::Layup layup = *mixed_layup();
  for (material::Layer& layer : layup.layers) layer.material.relaxation = {{0.3, {0.7}}};
  const ElasticShell shell(warped_reference(), std::make_shared<material::Layup>(layup),
                           {.enhancement = {7, 4}});
  const ShellForms::Stiffness expected = 0.7 * shell.stiffness(0);
  EXPECT_LT((shell.branch_stiffness(0, 0) - expected).norm(), 1e-13 * expected.norm());
}

// Shares of layers: of the membrane 2 t_f / t, of bending 1 - (t_c / t)^3.
TEST(BranchStiffness, CountsLayersByTheirPlace) {
  const double g = 0.8;
  const ElasticShell shell(centred_reference(), std::make_shared<material::Layup>(sandwich(g)));
  Nodes stretched = centred_reference();
  Nodes bent = centred_reference();
  for (int a = 0; a < 4; ++a) {
    stretched(0, 2 * a) *= 1.0 + 1e-6;
    bent(0, 2 * a + 1) = 1e-6 * bent(0, 2 * a);
  }
  const auto share = [&](const Nodes& q) {
    return energy(shell.branch_stiffness(0, 0), shell, q) / energy(shell.stiffness(0), shell, q);
  };
  EXPECT_NEAR(share(stretched), g * 0.4, 1e-8);
  EXPECT_NEAR(share(bent), g * (1.0 - std::pow(0.6, 3)), 1e-8);
}

TEST(BranchStiffness, IsSymmetricAndTakesNoNegativeEnergy) {
  const auto layup = relaxing_layup();
  const ElasticShell full(warped_reference(), layup);
  const LinearShell linear(full, LinearShellCase::reference());
  ASSERT_EQ(layup->relaxation_times(), (std::vector<double>{0.05, 0.3, 2.0}));
  for (std::size_t k = 0; k < 3; ++k) {
    const Eigen::MatrixXd C = full.branch_stiffness(0, k);
    const Eigen::MatrixXd seen = linear.branch_stiffness(0, k);
    for (const Eigen::MatrixXd& one : {C, seen}) {
      EXPECT_EQ(one, one.transpose());
      const Eigen::VectorXd values =
          Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(one).eigenvalues();
      EXPECT_GT(values.minCoeff(), -1e-14 * values.maxCoeff());
    }
  }
}

void fill_relaxing(model::Model& model) {
  const auto layup = relaxing_layup();
  const Nodes reference = warped_reference();
  std::array<int, 4> nodes{};
  for (int a = 0; a < 4; ++a) {
    model::NodeSlots slots = model::NodeSlots::Zero();
    slots.leftCols<2>() = reference.middleCols<2>(2 * a);
    nodes[static_cast<std::size_t>(a)] = model.nodes().add(slots, NodeKind::node6);
  }
  model::StrainDamping damping;
  for (double time : layup->relaxation_times()) damping.branches.push_back({time, {}});
  model::elements<ElasticShell>(model, effect, damping).add({reference, layup}, nodes);
}

TEST(LayeredRelaxation, TangentIsDerivativeOfResidual) {
  kit::expect_tangent_is_derivative(fill_relaxing, effect);
}
TEST(LayeredRelaxation, AssemblesWithoutHeap) { kit::expect_no_allocation(fill_relaxing, effect); }
TEST(LayeredRelaxation, AttemptsLeaveNoTrace) {
  kit::expect_attempts_leave_no_trace(fill_relaxing, effect);
}

// Work of the stress = change of the stored energy + what branches take, in steps of all lengths.
TEST(LayeredRelaxation, EnergyBalanceIsExact) {
  model::Model model;
  fill_relaxing(model);
  model.freeze(model::Form::null_space);
  kit::DenseAssembly dense(model);
  model::Batch* batch = kit::find_batch(model, effect);
  model::State state = model.initial_state();
  kit::Random random(7);
  for (const double h : {1e-3, 0.4, 0.05, 30.0}) {
    const Stencil stencil{h, 0.5, 0.5, 0.0};
    state.prev = state.next;
    for (int node = 0; node < 4; ++node) {
      model::NodeTable::slots(state.next, node).col(0) += 0.05 * random.vector();
      model::NodeTable::slots(state.next, node).col(1) += 0.05 * random.vector();
    }
    dense.prepare(state, stencil);
    const Eigen::VectorXd force = dense.residual(state, stencil, {batch});
    double work = 0.0;
    for (int node = 0; node < 4; ++node) {
      const model::NodeSlots moved =
          model::NodeTable::slots(state.next, node) - model::NodeTable::slots(state.prev, node);
      work += force.segment<3>(6 * node).dot(moved.col(0));
      work += force.segment<3>(6 * node + 3).dot(moved.col(1));
    }
    const double before = batch->stored_energy(state.prev);
    const double taken = batch->step_work(state, stencil).damping;
    dense.accept(state);
    const double stored = batch->stored_energy(state.next);
    EXPECT_GT(taken, 0.0);
    EXPECT_NEAR(work, stored - before + taken, 1e-12 * (stored + taken)) << h;
  }
}

}  // namespace
}  // namespace culm::shell
