#include <culm/base/error.hpp>
#include <culm/material/isotropic.hpp>
#include <culm/material/layup.hpp>
#include <culm/material/orthotropic.hpp>
#include <culm/material/register_material.hpp>

#include <Eigen/Dense>
#include <culm_kit/deck_list.hpp>
#include <culm_kit/finite_difference.hpp>
#include <culm_kit/rigid_motion.hpp>
#include <gtest/gtest.h>

#include <cmath>

namespace culm::material {
namespace {

using kit::deck_list;
using kit::mistakes_in;
using Messages = std::vector<std::string>;

Vec6 some_strain(int seed, double size) { return size * kit::Random(seed).matrix<6, 1>(); }

TEST(Materials, AreRegisteredByName) {
  Registry<Material> registry;
  register_materials(registry);
  EXPECT_EQ(registry.names(), (Messages{"Isotropic", "Neo-Hooke", "Orthotropic"}));
}

TEST(IsotropicMaterial, ComplianceHasTheModuli) {
  const Mat6 S = IsotropicMaterial::law(210.0, 0.3).C.inverse();
  EXPECT_NEAR(S(0, 0), 1.0 / 210.0, 1e-17);
  EXPECT_NEAR(S(0, 1), -0.3 / 210.0, 1e-17);
  EXPECT_NEAR(S(5, 5), 2.6 / 210.0, 1e-17);
}

TEST(IsotropicMaterial, IsOrthotropicWithEqualConstants) {
  const double G = 210.0 / 2.6;
  const Mat6 C = OrthotropicMaterial::law({210.0, 210.0, 210.0, 0.3, 0.3, 0.3, G, G, G}).C;
  EXPECT_LT(kit::relative_difference(C, IsotropicMaterial::law(210.0, 0.3).C), 1e-14);
}

TEST(ShearFactors, AreFiveSixthsOfAUniformWall) {
  const Material steel{IsotropicMaterial::law(210.0, 0.3)};
  EXPECT_LT((shear_factors(single_layer(steel, 0.1)) - Vec<2>(5.0 / 6.0, 5.0 / 6.0)).norm(), 1e-14);
  const Layup two{{{steel, 0.03, 0.4}, {steel, 0.07, -1.2}}};
  EXPECT_LT((shear_factors(two) - Vec<2>(5.0 / 6.0, 5.0 / 6.0)).norm(), 1e-14);
}

// Thin faces: the core alone carries the shear, by a stress that is nearly constant.
TEST(ShearFactors, OfASandwichLeaveItToTheCore) {
  const Material face{IsotropicMaterial::law(70000.0, 0.3)};
  const Material core{IsotropicMaterial::law(50.0, 0.3)};
  const Layup sandwich{{{face, 0.5, 0.0}, {core, 20.0, 0.0}, {face, 0.5, 0.0}}};
  const double G = 50.0 / 2.6;
  const double whole = G * 20.0 + 70000.0 / 2.6;
  // G (core + face)^2 / core, Allen, Analysis and Design of Structural Sandwich Panels (1969)
  const double wanted = G * 20.5 * 20.5 / 20.0 / whole;
  EXPECT_NEAR(shear_factors(sandwich)[0] / wanted, 1.0, 0.01);
}

TEST(ShearFactors, ScaleTheStiffnessAlongTheAxesOfTheLayup) {
  const OrthotropicConstants c{100.0, 10.0, 12.0, 0.3, 0.25, 0.4, 5.0, 4.0, 3.0};
  const Material ply{OrthotropicMaterial::law(c)};
  const double right = std::acos(0.0);
  const Layup layup{{{ply, 0.1, 0.0}, {ply, 0.1, right}}};
  const Layup scaled = with_shear_factors(layup, {0.5, 0.8});
  const auto C = [&](std::size_t layer) {
    return std::get<StVenantKirchhoff>(scaled.layers[layer].material.law).C;
  };
  EXPECT_NEAR(C(0)(4, 4), 0.5 * 4.0, 1e-14);  // G13 along axis 1
  EXPECT_NEAR(C(0)(3, 3), 0.8 * 3.0, 1e-14);
  EXPECT_NEAR(C(1)(4, 4), 0.8 * 4.0, 1e-14);  // of the turned layer along axis 2
  EXPECT_NEAR(C(1)(3, 3), 0.5 * 3.0, 1e-14);
  EXPECT_NEAR(C(1)(3, 4), 0.0, 1e-14);
  EXPECT_NEAR(C(1)(0, 0), std::get<StVenantKirchhoff>(ply.law).C(0, 0), 1e-14);
}

TEST(OrthotropicMaterial, TensionAlongAFibreContractsAcrossIt) {
  const OrthotropicConstants c{100.0, 10.0, 12.0, 0.3, 0.25, 0.4, 5.0, 4.0, 3.0};
  EXPECT_TRUE(OrthotropicMaterial::mistakes(c).empty());
  const Vec6 strain = OrthotropicMaterial::law(c).C.inverse() * Vec6::Unit(0);
  EXPECT_NEAR(strain[0], 0.01, 1e-16);
  EXPECT_NEAR(strain[1], -0.003, 1e-16);
  EXPECT_NEAR(strain[2], -0.0025, 1e-16);
  const Mat6 C = OrthotropicMaterial::law(c).C;
  EXPECT_EQ((Vec3(C(3, 3), C(4, 4), C(5, 5))), Vec3(3.0, 4.0, 5.0));  // G23, G13, G12
}

TEST(OrthotropicMaterial, RefusesConstantsOfNoSolid) {
  const auto read = [](double nu12, double nu13, double nu23) {
    const Schema schema = OrthotropicMaterial::schema();
    return mistakes_in(schema, deck_list(schema, {{"E1", 10.0},
                                                  {"E2", 10.0},
                                                  {"E3", 10.0},
                                                  {"nu12", nu12},
                                                  {"nu13", nu13},
                                                  {"nu23", nu23},
                                                  {"G12", 1.0},
                                                  {"G13", 1.0},
                                                  {"G23", 1.0}}));
  };
  EXPECT_TRUE(read(0.3, 0.3, 0.3).empty());
  EXPECT_EQ(read(1.5, 0.0, 0.0),
            Messages{"nu12 = 1.5 is too large: nu12^2 E2/E1 must be < 1, is 2.25"});
  EXPECT_EQ(read(0.9, 0.9, 0.9),
            Messages{"the three Poisson ratios do not fit together: the stiffness would not be "
                     "positive definite (scaled determinant of the compliance -2.888)"});
}

TEST(NeoHooke, StressIsTheDerivativeOfTheEnergy) {
  const NeoHooke law = NeoHooke::from_moduli(2.0, 0.3);
  for (int seed : {1, 2, 3}) {
    const Vec6 E = some_strain(seed, 0.15);
    Vec6 S;
    Mat6 D;
    ASSERT_EQ(law.respond(E, S, D), Verdict::ok);
    const auto dW =
        kit::central_difference<1, 6>([&](const Vec6& at) { return Vec<1>(law.energy(at)); }, E);
    EXPECT_LT(kit::relative_difference(dW.transpose(), S), 2e-9);
    const auto dS = kit::central_difference<6, 6>(
        [&](const Vec6& at) {
          Vec6 stress;
          Mat6 ignored;
          law.respond(at, stress, ignored);
          return stress;
        },
        E);
    EXPECT_LT(kit::relative_difference(dS, D), 2e-9);
  }
}

TEST(NeoHooke, IsIsotropicAtSmallStrains) {
  const NeoHooke law = NeoHooke::from_moduli(2.0, 0.3);
  EXPECT_LT(
      kit::relative_difference(law.small_strain_stiffness(), IsotropicMaterial::law(2.0, 0.3).C),
      1e-15);
  // the energy keeps its digits however small the strain is: W / (1/2 E C E) = 1 + O(E)
  for (double size : {1e-3, 1e-6, 1e-9, 1e-12}) {
    const Vec6 E = some_strain(4, size);
    const double ratio = law.energy(E) / (0.5 * E.dot(law.small_strain_stiffness() * E));
    EXPECT_NEAR(ratio, 1.0, 10.0 * size + 1e-14) << size;
  }
  // and does not jump where the series ends: det C - 1 = 2 E11 = 0.01
  const auto at = [&](double e) { return law.energy(e * Vec6::Unit(0)); };
  EXPECT_NEAR(at(0.005 * (1.0 + 1e-14)) / at(0.005 * (1.0 - 1e-14)), 1.0, 1e-13);
}

TEST(NeoHooke, HasNoAnswerForACollapsedSolid) {
  const NeoHooke law = NeoHooke::from_moduli(2.0, 0.3);
  Vec6 S;
  Mat6 D;
  const Vec6 flat = -0.6 * Vec6::Unit(2);
  EXPECT_EQ(law.respond(flat, S, D), Verdict::law_out_of_range);
  EXPECT_TRUE(S.allFinite() && D.allFinite());
  EXPECT_TRUE(std::isnan(law.energy(flat)));
}

class LayupFields : public testing::Test {
 protected:
  const Schema schema = layup_schema();
  const std::map<std::string, Material> materials{
      {"face", {IsotropicMaterial::law(1.0, 0.1), 2.0}},
      {"core", {IsotropicMaterial::law(3.0, 0.2), 4.0}},
      {"damped", {IsotropicMaterial::law(3.0, 0.2), 4.0, 0.5}}};

  Layup read(const kit::GivenValues& given) const {
    const Options options = deck_list(schema, given);
    EXPECT_EQ(mistakes_in(schema, options), Messages{});
    return read_layup(options, materials);
  }
  Messages mistakes(const kit::GivenValues& given) const {
    return mistakes_in(schema, deck_list(schema, given));
  }
};

std::vector<double> angles(const Layup& layup) {
  std::vector<double> result;
  for (const Layer& layer : layup.layers) result.push_back(layer.angle);
  return result;
}

TEST_F(LayupFields, OneLayer) {
  const Layup layup = read({{"Material", "face"}, {"Thickness", 0.2}});
  ASSERT_EQ(layup.layers.size(), 1u);
  EXPECT_EQ(layup.thickness(), 0.2);
  EXPECT_EQ(layup.bottom(0), -0.1);
}

TEST_F(LayupFields, StackFromTheBottom) {
  const Layup layup = read({{"Materials", std::vector<std::string>{"face", "core", "face"}},
                            {"Thicknesses", std::vector{0.1, 0.5, 0.2}}});
  EXPECT_EQ(layup.layers[1].material.density, 4.0);
  EXPECT_NEAR(layup.thickness(), 0.8, 1e-15);
  EXPECT_NEAR(layup.bottom(1), -0.3, 1e-15);
  EXPECT_NEAR(layup.bottom(3), 0.4, 1e-15);
  EXPECT_TRUE(layup.is_linear());
}

TEST_F(LayupFields, SymmetricShorthand) {
  const kit::GivenValues base{
      {"Material", "face"}, {"Thickness", 0.1}, {"Angles", std::vector{0.0, 1.0}}};
  auto given = base;
  given.emplace_back("Symmetric", "All Layers");
  EXPECT_EQ(angles(read(given)), (std::vector{0.0, 1.0, 1.0, 0.0}));
  given.back() = {"Symmetric", "Middle Layer"};
  EXPECT_EQ(angles(read(given)), (std::vector{0.0, 1.0, 0.0}));
  given.emplace_back("Repeat", 2);
  EXPECT_EQ(angles(read(given)), (std::vector{0.0, 1.0, 0.0, 1.0, 0.0, 1.0, 0.0}));
}

TEST_F(LayupFields, ListsHaveOneItemPerLayer) {
  EXPECT_EQ(mistakes({{"Thickness", 0.1}}), Messages{"give one of 'Material' and 'Materials'"});
  EXPECT_EQ(mistakes({{"Material", "face"}, {"Thickness", 0.1}, {"Thicknesses", std::vector{0.1}}}),
            Messages{"give one of 'Thickness' and 'Thicknesses'"});
  EXPECT_EQ(mistakes({{"Materials", std::vector<std::string>{"face", "core"}},
                      {"Thicknesses", std::vector{0.1, 0.2, 0.3}}}),
            Messages{"must have one item per layer, 2 as stated by the list before, got 3"});
}

TEST_F(LayupFields, MaterialsAreKnownAndGoTogether) {
  EXPECT_THROW(read({{"Material", "fase"}, {"Thickness", 0.1}}), InputError);
  EXPECT_THROW(
      read({{"Materials", std::vector<std::string>{"core", "damped"}}, {"Thickness", 0.1}}),
      InputError);
}

}  // namespace
}  // namespace culm::material
