#include <culm/beam/element_batches.hpp>

#include "beam_case.hpp"

#include <culm_kit/batch_laws.hpp>
#include <gtest/gtest.h>

namespace culm::beam {
namespace {

constexpr const char* effect = "beam";

/// One element of a case, and on demand a master that its last node follows.
template <class Case>
void fill(model::Model& model, bool with_slave) {
  using E = typename Case::Type;
  const auto reference = Case::reference();
  std::array<int, E::num_nodes> nodes{};
  for (int a = 0; a < E::num_nodes; ++a) {
    nodes[static_cast<std::size_t>(a)] = model.nodes().add(reference.template middleCols<4>(4 * a));
  }
  model::elements<E>(model, effect).add(Case::make(), nodes);
  if (with_slave) {
    model.add_rigid_link("link", nodes.back(), model.nodes().add(kit::random_node(20)));
  }
}

/// What ElementBatch makes of the forms of an element.
template <class Case>
class ProjectedElement : public testing::Test {};

using Cases = testing::Types<DirectorBeamCase<1>, DirectorBeamCase<2>, HelicalBeamCase>;
TYPED_TEST_SUITE(ProjectedElement, Cases);

TYPED_TEST(ProjectedElement, TangentIsDerivativeOfResidual) {
  for (const bool with_slave : {false, true}) {
    SCOPED_TRACE(with_slave ? "with an eliminated node" : "all nodes free");
    kit::expect_tangent_is_derivative(
        [&](model::Model& model) { fill<TypeParam>(model, with_slave); }, effect);
  }
}

TYPED_TEST(ProjectedElement, NullSpaceResidualIsProjected) {
  for (const bool with_slave : {false, true}) {
    SCOPED_TRACE(with_slave ? "with an eliminated node" : "all nodes free");
    kit::expect_residual_is_projected(
        [&](model::Model& model) { fill<TypeParam>(model, with_slave); }, effect);
  }
}

TYPED_TEST(ProjectedElement, AttemptsLeaveNoTrace) {
  kit::expect_attempts_leave_no_trace([&](model::Model& model) { fill<TypeParam>(model, true); },
                                      effect);
}

TYPED_TEST(ProjectedElement, AssembleAllocatesNothing) {
  kit::expect_no_allocation([&](model::Model& model) { fill<TypeParam>(model, true); }, effect);
}

}  // namespace
}  // namespace culm::beam
