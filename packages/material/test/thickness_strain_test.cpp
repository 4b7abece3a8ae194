#include <culm/material/thickness_strain.hpp>
#include <culm/math/quadrature.hpp>

#include <Eigen/LU>
#include <culm_kit/finite_difference.hpp>
#include <gtest/gtest.h>

#include <array>

namespace culm::material {
namespace {

using kit::relative_difference;

Material isotropic(double E, double nu, double expansion = 0.0) {
  StVenantKirchhoff law;
  law.C.setZero();
  law.C.topLeftCorner<3, 3>().setConstant(E * nu / ((1.0 + nu) * (1.0 - 2.0 * nu)));
  law.C.topLeftCorner<3, 3>().diagonal().array() += E / (1.0 + nu);
  law.C.diagonal().tail<3>().setConstant(0.5 * E / (1.0 + nu));
  Material material{law};
  material.expansion.setConstant(expansion);
  return material;
}

Material fibres() {
  Mat6 flexibility = Mat6::Zero();
  flexibility.topLeftCorner<3, 3>() << 1.0 / 140.0, -0.3 / 140.0, -0.25 / 140.0,  //
      -0.3 / 140.0, 1.0 / 10.0, -0.45 / 10.0,                                     //
      -0.25 / 140.0, -0.45 / 10.0, 1.0 / 9.0;
  flexibility.diagonal().tail<3>() << 1.0 / 3.0, 1.0 / 4.0, 1.0 / 5.0;
  Material material{StVenantKirchhoff{flexibility.inverse()}};
  material.expansion = {-0.1, 3.0, 2.5};
  return material;
}

Layup wall(std::vector<Layer> layers) { return {std::move(layers)}; }

std::vector<Layup> walls() {
  return {wall({{isotropic(2.0, 0.0), 0.4, 0.0}, {isotropic(2.0, 0.45), 0.6, 0.0}}),
          wall({{fibres(), 0.3, 0.0}, {fibres(), 0.5, 1.2}, {isotropic(7.0, 0.33), 0.1, 0.4}})};
}

// What strains in the plane (at the middle, and their gradients) and a thickness strain that is
// linear across the wall do to the energy, in the axes of the layup.
Eigen::Matrix<double, 8, 8> energy_form(const Layup& layup) {
  Eigen::Matrix<double, 8, 8> sum = Eigen::Matrix<double, 8, 8>::Zero();
  for (int l = 0; l < static_cast<int>(layup.layers.size()); ++l) {
    const Layer& layer = layup.layers[static_cast<std::size_t>(l)];
    const Mat6& C = std::get<StVenantKirchhoff>(layer.material.law).C;
    const double c = std::cos(layer.angle), s = std::sin(layer.angle);
    Eigen::Matrix<double, 6, 4> to_material = Eigen::Matrix<double, 6, 4>::Zero();
    to_material.row(0) << c * c, s * s, s * c, 0.0;
    to_material.row(1) << s * s, c * c, -s * c, 0.0;
    to_material.row(5) << -2.0 * s * c, 2.0 * s * c, c * c - s * s, 0.0;
    to_material(2, 3) = 1.0;
    for (const auto& [xi, weight] : gauss_legendre(2)) {
      const double zeta = layup.bottom(l) + 0.5 * layer.thickness * (1.0 + xi);
      Eigen::Matrix<double, 4, 8> strain;
      strain << Mat<4, 4>::Identity(), zeta * Mat<4, 4>::Identity();
      const Eigen::Matrix<double, 6, 8> B = to_material * strain;
      sum += 0.5 * layer.thickness * weight * B.transpose() * C * B;
    }
  }
  return sum;
}

// The form without the two thickness strains, which take what costs least.
Mat6 condensed(const Eigen::Matrix<double, 8, 8>& form) {
  constexpr std::array<int, 6> in_plane{0, 1, 2, 4, 5, 6};
  constexpr std::array<int, 2> across{3, 7};
  const Mat<2, 2> own = form(across, across);
  const Eigen::Matrix<double, 2, 6> coupling = form(across, in_plane);
  return Mat6(form(in_plane, in_plane)) - coupling.transpose() * own.inverse() * coupling;
}

TEST(ThicknessStrain, MakesWallsOfLinearThicknessAsSoftAsLayersFreeOfNormalStress) {
  for (const Layup& layup : walls()) {
    const Mat6 free = laminate_stiffness(layup);
    EXPECT_GT(relative_difference(condensed(energy_form(layup)), free), 1e-4);
    const Layup common = with_common_thickness_strain(layup);
    EXPECT_LT(relative_difference(condensed(energy_form(common)), free), 1e-13);
    EXPECT_LT(relative_difference(laminate_stiffness(common), free), 1e-13);
  }
}

TEST(ThicknessStrain, OfAStretchedWallIsTheSumOfThoseOfItsLayers) {
  const Vec3 stretch(0.3, -0.2, 0.5);
  for (const Layup& layup : walls()) {
    const auto form = energy_form(with_common_thickness_strain(layup));
    Eigen::Matrix<double, 8, 1> strain = Eigen::Matrix<double, 8, 1>::Zero();
    strain.head<3>() = stretch;
    constexpr std::array<int, 2> across{3, 7};
    const Mat<2, 2> own = form(across, across);
    const Vec<2> found = own.inverse() * Vec<2>((form * -strain)(across));
    double thinner = 0.0;
    for (const Layer& layer : layup.layers) {
      const Mat6& C = std::get<StVenantKirchhoff>(layer.material.law).C;
      const double c = std::cos(layer.angle), s = std::sin(layer.angle);
      const double e1 = c * c * stretch[0] + s * s * stretch[1] + s * c * stretch[2];
      const double e2 = stretch[0] + stretch[1] - e1;
      thinner -= layer.thickness * (C(0, 2) * e1 + C(1, 2) * e2) / C(2, 2);
    }
    EXPECT_NEAR(found[0], thinner / layup.thickness(), 1e-13);
    EXPECT_NEAR(found[1], 0.0, 1e-13);
  }
}

TEST(ThicknessStrain, OfAWallOfOneMaterialStaysWhatItIs) {
  const Layup layup = wall({{fibres(), 0.3, 0.7}, {fibres(), 0.2, 0.7}});
  const Layup common = with_common_thickness_strain(layup);
  EXPECT_EQ(small_strain_stiffness(common.layers[0].material.law),
            small_strain_stiffness(layup.layers[0].material.law));
}

// Layers that are held in their plane and warmed press on nothing across it, if they are free to
// grow there: the wall as a whole grows as its layers do one upon the other.
TEST(ThicknessStrain, OfAWarmWallIsTheSumOfThoseOfItsLayers) {
  const Layup layup = wall({{isotropic(2.0, 0.1, 1.0), 0.4, 0.0}, {fibres(), 0.6, 0.5}});
  const Layup common = with_common_thickness_strain(layup);
  double grown = 0.0;
  for (const Layer& layer : layup.layers) {
    const Mat6& C = small_strain_stiffness(layer.material.law);
    grown += layer.thickness * C.row(2).head<3>().dot(layer.material.expansion) / C(2, 2);
  }
  for (const Layer& layer : common.layers) {
    const Mat6& C = small_strain_stiffness(layer.material.law);
    EXPECT_NEAR(C.row(2).head<3>().dot(layer.material.expansion) / C(2, 2),
                grown / layup.thickness(), 1e-13);
  }
}

}  // namespace
}  // namespace culm::material
