#include <culm/material/section.hpp>

#include "beam_case.hpp"

#include <Eigen/LU>
#include <culm_kit/constraint_contract.hpp>

namespace culm::beam {
namespace {

// The stretch acts at the tension centre, shear at the shear centre, which lie elsewhere.
TEST(CentreCoupling, HoldsTheCentresOfAnIsotropicSection) {
  const double EA = 7.0, GA1 = 2.0, GA2 = 3.0;
  const Vec<2> tension(0.3, -0.2), shear(-0.4, 0.5);
  const Mat6 C = material::stiffness_matrix(
      {.EA = EA,
       .GA1 = GA1,
       .GA2 = GA2,
       .EI1 = 5.0 + EA * tension[1] * tension[1],
       .EI2 = 6.0 + EA * tension[0] * tension[0],
       .GIp = 4.0 + GA1 * shear[1] * shear[1] + GA2 * shear[0] * shear[0],
       .ES1 = EA * tension[1],
       .ES2 = EA * tension[0],
       .GS1 = GA1 * shear[1],
       .GS2 = GA2 * shear[0],
       .EI12 = EA * tension[0] * tension[1]});
  Mat3 D;  // Γ + K x centre
  D << 0.0, 0.0, -shear[1], 0.0, 0.0, shear[0], tension[1], -tension[0], 0.0;
  EXPECT_LT((centre_coupling(C) - D).norm(), 1e-14);
  Vec6 own = Vec6::Zero();
  own.tail<3>() << 5.0, 6.0, 4.0;
  EXPECT_LT((without_shear_and_extension(C) - Mat6(own.asDiagonal())).norm(), 1e-14);
}

// W = 1/2 K . S_MM^-1 K : a moment bends as it did before.
TEST(WithoutShearAndExtension, LeavesTheComplianceAgainstMoments) {
  const Mat6 C = coupled_stiffness(3);
  const Mat3 compliance = Mat6(C.inverse()).bottomRightCorner<3, 3>();
  const Mat3 free = without_shear_and_extension(C).bottomRightCorner<3, 3>();
  EXPECT_LT((free * compliance - Mat3::Identity()).norm(), 1e-12);
}

TEST(WithoutShearAndExtension, DoesNotDependOnThePlaceOfTheAxis) {
  const material::Section section{coupled_stiffness(3), coupled_mass(4), {}};
  const Mat6 moved = material::shifted(section, {0.7, -1.3}).stiffness;
  EXPECT_LT(
      (without_shear_and_extension(moved) - without_shear_and_extension(section.stiffness)).norm(),
      1e-13);
}

// A section that does not resist shear at all has no shear centre.
TEST(CentreCoupling, IsZeroWhereNothingResists) {
  Mat6 C = material::stiffness_matrix({.EA = 2.0, .EI1 = 1.0, .EI2 = 1.0, .GIp = 1.0, .ES1 = 0.5});
  Mat3 D = Mat3::Zero();
  D(2, 0) = 0.25;
  EXPECT_LT((centre_coupling(C) - D).norm(), 1e-15);
}

template <int Order>
model::Constraint held(HeldStrains which, const typename DirectorBeam<Order>::Nodes& reference =
                                              DirectorBeamCase<Order>::reference()) {
  std::array<int, Order + 1> nodes{};
  for (int a = 0; a <= Order; ++a) nodes[static_cast<std::size_t>(a)] = a;
  return hold_strains<Order>("beam", which, DirectorBeamCase<Order>::make(), nodes, reference);
}

TEST(HoldStrains, RowsAreTheStrainsOfTheElement) {
  const auto element = DirectorBeamCase<2>::make();
  const auto q = DirectorBeamCase<2>::state(5);
  const model::Constraint kirchhoff = held<2>({.shear_and_extension = true});
  const model::Constraint both = held<2>({.shear_and_extension = true, .torsion = true});
  const model::Constraint untwisted = held<2>({.torsion = true});
  ASSERT_EQ(kirchhoff.rows.size(), 6u);
  ASSERT_EQ(both.rows.size(), 8u);
  ASSERT_EQ(untwisted.rows.size(), 2u);
  for (int p = 0; p < 2; ++p) {
    Vec6 e;
    element.strain(p, q, e);
    const Mat3 D = centre_coupling(element.stiffness(p));
    const auto value = [&](const model::Constraint& c, int row) {
      return row_value(c.rows[static_cast<std::size_t>(row)], q);
    };
    const Vec3 all = e.head<3>() + D * e.tail<3>();
    const Vec3 bent = e.head<3>() + D.leftCols<2>() * e.segment<2>(3);
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(value(kirchhoff, 3 * p + i), all[i], 1e-13) << p << ", " << i;
      EXPECT_NEAR(value(both, 4 * p + i), bent[i], 1e-13) << p << ", " << i;
    }
    EXPECT_NEAR(value(both, 4 * p + 3), element.length(p) * e[5], 1e-13);
    EXPECT_NEAR(value(untwisted, p), element.length(p) * e[5], 1e-13);
  }
}

// Uncoupled sections pay for nothing: one product a row.
TEST(HoldStrains, RowsOfSymmetricSectionsAreProducts) {
  std::array<Mat6, 1> stiffness{Mat6::Identity()};
  const DirectorBeam<1> element(curved_reference<2>(), stiffness,
                                {coupled_mass(1), coupled_mass(1)});
  const auto c = hold_strains<1>("beam", {.shear_and_extension = true}, element, {0, 1},
                                 curved_reference<2>());
  for (const model::ConstraintRow& row : c.rows) EXPECT_EQ(row.alpha.size(), 8u);
}

// The energy of the free strains is that of the element where the rows hold.
TEST(KirchhoffBeam, StoresTheEnergyOfTheStrainsThatItHolds) {
  const auto whole = DirectorBeamCase<1>::make();
  const KirchhoffBeam<1> beam(whole);
  const Vec3 K(0.3, -0.5, 0.2);
  Vec6 e;
  e << -centre_coupling(whole.stiffness(0)) * K, K;
  EXPECT_NEAR(beam.energy(0, K), whole.energy(0, e), 1e-14);
  e[1] += 1e-3;  // a minimum
  EXPECT_LT(beam.energy(0, K), whole.energy(0, e));
}

template <bool Shear, bool Torsion>
struct HeldCase {
  static constexpr int num_nodes = 3;
  static constexpr bool eliminated = false;
  static model::Constraint make(const model::NodeTable& nodes) {
    DirectorBeam<2>::Nodes reference;
    for (int a = 0; a < num_nodes; ++a) {
      reference.middleCols<4>(4 * a) = model::NodeTable::slots(nodes.reference(), a);
    }
    return held<2>({Shear, Torsion}, reference);
  }
};

}  // namespace
}  // namespace culm::beam

namespace culm::kit {
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(JointContract);  // a beam's rows are no joint's
const auto held_cases = testing::Values(subject<beam::HeldCase<true, false>>("Shear"),
                                        subject<beam::HeldCase<false, true>>("Torsion"),
                                        subject<beam::HeldCase<true, true>>("Both"));
INSTANTIATE_TEST_SUITE_P(HeldStrains, ConstraintContract, held_cases, name_of_subject);
}  // namespace culm::kit
