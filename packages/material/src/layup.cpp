#include <culm/base/error.hpp>
#include <culm/material/layup.hpp>
#include <culm/material/thickness_strain.hpp>
#include <culm/math/quadrature.hpp>

#include "plane_turn.hpp"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <set>
#include <utility>

namespace culm::material {

namespace {

// The number of layers that the lists of a layup state; 1 if all are single values.
std::size_t stated_layers(const Options& layup) {
  if (layup.has("Materials")) return layup.texts("Materials").size();
  if (layup.has("Thicknesses")) return layup.numbers("Thicknesses").size();
  return layup.numbers("Angles").size();
}

// Walls have some hundred layers at most; more is a slip, and would fill the memory.
constexpr double most_layers = 100'000;

void check_number_of_layers(const Options& layup, InputIssues& issues) {
  const double mirrored = layup.text("Symmetric") == "None" ? 1.0 : 2.0;
  const double layers =
      mirrored * layup.integer("Repeat") * static_cast<double>(stated_layers(layup));
  if (layers <= most_layers) return;
  issues.add(
      layup.where("Repeat"),
      fmt::format("makes {:.10g} layers, at most {:.10g} are possible", layers, most_layers));
}

void check_lists(const Options& layup, InputIssues& issues) {
  const auto check_choice = [&](const char* one, const char* many) {
    if (layup.has(one) == layup.has(many)) {
      issues.add(layup.where(), fmt::format("give one of '{}' and '{}'", one, many));
      return false;
    }
    return true;
  };
  if (!check_choice("Material", "Materials") || !check_choice("Thickness", "Thicknesses")) return;
  const std::size_t layers = stated_layers(layup);
  const auto check_size = [&](const char* name, std::size_t size) {
    if (size == layers) return;
    issues.add(layup.where(name),
               fmt::format("must have one item per layer, {} as stated by the list before, got {}",
                           layers, size));
  };
  if (layup.has("Thicknesses")) check_size("Thicknesses", layup.numbers("Thicknesses").size());
  if (layup.given("Angles")) check_size("Angles", layup.numbers("Angles").size());
  check_number_of_layers(layup, issues);
}

// The lists as written, mirrored and repeated.
std::vector<Layer> stack(std::vector<Layer> layers, int repeat, const std::string& symmetry) {
  const std::vector<Layer> once = layers;
  for (int i = 1; i < repeat; ++i) layers.insert(layers.end(), once.begin(), once.end());
  if (symmetry == "None") return layers;
  std::vector<Layer> mirrored = layers;
  if (symmetry == "Middle Layer") mirrored.pop_back();
  std::reverse(mirrored.begin(), mirrored.end());
  layers.insert(layers.end(), mirrored.begin(), mirrored.end());
  return layers;
}

Mat6& modulus(Layer& layer) { return std::get<StVenantKirchhoff>(layer.material.law).C; }
const Mat6& modulus(const Layer& layer) {
  return std::get<StVenantKirchhoff>(layer.material.law).C;
}

// Stiffness in the plane, free of stress across the thickness, in axes turned back by an angle from
// those of the material; order 11, 22, 12 with engineering shear.
Mat3 plane_stiffness(const Mat6& C, double angle) {
  constexpr std::array<int, 3> plane{0, 1, 5};
  Mat3 Q;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      const int k = plane[i];
      const int l = plane[j];
      Q(static_cast<int>(i), static_cast<int>(j)) = C(k, l) - C(k, 2) * C(2, l) / C(2, 2);
    }
  }
  const Mat3 T = plane_turn(angle);
  return T.transpose() * Q * T;
}

// Stress along axis 1 or 2 of the layup under a strain along it alone.
double axial_modulus(const Layer& layer, int axis) {
  return plane_stiffness(modulus(layer), layer.angle)(axis, axis);
}

// Transverse shear stiffness along axes 1, 2 of the layup.
Mat<2, 2> transverse_shear(const Layer& layer) {
  const Mat6& C = modulus(layer);
  const Mat<2, 2> G = (Mat<2, 2>() << C(4, 4), C(4, 3), C(3, 4), C(3, 3)).finished();
  const Eigen::Rotation2Dd turn(layer.angle);
  return turn.toRotationMatrix() * G * turn.toRotationMatrix().transpose();
}

double shear_factor(const Layup& layup, int axis) {
  struct Ply {
    double below, above, E, G;
  };
  std::vector<Ply> plies;
  double stretch = 0.0;  // integrals of E, E z, G
  double moment = 0.0;
  double shear = 0.0;
  double z = -0.5 * layup.thickness();
  for (const Layer& layer : layup.layers) {
    const double above = z + layer.thickness;
    plies.push_back({z, above, axial_modulus(layer, axis), transverse_shear(layer)(axis, axis)});
    stretch += plies.back().E * layer.thickness;
    moment += 0.5 * plies.back().E * (above * above - z * z);
    shear += plies.back().G * layer.thickness;
    z = above;
  }
  const double neutral = moment / stretch;
  double bending = 0.0;
  double flexibility = 0.0;
  double first_moment = 0.0;  // g at the lower side of the ply
  for (const Ply& ply : plies) {
    const double half = 0.5 * (ply.above - ply.below);
    const double low = ply.below - neutral;
    // g is quadratic in z
    for (const QuadraturePoint& point : gauss_legendre(3)) {
      const double at = low + half * (1.0 + point.xi);
      const double g = first_moment + 0.5 * ply.E * (at * at - low * low);
      bending += half * point.weight * ply.E * at * at;
      flexibility += half * point.weight * g * g / ply.G;
    }
    const double high = ply.above - neutral;
    first_moment += 0.5 * ply.E * (high * high - low * low);
  }
  return bending * bending / (shear * flexibility);
}

}  // namespace

Mat6 laminate_stiffness(const Layup& layup) {
  Mat6 stiffness = Mat6::Zero();
  double z = -0.5 * layup.thickness();
  for (const Layer& layer : layup.layers) {
    const double above = z + layer.thickness;
    const Mat3 Q = plane_stiffness(small_strain_stiffness(layer.material.law), layer.angle);
    const Mat3 coupling = 0.5 * (above * above - z * z) * Q;
    stiffness.topLeftCorner<3, 3>() += layer.thickness * Q;
    stiffness.topRightCorner<3, 3>() += coupling;
    stiffness.bottomLeftCorner<3, 3>() += coupling;
    stiffness.bottomRightCorner<3, 3>() += (above * above * above - z * z * z) / 3.0 * Q;
    z = above;
  }
  return stiffness;
}

Vec<2> shear_factors(const Layup& layup) {
  return {shear_factor(layup, 0), shear_factor(layup, 1)};
}

Layup with_shear_factors(Layup layup, const Vec<2>& factors) {
  for (Layer& layer : layup.layers) {
    // as roots on both sides, turned to the axes of the layer, so that it stays symmetric
    const Eigen::Rotation2Dd turn(-layer.angle);
    const Mat<2, 2> root = turn.toRotationMatrix() * Mat<2, 2>(factors.cwiseSqrt().asDiagonal()) *
                           turn.toRotationMatrix().transpose();
    Mat6 scale = Mat6::Identity();  // components 23, 13 are along axes 2, 1
    scale.block<2, 2>(3, 3) << root(1, 1), root(1, 0), root(0, 1), root(0, 0);
    modulus(layer) = scale * modulus(layer) * scale;
  }
  return layup;
}

double Layup::thickness() const {
  double sum = 0.0;
  for (const Layer& layer : layers) sum += layer.thickness;
  return sum;
}

double Layup::bottom(int layer) const {
  double zeta = -0.5 * thickness();
  for (int l = 0; l < layer; ++l) zeta += layers[static_cast<std::size_t>(l)].thickness;
  return zeta;
}

std::vector<double> Layup::relaxation_times() const {
  std::set<double> times;
  for (const Layer& layer : layers) {
    for (const MaxwellBranch& branch : layer.material.relaxation) times.insert(branch.time);
  }
  return {times.begin(), times.end()};
}

bool Layup::is_linear() const {
  return std::all_of(layers.begin(), layers.end(),
                     [](const Layer& layer) { return layer.material.is_linear(); });
}

Layup single_layer(Material material, double thickness) {
  return {{Layer{std::move(material), thickness, 0.0}}};
}

Schema layup_schema() {
  Schema schema("Layup",
                "The wall of a shell: layers from the bottom upward, the normal pointing "
                "from bottom to top.");
  schema.add(text("Material", "Material of all layers, by its name in Materials.").optional())
      .add(texts("Materials", "Materials of the layers, by their names in Materials.")
               .min_size(1)
               .optional())
      .add(number("Thickness", "m", "Thickness of each layer.").positive().optional())
      .add(numbers("Thicknesses", "m", "Thicknesses of the layers.")
               .positive()
               .min_size(1)
               .optional())
      .add(numbers("Angles", "rad",
                   "Angles of the fibres of the layers from the reference axis, about the normal.")
               .min_size(1)
               .optional({0.0}))
      .add(
          integer("Repeat", "How many times the layers above are stacked.").at_least(1).optional(1))
      .add(choice("Symmetric", {"None", "All Layers", "Middle Layer"},
                  "Whether the layers are mirrored upward: all of them, [a b b a], or with the "
                  "last one in the middle, [a b a].")
               .optional("None"))
      .add(choice("Shear Correction", {"None", "Equilibrium"},
                  "Factors on the transverse shear stiffness along axes 1 and 2: none, or those by "
                  "which a straight director stores the energy of the shear stresses of "
                  "cylindrical bending; 5/6 for a uniform wall.")
               .optional("None"))
      .check(check_lists);
  return schema;
}

Layup read_layup(const Options& options, const std::map<std::string, Material>& materials) {
  const std::string field = options.has("Material") ? "Material" : "Materials";
  const auto find = [&](const std::string& name) {
    const auto found = materials.find(name);
    if (found == materials.end()) {
      std::vector<std::string> known;
      for (const auto& [one, material] : materials) known.push_back(one);
      throw InputError(options.where(field),
                       "unknown material '" + name + "'" + did_you_mean(name, known));
    }
    return found->second;
  };
  const std::vector<double>& angles = options.numbers("Angles");
  std::vector<Layer> layers;
  for (std::size_t l = 0; l < stated_layers(options); ++l) {
    const std::string& name =
        options.has("Material") ? options.text("Material") : options.texts("Materials")[l];
    const double thickness =
        options.has("Thickness") ? options.number("Thickness") : options.numbers("Thicknesses")[l];
    layers.push_back({find(name), thickness, angles.size() == 1 ? angles[0] : angles[l]});
  }
  for (const Layer& layer : layers) {
    if (layer.material.dissipation != layers[0].material.dissipation ||
        layer.material.damping != layers[0].material.damping) {
      throw InputError(options.where(field),
                       "the materials of one layup must have the same Dissipation and Damping");
    }
  }
  Layup layup{stack(std::move(layers), options.integer("Repeat"), options.text("Symmetric"))};
  if (layup.is_linear()) layup = with_common_thickness_strain(std::move(layup));
  if (options.text("Shear Correction") == "None") return layup;
  if (!layup.is_linear()) {
    throw InputError(options.where("Shear Correction"),
                     "belongs to layers whose stress is proportional to strain");
  }
  const Vec<2> factors = shear_factors(layup);
  return with_shear_factors(std::move(layup), factors);
}

}  // namespace culm::material
