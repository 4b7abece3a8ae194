// Structures of a few elements against published values and beam theory.
#include <culm/material/isotropic.hpp>
#include <culm/material/orthotropic.hpp>
#include <culm/shell/elastic_shell.hpp>

#include "shell_model.hpp"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace culm::shell {
namespace {

using Model = ShellModel<ElasticShell>;

material::Layup isotropic(double E, double nu, double thickness) {
  return material::single_layer(material::Material{material::IsotropicMaterial::law(E, nu)},
                                thickness);
}

// A strip along x in the plane z = 0 of n x 1 elements, clamped at x = 0. Node 2 i + j at the i-th
// station, j = 0, 1 across.
Model strip(double length, double width, int n, const material::Layup& layup,
            const ShellOptions& options = {}) {
  NodeColumns nodes(3, 4 * (n + 1));
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j < 2; ++j) {
      nodes.col(2 * (2 * i + j)) = Vec3(length * i / n, width * j, 0.0);
      nodes.col(2 * (2 * i + j) + 1) = Vec3::UnitZ();
    }
  }
  const auto shared = std::make_shared<material::Layup>(layup);
  Model model(nodes);
  for (int i = 0; i < n; ++i) {
    const std::array<int, 4> quad{2 * i, 2 * i + 2, 2 * i + 3, 2 * i + 1};
    model.add({Model::gather(nodes, quad), shared, options}, quad);
  }
  model.hold(0);
  model.hold(1);
  return model;
}

// Total force on the two nodes of the tip, on positions (slot 0) or directors (slot 1).
void load_tip(Model& model, int slot, const Vec3& force) {
  const auto nodes = static_cast<int>(model.q.cols() / 2);
  for (int a : {nodes - 2, nodes - 1}) model.force.col(2 * a + slot) = 0.5 * force;
}

Vec3 tip_displacement(const Model& model) {
  const auto column = model.q.cols() - 2;
  return model.q.col(column) - model.reference.col(column);
}

// Sze, Liu, Lo (2004), 3.1: 3.286 and 6.698; 3.293 and 6.705 on this mesh.
TEST(Cantilever, EndShear) {
  Model model = strip(10.0, 1.0, 16, isotropic(1.2e6, 0.0, 0.1));
  load_tip(model, 0, Vec3(0.0, 0.0, 4.0));
  ASSERT_GT(model.solve(4), 0);
  EXPECT_NEAR(-tip_displacement(model).x(), 3.293, 5e-4);
  EXPECT_NEAR(tip_displacement(model).z(), 6.705, 5e-4);
}

TEST(Cantilever, LocksWithoutAssumedShear) {
  Model model = strip(10.0, 1.0, 16, isotropic(1.2e6, 0.0, 0.1), {.assumed_shear = false});
  load_tip(model, 0, Vec3(0.0, 0.0, 4.0));
  ASSERT_GT(model.solve(4), 0);
  EXPECT_LT(tip_displacement(model).z(), 0.2 * 6.7);
}

// Bent in its plane, the strip locks without the enhanced membrane strains: beams of one row of
// elements, M L^2 / (2 E I) by linear theory.
TEST(Cantilever, EnhancedMembraneStrainsBendInPlane) {
  const auto ratio = [](int membrane) {
    Model model = strip(10.0, 1.0, 4, isotropic(1.2e6, 0.0, 0.1), {.enhancement = {membrane, 4}});
    const auto nodes = static_cast<int>(model.q.cols() / 2);
    model.force.col(2 * (nodes - 2)) = Vec3(1e-3, 0.0, 0.0);  // the couple 1e-3 x width
    model.force.col(2 * (nodes - 1)) = Vec3(-1e-3, 0.0, 0.0);
    model.solve_linear();
    return tip_displacement(model).y() / (1e-3 * 100.0 / (2.0 * 1.2e6 * 0.1 / 12.0));
  };
  EXPECT_NEAR(ratio(4), 1.0, 1e-9);
  EXPECT_NEAR(ratio(7), 1.0, 1e-9);
  EXPECT_LT(ratio(0), 0.35);
}

// The classical laminate without coupling bends as a beam of 1 / d11 per width.
TEST(LaminatedStrip, BendsByLaminateTheory) {
  const material::OrthotropicConstants c{25.0, 1.0, 1.0, 0.25, 0.25, 0.25, 0.5, 0.5, 0.2};
  const material::Material ply{material::OrthotropicMaterial::law(c)};
  const double t = 0.025;
  const double right = 0.5 * std::numbers::pi;
  const material::Layup layup{{{ply, t, 0.0}, {ply, t, right}, {ply, t, right}, {ply, t, 0.0}}};
  const double nu21 = c.nu12 * c.E2 / c.E1;
  Mat3 Q0 = Mat3::Zero();
  Q0.topLeftCorner<2, 2>() << c.E1, c.nu12 * c.E2, c.nu12 * c.E2, c.E2;
  Q0 /= 1.0 - c.nu12 * nu21;
  Q0(2, 2) = c.G12;
  Mat3 Q90 = Q0;
  std::swap(Q90(0, 0), Q90(1, 1));
  const Mat3 D = 2.0 / 3.0 * t * t * t * (7.0 * Q0 + Q90);
  const double bending = 1.0 / D.inverse()(0, 0);

  const double length = 10.0;
  const double width = 1.0;
  Model model = strip(length, width, 20, layup);
  model.hold(1, 0, 1);
  const double moment = 1e-11;  // so small that squares of displacements do not show in strains
  load_tip(model, 1, Vec3(moment * width, 0.0, 0.0));  // on the directors
  model.solve_linear();
  const double w = -moment * length * length / (2.0 * bending);
  EXPECT_NEAR(tip_displacement(model).z() / w, 1.0, 1e-3);

  // resultants and stresses in the middle: M = m, face stress as laminate theory has it
  const auto& element = model.elements[10];
  ShellForms::Strain y;
  element.strain(0, Model::gather(model.q, model.connectivity[10]), y);
  const auto R = element.resultants(0, y);
  EXPECT_NEAR(R[3], moment, 1e-5 * moment);
  EXPECT_LT(R.head<3>().cwiseAbs().maxCoeff(), 1e-5 * moment / t);
  EXPECT_LT(R.tail<2>().cwiseAbs().maxCoeff(), 1e-4 * moment / t);
  const Vec3 curvature = D.inverse() * Vec3(moment, 0.0, 0.0);
  for (const double height : {-1.0, 0.0, 1.0}) {
    const double zeta = (1.5 + 0.5 * height) * t;
    EXPECT_NEAR(element.layer_state(3, height, y).stress[0], (Q0 * curvature)[0] * zeta,
                2e-3 * (Q0 * curvature)[0] * 2.0 * t);
    // of the layer below, axis 2 is along the strip
    EXPECT_NEAR(element.layer_state(2, height, y).stress[1], (Q90 * curvature)[0] * (zeta - t),
                2e-2 * (Q90 * curvature)[0] * t);
  }
}

// A quarter of the hemisphere with an 18 degree hole, pulled and pinched by P = 400 at the four
// ends of its axes: Sze, Liu, Lo (2004), 3.4. Displacements of the two points along their loads.
Vec<2> pinched_hemisphere(int n, const ShellOptions& options) {
  const double R = 10.0;
  using std::numbers::pi;
  NodeColumns nodes(3, 2 * (n + 1) * (n + 1));
  const auto node = [&](int i, int j) { return i * (n + 1) + j; };
  for (int i = 0; i <= n; ++i) {    // around
    for (int j = 0; j <= n; ++j) {  // from the equator to the hole
      const double around = 0.5 * pi * i / n;
      const double up = 0.4 * pi * j / n;
      const Vec3 normal(std::cos(up) * std::cos(around), std::cos(up) * std::sin(around),
                        std::sin(up));
      nodes.col(2 * node(i, j)) = R * normal;
      nodes.col(2 * node(i, j) + 1) = normal;
    }
  }
  const auto layup = std::make_shared<material::Layup>(isotropic(6.825e7, 0.3, 0.04));
  Model model(nodes);
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const std::array<int, 4> quad{node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)};
      model.add({Model::gather(nodes, quad), layup, options}, quad);
    }
  }
  for (int j = 0; j <= n; ++j) {
    for (int slot : {0, 1}) {
      model.hold(node(0, j), slot, 1);
      model.hold(node(n, j), slot, 0);
    }
  }
  model.hold(node(0, 0), 0, 2);
  model.force.col(2 * node(0, 0)).x() = 200.0;
  model.force.col(2 * node(n, 0)).y() = -200.0;
  EXPECT_GT(model.solve(5), 0);
  return {model.q(0, 2 * node(0, 0)) - R, R - model.q(1, 2 * node(n, 0))};
}

TEST(PinchedHemisphere, SixteenBySixteen) {
  const Vec<2> moved = pinched_hemisphere(16, {});
  EXPECT_NEAR(moved[0], 4.0454, 5e-4);
  EXPECT_NEAR(moved[1], 8.108, 5e-4);
}

TEST(PinchedHemisphere, IsStifferWithoutAssumedThicknessStrain) {
  const Vec<2> moved = pinched_hemisphere(16, {.assumed_thickness = false});
  EXPECT_NEAR(moved[0], 3.849, 5e-4);
  EXPECT_NEAR(moved[1], 7.624, 5e-4);
}

}  // namespace
}  // namespace culm::shell
