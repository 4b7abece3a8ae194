// Patch tests, and laws of one material state: five distorted elements answer as one point would.
#include <culm/material/isotropic.hpp>
#include <culm/shell/elastic_shell.hpp>
#include <culm/shell/hyperelastic_shell.hpp>

#include "hourglass_case.hpp"
#include "shell_model.hpp"

#include <culm_kit/rigid_motion.hpp>
#include <gtest/gtest.h>

#include <cmath>

namespace culm::shell {
namespace {

constexpr double E = 1.0;
constexpr double nu = 0.3;
constexpr double width = 0.24;
constexpr double height = 0.12;
constexpr double thickness = 0.02;

// The five elements of MacNeal and Harder (1985).
const double corners[8][2] = {{0.0, 0.0},   {0.24, 0.0},  {0.24, 0.12}, {0.0, 0.12},
                              {0.04, 0.02}, {0.18, 0.03}, {0.16, 0.08}, {0.08, 0.08}};
const std::array<int, 4> quads[] = {
    {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}, {4, 5, 6, 7}};

template <class Shell>
ShellModel<Shell> five_elements(const material::Material::Law& law,
                                const ShellOptions& options = {}) {
  NodeColumns nodes(3, 16);
  for (int a = 0; a < 8; ++a) {
    nodes.col(2 * a) = Vec3(corners[a][0], corners[a][1], 0.0);
    nodes.col(2 * a + 1) = Vec3::UnitZ();
  }
  const auto layup =
      std::make_shared<material::Layup>(material::single_layer(material::Material{law}, thickness));
  ShellModel<Shell> model(nodes);
  for (const auto& quad : quads) {
    model.add(Shell(ShellModel<Shell>::gather(nodes, quad), layup, options), quad);
  }
  return model;
}

material::StVenantKirchhoff st_venant() { return material::IsotropicMaterial::law(E, nu); }

// In-plane homogeneous deformation of the outer nodes; the thickness is free.
template <class Shell>
void expect_homogeneous(ShellModel<Shell> model) {
  Mat<2, 2> F;
  F << 1.3, 0.2, 0.1, 0.8;
  const Mat<2, 2> strain = 0.5 * (F.transpose() * F - Mat<2, 2>::Identity());
  const double stretch = std::sqrt(1.0 - 2.0 * nu / (1.0 - nu) * strain.trace());
  const auto expected = [&](int a) {
    return Vec3((Vec3() << F * model.reference.col(2 * a).template head<2>(), 0.0).finished());
  };
  for (int a = 0; a < 4; ++a) {
    model.q.col(2 * a) = expected(a);
    model.hold(a, 0);
  }
  ASSERT_GT(model.solve(), 0);
  for (int a = 0; a < 8; ++a) {
    EXPECT_LT((model.q.col(2 * a) - expected(a)).norm(), 1e-12 * width) << "node " << a;
    EXPECT_LT((model.q.col(2 * a + 1) - stretch * Vec3::UnitZ()).norm(), 1e-12) << "node " << a;
  }
}

TEST(MembranePatch, FiniteHomogeneousStateIsExact) {
  expect_homogeneous(five_elements<ElasticShell>(st_venant()));
  expect_homogeneous(five_elements<ElasticShell>(st_venant(), {.enhancement = {7, 4}}));
  expect_homogeneous(five_elements<ElasticShell>(st_venant(), {.enhancement = {0, 0}}));
  expect_homogeneous(five_elements<HyperelasticShell>(st_venant()));
}

// w = 1/2 x . κ x at the outer nodes with the normals of that surface.
double bending_energy_ratio(const ShellOptions& options) {
  ShellModel<ElasticShell> model = five_elements<ElasticShell>(st_venant(), options);
  Mat<2, 2> curvature;
  curvature << 1.0, 0.5, 0.5, 2.0;
  const auto deflection = [&](int a) -> double {
    const Vec<2> x = model.reference.col(2 * a).head<2>();
    return 0.5 * x.dot(curvature * x);
  };
  const auto tilt = [&](int a) {
    return Vec<2>(-curvature * model.reference.col(2 * a).head<2>());
  };
  for (int a = 0; a < 4; ++a) {
    model.q(2, 2 * a) += deflection(a);
    model.q.col(2 * a + 1).head<2>() += tilt(a);
    model.hold(a, 0);
    model.hold(a, 1, 0);
    model.hold(a, 1, 1);
  }
  model.solve_linear();
  if (options.enhancement.thickness == 4) {
    for (int a = 4; a < 8; ++a) {
      EXPECT_NEAR(model.q(2, 2 * a), deflection(a), 1e-9 * deflection(2)) << "node " << a;
      EXPECT_LT((model.q.col(2 * a + 1).head<2>() - tilt(a)).norm(), 1e-9 * tilt(2).norm());
    }
  }
  const double D = E * std::pow(thickness, 3) / (12.0 * (1.0 - nu * nu));
  const double trace = curvature.trace();
  const double plate =
      0.5 * D * width * height * ((1.0 - nu) * curvature.squaredNorm() + nu * trace * trace);
  return model.linear_energy() / plate;
}

TEST(BendingPatch, ConstantCurvatureIsExact) {
  EXPECT_NEAR(bending_energy_ratio({}), 1.0, 1e-9);
  EXPECT_NEAR(bending_energy_ratio({.enhancement = {7, 4}}), 1.0, 1e-9);
}

// Without the linear thickness strain a bent plate cannot contract where it is stretched: it is
// as stiff as in plane strain through the thickness.
TEST(BendingPatch, LocksWithoutLinearThicknessStrain) {
  const double ratio = bending_energy_ratio({.enhancement = {4, 0}});
  EXPECT_GT(ratio, 1.1);
}

// Uniaxial stress: pulled along x, free to contract across and through the thickness.
template <class Shell>
void expect_uniaxial(const material::Material::Law& law, double stretch, double piola,
                     double lateral, double tolerance) {
  ShellModel<Shell> model = five_elements<Shell>(law);
  for (int a : {0, 3}) model.hold(a, 0, 0);
  for (int a : {1, 2}) {
    model.q(0, 2 * a) = stretch * width;
    model.hold(a, 0, 0);
  }
  model.hold(0, 0);
  model.hold(1, 0, 1);
  for (int a = 0; a < 4; ++a) model.hold(a, 0, 2);
  // a start near the state: the stretch all along
  for (int a = 4; a < 8; ++a) model.q(0, 2 * a) *= stretch;
  ASSERT_GT(model.solve(), 0) << stretch;
  double pull = 0.0;
  for (int a : {1, 2}) pull += model.reaction(a)[0];
  EXPECT_NEAR(pull / (height * thickness), piola, tolerance) << stretch;
  EXPECT_NEAR(model.q(1, 2 * 2) / height, lateral, tolerance) << stretch;
  for (int a = 0; a < 8; ++a) {
    EXPECT_NEAR(model.q.col(2 * a + 1).norm(), lateral, tolerance) << stretch;
    EXPECT_NEAR(model.q(0, 2 * a), stretch * model.reference(0, 2 * a), tolerance * width);
  }
}

struct Row {
  double stretch, piola, lateral;
};

TEST(Uniaxial, StVenantKirchhoff) {
  for (const double stretch : {0.6, 0.8, 0.9, 1.1, 1.25, 1.5, 2.0}) {
    const double strain = 0.5 * (stretch * stretch - 1.0);
    const double lateral = std::sqrt(1.0 - 2.0 * nu * strain);
    expect_uniaxial<ElasticShell>(st_venant(), stretch, stretch * E * strain, lateral, 1e-9);
    expect_uniaxial<HyperelasticShell>(st_venant(), stretch, stretch * E * strain, lateral, 1e-9);
  }
}

// Computed twice from W = μ/2 (I1 - 3) - μ ln J + λ/2 (ln J)^2 with free sides; eight digits.
TEST(Uniaxial, NeoHooke) {
  const Row rows[] = {{0.6, -0.62434857, 1.15498215}, {0.8, -0.24000538, 1.06733837},
                      {0.9, -0.10872219, 1.03170243}, {1.1, 0.09307743, 0.97149295},
                      {1.25, 0.21260478, 0.93356010}, {1.5, 0.37828018, 0.88017459},
                      {2.0, 0.64674466, 0.79807754}};
  const auto law = material::NeoHooke::from_moduli(E, nu);
  for (const Row& row : rows) {
    expect_uniaxial<HyperelasticShell>(law, row.stretch, row.piola, row.lateral, 6e-9);
  }
}

// A patch of 8 x 8 irregular elements, held around and strained as a whole.
template <class Shell>
ShellModel<Shell> irregular_patch(double aspect, const SharedLayup& layup) {
  constexpr int n = 8;
  kit::Random random(3);
  const auto node = [](int i, int j) { return i * (n + 1) + j; };
  NodeColumns nodes(3, 2 * (n + 1) * (n + 1));
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j <= n; ++j) {
      const bool inside = i > 0 && i < n && j > 0 && j < n;
      const Vec<2> off = inside ? Vec<2>(0.35 * random.matrix<2, 1>()) : Vec<2>(Vec<2>::Zero());
      nodes.col(2 * node(i, j)) = Vec3(i + off[0], aspect * (j + off[1]), 0.0);
      nodes.col(2 * node(i, j) + 1) = Vec3::UnitZ();
    }
  }
  ShellModel<Shell> model(nodes);
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const std::array<int, 4> quad{node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)};
      model.add(Shell(ShellModel<Shell>::gather(nodes, quad), layup, along_x()), quad);
    }
  }
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j <= n; ++j) {
      const bool inside = i > 0 && i < n && j > 0 && j < n;
      if (!inside) model.hold(node(i, j), 0);
      model.hold(node(i, j), 0, 2);
      model.hold(node(i, j), 1, 0);
      model.hold(node(i, j), 1, 1);
    }
  }
  return model;
}

TEST(HourglassPatch, IrregularElementsAreStableUpToTenPerCent) {
  for (const Wall& wall : walls()) {
    if (wall.name == "[0/90]" || wall.name == "[45/-45]") continue;  // directors are held
    for (const double aspect : {0.2, 1.0, 4.0, 20.0}) {
      auto model = irregular_patch<ElasticShell>(aspect, wall.layup);
      for (const Vec3& stress : loadings()) {
        const Vec3 strain = strain_under(stress, *wall.layup);
        const double critical =
            last(0.1, [&](double e) { return StrainedWall(*wall.layup, e * strain).is_stable(); });
        for (const double share : {0.5, 0.98}) {
          model.q = StrainedWall(*wall.layup, share * critical * strain).strained(model.reference);
          EXPECT_TRUE(model.is_stable()) << wall.name << " aspect " << aspect << " stress "
                                         << stress.transpose() << " share " << share;
        }
      }
    }
  }
}

// Rubber compressed by 30 per cent between held sides that keep their distance.
TEST(HourglassPatch, NeoHookeSheetIsStable) {
  const auto rubber = std::make_shared<material::Layup>(
      material::single_layer(material::Material{material::NeoHooke::from_moduli(1.0, 0.3)}, 0.1));
  for (const double aspect : {0.2, 1.0, 5.0, 25.0}) {
    auto model = irregular_patch<HyperelasticShell>(aspect, rubber);
    for (double stretch = 0.95; stretch > 0.69; stretch -= 0.05) {
      for (Eigen::Index node = 0; 2 * node < model.q.cols(); ++node) {
        model.q(0, 2 * node) = stretch * model.reference(0, 2 * node);
      }
      ASSERT_GT(model.solve(), 0) << aspect << " " << stretch;
      EXPECT_TRUE(model.is_stable()) << aspect << " " << stretch;
    }
  }
}

}  // namespace
}  // namespace culm::shell
