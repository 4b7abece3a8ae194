#include <culm/model/element_batch.hpp>

#include "shell_case.hpp"

#include <culm_kit/batch_laws.hpp>
#include <culm_kit/no_heap.hpp>
#include <gtest/gtest.h>

namespace culm::shell {
namespace {

constexpr const char* effect = "shell";

/// One element, and on demand a triad node that the first of its nodes follow.
void fill(model::Model& model, int slaves) {
  const Nodes reference = warped_reference();
  std::array<int, 4> nodes{};
  for (int a = 0; a < 4; ++a) {
    model::NodeSlots slots = model::NodeSlots::Zero();
    slots.leftCols<2>() = reference.middleCols<2>(2 * a);
    nodes[static_cast<std::size_t>(a)] = model.nodes().add(slots, NodeKind::node6);
  }
  model::elements<ElasticShell>(model, effect).add(ElasticShell(reference, mixed_layup()), nodes);
  if (slaves == 0) return;
  const int master = model.nodes().add(kit::random_node(20));
  for (int a = 0; a < slaves; ++a) {
    model.add_rigid_link("link", nodes[static_cast<std::size_t>(a)], master);
  }
}

/// What ElementBatch makes of a shell whose nodes are free, or follow a body.
class ProjectedShell : public testing::TestWithParam<int> {};

TEST_P(ProjectedShell, TangentIsDerivativeOfResidual) {
  kit::expect_tangent_is_derivative([](model::Model& model) { fill(model, GetParam()); }, effect);
}

TEST_P(ProjectedShell, AssembleAllocatesNothing) {
  model::Model model;
  fill(model, GetParam());
  model.freeze(model::Form::null_space);
  kit::DenseAssembly dense(model);
  const model::State state = kit::random_state(model, 3);
  const Stencil stencil = Stencil::midpoint(0.4);
  dense.begin_step(state, stencil);
  const kit::DenseAssembly::Batches tested = {kit::find_batch(model, effect)};
  kit::NoHeap guard;
  EXPECT_EQ(dense.assemble(state, stencil, Want::residual_and_tangent, tested), Verdict::ok);
}

INSTANTIATE_TEST_SUITE_P(SlaveNodes, ProjectedShell, testing::Values(0, 1, 2, 4));

}  // namespace
}  // namespace culm::shell
