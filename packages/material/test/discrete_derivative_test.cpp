#include <culm/material/discrete_derivative.hpp>
#include <culm/material/isotropic.hpp>
#include <culm/material/neo_hooke.hpp>

#include <culm_kit/finite_difference.hpp>
#include <culm_kit/rigid_motion.hpp>
#include <gtest/gtest.h>

namespace culm::material {
namespace {

const Vec6 prev = 0.1 * kit::Random(1).matrix<6, 1>();
const Vec6 direction = 0.1 * kit::Random(2).matrix<6, 1>();

template <class Law>
Vec6 stress(const Law& law, const Vec6& next, const Stencil& stencil = Stencil::midpoint(0.1)) {
  Vec6 S;
  Mat6 D;
  EXPECT_EQ(step_stress(law, prev, next, stencil, S, D), Verdict::ok);
  return S;
}

TEST(DiscreteDerivative, DoesTheStoredWork) {
  const NeoHooke law = NeoHooke::from_moduli(2.0, 0.3);
  for (const double size : {1.0, 1e-1, 1e-2, 2e-3, 1e-3, 5e-4, 1e-5, 1e-8}) {
    const Vec6 dE = size * direction;
    const double stored = law.energy(prev + dE) - law.energy(prev);
    EXPECT_NEAR(stress(law, prev + dE).dot((prev + dE) - prev), stored, 1e-16) << size;
  }
}

TEST(DiscreteDerivative, IsTheMeanStressForProportionalLaws) {
  const StVenantKirchhoff law = IsotropicMaterial::law(2.0, 0.3);
  EXPECT_LT((stress(law, prev + direction) - law.C * (prev + 0.5 * direction)).norm(), 1e-16);
}

TEST(DiscreteDerivative, TangentIsTheDerivative) {
  const NeoHooke law = NeoHooke::from_moduli(2.0, 0.3);
  for (const Stencil& stencil : {Stencil::statics(), Stencil::midpoint(0.1), {0.1, 0.5, 1.0}}) {
    Vec6 S;
    Mat6 D;
    step_stress(law, prev, prev + direction, stencil, S, D);
    const auto difference = kit::central_difference<6, 6>(
        [&](const Vec6& next) { return stress(law, next, stencil); }, Vec6(prev + direction));
    EXPECT_LT(kit::relative_difference(difference, D), 2e-9);
  }
}

// where the formula changes, the stress does not: |ΔE|^2 = 1e-8 in the metric of the law
TEST(DiscreteDerivative, DoesNotJump) {
  const NeoHooke law = NeoHooke::from_moduli(2.0, 0.3);
  const Mat6& C0 = law.small_strain_stiffness();
  const double size = std::sqrt(1e-8 * C0(0, 0) / direction.dot(C0 * direction));
  const Vec6 below = stress(law, prev + size * (1.0 - 1e-9) * direction);
  const Vec6 above = stress(law, prev + size * (1.0 + 1e-9) * direction);
  EXPECT_LT((above - below).norm(), 1e-12 * below.norm());
}

}  // namespace
}  // namespace culm::material
