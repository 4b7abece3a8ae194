#include <culm/shell/element_batches.hpp>

#include "shell_case.hpp"

#include <culm_kit/batch_laws.hpp>
#include <gtest/gtest.h>

#include <string>
#include <tuple>

namespace culm::shell {
namespace {

using kit::effect;

/// Four nodes, and on demand a triad node that the first of them follow.
std::array<int, 4> add_nodes(model::Model& model, int slaves) {
  const Nodes reference = warped_reference();
  std::array<int, 4> nodes{};
  for (int a = 0; a < 4; ++a) {
    model::NodeSlots slots = model::NodeSlots::Zero();
    slots.leftCols<2>() = reference.middleCols<2>(2 * a);
    nodes[static_cast<std::size_t>(a)] = model.nodes().add(slots, NodeKind::node6);
  }
  if (slaves == 0) return nodes;
  const int master = model.nodes().add(kit::random_node(20));
  for (int a = 0; a < slaves; ++a) {
    model.add_rigid_link("link", nodes[static_cast<std::size_t>(a)], master);
  }
  return nodes;
}

void fill_elastic(model::Model& model, int slaves) {
  const std::array<int, 4> nodes = add_nodes(model, slaves);
  model::elements<ElasticShell>(model, effect).add(ElasticShellCase::make(), nodes);
}

void fill_linear(model::Model& model, int slaves) {
  const auto [a, b, c, d] = add_nodes(model, slaves);
  const LinearShell::Nodes reference = LinearShellCase::reference();
  const int frame = model.nodes().add(reference.leftCols<4>());
  model::elements<LinearShell>(model, effect).add(LinearShellCase::make(), {frame, a, b, c, d});
}

/// What ElementBatch makes of a shell, elastic or linear, whose nodes are free, or follow a body.
class ProjectedShell : public testing::TestWithParam<std::tuple<std::string, int>> {
 protected:
  static void fill(model::Model& model) {
    const auto& [kind, slaves] = GetParam();
    (kind == "linear" ? fill_linear : fill_elastic)(model, slaves);
  }
};

TEST_P(ProjectedShell, TangentIsDerivativeOfResidual) {
  kit::expect_tangent_is_derivative(fill, effect);
}

TEST_P(ProjectedShell, AttemptsLeaveNoTrace) { kit::expect_attempts_leave_no_trace(fill, effect); }

TEST_P(ProjectedShell, AssembleAllocatesNothing) { kit::expect_no_allocation(fill, effect); }

INSTANTIATE_TEST_SUITE_P(Slaves, ProjectedShell,
                         testing::Combine(testing::Values("elastic", "linear"),
                                          testing::Values(0, 1, 2, 4)));

}  // namespace
}  // namespace culm::shell
