#include <culm/material/thickness_strain.hpp>

#include "plane_turn.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace culm::material {
namespace {

constexpr std::array<int, 3> plane{0, 1, 5};  // 11, 22, 12 in Voigt order

// Strain across the thickness that a layer does without, in the axes of the material.
struct Across {
  Vec3 n = Vec3::Zero();   // by the strains in the plane
  double c = 0.0;          // [N/m^2]
  double expansion = 0.0;  // by a warming, where the plane is held [1/K]
};

Vec3 plane_expansion(const Material& material) {
  return {material.expansion[0], material.expansion[1], 0.0};
}

Across across(const Material& material) {
  const Mat6& C = std::get<StVenantKirchhoff>(material.law).C;
  Across result;
  result.c = C(2, 2);
  for (int i = 0; i < 3; ++i) result.n[i] = C(plane[static_cast<std::size_t>(i)], 2) / C(2, 2);
  result.expansion = material.expansion[2] + result.n.dot(plane_expansion(material));
  return result;
}

void take(const Across& common, const Across& own, Material& material) {
  Mat6& C = std::get<StVenantKirchhoff>(material.law).C;
  for (int i = 0; i < 3; ++i) {
    const int row = plane[static_cast<std::size_t>(i)];
    for (int j = 0; j < 3; ++j) {
      const int column = plane[static_cast<std::size_t>(j)];
      C(row, column) += common.c * common.n[i] * common.n[j] - own.c * own.n[i] * own.n[j];
    }
    C(row, 2) = C(2, row) = common.c * common.n[i];
  }
  C(2, 2) = common.c;
  material.expansion[2] = common.expansion - common.n.dot(plane_expansion(material));
}

bool are_alike(const Across& a, const Across& b) {
  constexpr double rounding = 1e-12;
  return (a.n - b.n).cwiseAbs().maxCoeff() < rounding &&
         std::abs(a.c - b.c) < rounding * (a.c + b.c) &&
         std::abs(a.expansion - b.expansion) <=
             rounding * (std::abs(a.expansion) + std::abs(b.expansion));
}

}  // namespace

Layup with_common_thickness_strain(Layup layup) {
  std::vector<Across> own;
  for (const Layer& layer : layup.layers) {
    own.push_back(across(layer.material));
    own.back().n = plane_turn(layer.angle).transpose() * own.back().n;  // in the axes of the layup
  }
  const Across& first = own.front();
  if (std::ranges::all_of(own, [&](const Across& one) { return are_alike(one, first); })) {
    return layup;
  }
  Across common;
  double flexibility = 0.0;
  for (std::size_t l = 0; l < own.size(); ++l) {
    const double share = layup.layers[l].thickness / layup.thickness();
    common.n += share * own[l].n;
    common.expansion += share * own[l].expansion;
    flexibility += share / own[l].c;
  }
  common.c = 1.0 / flexibility;
  for (Layer& layer : layup.layers) {
    Across here = common;
    here.n = plane_turn(-layer.angle).transpose() * common.n;
    take(here, across(layer.material), layer.material);
  }
  return layup;
}

}  // namespace culm::material
