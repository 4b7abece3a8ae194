#include <culm/mechanics/pack.hpp>
#include <culm/model/model.hpp>

#include <culm_kit/batch_laws.hpp>
#include <gtest/gtest.h>

namespace culm::model {
namespace {

using kit::effect;

// More than a pack of bodies, with their centres beside the nodes; the last but one hangs on the
// last one by a lever.
void fill(Model& model) {
  kit::Random random(5);
  int node = -1;
  for (int body = 0; body < pack_lanes + 3; ++body) {
    const int before = node;
    node = model.nodes().add(kit::random_node(body));
    model.masses(effect).add(node, random.positive_matrix<4>());
    if (body == pack_lanes + 2) model.add_rigid_link("link", before, node);
  }
}

// Statics know no inertia.
TEST(MassBatch, NullSpaceResidualIsProjected) {
  kit::expect_residual_is_projected(fill, effect, {Stencil::midpoint(0.4)});
}

TEST(MassBatch, TangentIsDerivativeOfResidual) { kit::expect_tangent_is_derivative(fill, effect); }

TEST(MassBatch, AssembleAllocatesNothing) { kit::expect_no_allocation(fill, effect); }

}  // namespace
}  // namespace culm::model
