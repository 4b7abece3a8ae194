// The hourglass mode of the enhanced membrane: its stiffness, its factors, and that compression in
// the plane does not make it buckle before the material does. Tables of these tests stand on
// doc/verification/hourglass.md.
#include <culm/shell/hourglass.hpp>
#include <culm/shell/hyperelastic_shell.hpp>

#include "hourglass_case.hpp"
#include "shell_case.hpp"

#include <gtest/gtest.h>

#include <cstdio>

namespace culm::shell {
namespace {

// Stiffness of an element against motions of its hourglass vector in the plane, the affine part of
// positions held, directors free.
Mat<2, 2> hourglass_stiffness(const RowMat<24, 24>& K) {
  constexpr int signs[] = {1, -1, 1, -1};
  Mat<2, 2> held = Mat<2, 2>::Zero();
  Eigen::MatrixXd coupling = Eigen::MatrixXd::Zero(12, 2);
  Eigen::MatrixXd directors(12, 12);
  for (int a = 0; a < 4; ++a) {
    for (int b = 0; b < 4; ++b) {
      held += signs[a] * signs[b] * K.block<2, 2>(6 * a, 6 * b);
      coupling.middleRows<3>(3 * a) += signs[b] * K.block<3, 2>(6 * a + 3, 6 * b);
      directors.block<3, 3>(3 * a, 3 * b) = K.block<3, 3>(6 * a + 3, 6 * b + 3);
    }
  }
  const Eigen::MatrixXd answer = directors.partialPivLu().solve(coupling);
  return held - coupling.transpose() * answer;
}

// V/3 (E1 e1 e1^T / |X1|^2 + E2 e2 e2^T / |X2|^2), moduli by laminate theory
Mat<2, 2> formula(const Nodes& reference, const material::Layup& layup) {
  const ShellForms::Modes X = ShellForms::modes(reference);
  const double t = layup.thickness();
  const Mat3 a = t * membrane_compliance(layup);
  Mat<2, 2> sum = Mat<2, 2>::Zero();
  for (int i = 0; i < 2; ++i) {
    const Vec<2> side = X.col(i).head<2>();
    const Vec<2> e = side.normalized();
    const Vec3 v(e[0] * e[0], e[1] * e[1], e[0] * e[1]);
    sum += e * e.transpose() / (v.dot(a * v) * side.squaredNorm());
  }
  return 4.0 * X.col(0).cross(X.col(1)).norm() * t / 3.0 * sum;
}

// Whatever is enhanced, a parallelogram of a wall that does not bend resists by its fibres alone. A
// thin one: gradients of the thickness strain cost shear, of the order (thickness / side)^2.
TEST(Hourglass, StiffnessIsThatOfTheFibresAlongTheSides) {
  for (const Wall& wall : walls()) {
    if (wall.name == "[0/90]" || wall.name == "[45/-45]") continue;
    for (const double aspect : aspects) {
      for (const double skew : skews) {
        const Nodes q = parallelogram(aspect, skew, 1000.0);
        const Mat<2, 2> expected = formula(q, *wall.layup);
        for (const int membrane : {4, 7}) {
          const ElasticShell element(q, wall.layup, along_x({membrane, 4}));
          const Mat<2, 2> found = hourglass_stiffness(tangent(element, q));
          // layers of different contraction share one thickness strain
          const double tolerance = wall.layup->layers.size() > 1 ? 2e-3 : 1e-6;
          EXPECT_LT((found - expected).norm(), tolerance * expected.norm())
              << wall.name << " aspect " << aspect << " skew " << skew << " modes " << membrane;
        }
      }
    }
  }
}

Mat<2, 2> half_sides(const Nodes& q) { return ShellForms::modes(q).topLeftCorner<2, 2>(); }

TEST(HourglassFactors, OfAnIsotropicRectangle) {
  for (const double aspect : aspects) {  // across over along
    const Vec<2> c = hourglass_factors(half_sides(parallelogram(aspect, 0.0)), *isotropic_wall());
    const double slender = 1.0 / (aspect * aspect);
    EXPECT_NEAR(c[0], std::min(1.0, 2.5 * std::min(1.0, slender)), 1e-12) << aspect;
    EXPECT_NEAR(c[1], std::min(1.0, 2.5 * std::min(1.0, 1.0 / slender)), 1e-12) << aspect;
  }
}

TEST(HourglassFactors, AreZeroForLargeStrains) {
  const auto rubber =
      material::single_layer(material::Material{material::NeoHooke::from_moduli(1.0, 0.3)}, 0.1);
  EXPECT_EQ(hourglass_factors(half_sides(parallelogram(1.0, 0.0)), rubber), Vec<2>::Zero());
}

// The stresses of the limit, of the material or of a strain of 0.2, along both normals at once, at
// small strains: the geometric stiffness of the positions takes at most what the fibres have.
TEST(Hourglass, ModeOutlivesTheMaterialUnderCompressionOfBothSides) {
  constexpr double small = 1e-6;
  for (const Wall& wall : walls()) {
    const Mat3 A = material::laminate_stiffness(*wall.layup).topLeftCorner<3, 3>();
    for (const double aspect : aspects) {
      for (const double skew : skews) {
        const Nodes q = parallelogram(aspect, skew);
        const Mat<2, 2> normals = half_sides(q).inverse();
        Mat<2, 3> across;
        Vec<2> stress;
        for (int i = 0; i < 2; ++i) {
          const Vec<2> m = normals.row(i).normalized();
          const Mat<3, 2> N = gradients_along(m);
          const Vec3 uniaxial(m[0] * m[0], m[1] * m[1], m[0] * m[1]);
          const double modulus = 1.0 / uniaxial.dot(membrane_compliance(*wall.layup) * uniaxial);
          stress[i] = -0.98 * std::min(eigenvalues(N.transpose() * A * N)[0], 0.2 * modulus);
          across.row(i) << m[0] * m[0], m[1] * m[1], 2.0 * m[0] * m[1];
        }
        const Mat<2, 2> gram = across * across.transpose();
        const Vec3 strain = A.inverse() * across.transpose() * gram.inverse() * stress;

        const ElasticShell element(q, wall.layup, along_x());
        ShellForms::Strain y;
        element.strain(0, StrainedWall(*wall.layup, small / strain.norm() * strain).strained(q), y);
        Response<ShellForms::num_strains> response;
        element.respond(0, y, y, Stencil::statics(), response);
        SlotMatrix<8> geometric = SlotMatrix<8>::Zero();
        element.add_curvature(0, strain.norm() / small * response.stress, geometric);
        RowMat<24, 24> K = tangent(element, q);
        for (int s = 0; s < 8; s += 2) {
          for (int r = 0; r < 8; r += 2) {
            K.block<3, 3>(3 * s, 3 * r) += geometric(s, r) * Mat3::Identity();
          }
        }
        EXPECT_GT(eigenvalues(hourglass_stiffness(K))[0], 0.0)
            << wall.name << " aspect " << aspect << " skew " << skew;
      }
    }
  }
}

// Strains are blind to the factors in affine motions and, to first order, in all.
TEST(Hourglass, VectorVanishesInAffineMotions) {
  const Nodes reference = warped_reference();
  const ShellOptions options{.reference_axis = Vec3(1.0, 0.3, 0.1)};
  const ShellGeometry with(reference, *mixed_layup(), options);
  const ShellGeometry without(reference, mixed_layup()->thickness(), options);
  ASSERT_GT(with.hourglass().minCoeff(), 0.1);
  const ShellForms forms(reference);
  const Mat3 F = Mat3::Identity() + 0.3 * kit::Random(8).matrix<3, 3>();
  ShellForms::Strain affine;
  forms.strain(0, F * reference, affine);
  Gradient<8, ShellForms::num_strains> B;
  forms.gradient(0, reference, B);
  const ShellGeometry::StrainMap difference =
      with.at(0.5, -0.3, 0.02).strain - without.at(0.5, -0.3, 0.02).strain;
  EXPECT_GT(difference.norm(), 0.01);
  EXPECT_LT((difference * affine).norm(), 1e-14);
  EXPECT_LT((difference * B.transpose()).norm(), 1e-14);
}

// The strain at which a lattice of elements fails, over that of the continuum or ten per cent.
struct Lattice {
  SharedLayup layup;
  ShellForms::Nodes reference;
  Enhancement enhancement;

  bool is_stable(const Vec3& strain) const {
    const StrainedWall wall(*layup, strain);
    return waves_are_stable(
        tangent(ElasticShell(reference, layup, along_x(enhancement)), wall.strained(reference)));
  }
};

TEST(HourglassLattice, NoWaveIsSingularBeforeThoseOfTheContinuum) {
  for (const Wall& wall : walls()) {
    for (const Vec3& stress : loadings()) {
      const Vec3 strain = strain_under(stress, *wall.layup);
      const double critical =
          last(0.1, [&](double e) { return StrainedWall(*wall.layup, e * strain).is_stable(); });
      for (const double aspect : aspects) {
        for (const double skew : skews) {
          for (const int membrane : {4, 7}) {
            const Lattice lattice{wall.layup, parallelogram(aspect, skew), {membrane, 4}};
            EXPECT_TRUE(lattice.is_stable(0.98 * critical * strain))
                << wall.name << " aspect " << aspect << " skew " << skew << " stress "
                << stress.transpose() << " strain " << 0.98 * critical << " modes " << membrane;
          }
        }
      }
    }
  }
}

// Not a law but a measurement: prints the table of the page, strains along x at the first wave.
TEST(HourglassLattice, FirstSingularWaves) {
  constexpr double most = 0.36;
  std::printf("%-12s %10s %8s %8s %8s %8s\n", "wall", "aspect", "solid", "none", "4", "7");
  for (const Wall& wall : walls()) {
    const Vec3 strain = strain_under({-1, 0, 0}, *wall.layup);
    const double solid =
        last(most, [&](double e) { return StrainedWall(*wall.layup, e * strain).is_stable(); });
    for (const double aspect : {1.0 / 25.0, 1.0, 5.0, 25.0}) {
      std::printf("%-12s %10.3g %8.4f", wall.name.c_str(), aspect, solid);
      for (const int membrane : {0, 4, 7}) {
        const Lattice lattice{wall.layup, parallelogram(aspect, 0.0), {membrane, 4}};
        const double found = last(most, [&](double e) { return lattice.is_stable(e * strain); });
        std::printf(" %8.4f", found);
        EXPECT_GT(found, 0.98 * std::min(solid, 0.1)) << wall.name << " aspect " << aspect;
      }
      std::printf("\n");
    }
  }
}

}  // namespace
}  // namespace culm::shell
