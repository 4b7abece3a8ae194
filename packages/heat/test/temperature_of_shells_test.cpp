#include <culm/material/isotropic.hpp>
#include <culm/material/neo_hooke.hpp>
#include <culm/material/orthotropic.hpp>
#include <culm/model/layer_source.hpp>
#include <culm/shell/shell_structure.hpp>

#include "heat_case.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace culm::heat {
namespace {

using kit::GivenValues;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using Numbers = std::vector<double>;
using Texts = std::vector<std::string>;

constexpr double expansion_of_steel = 0.1;

std::map<std::string, material::Material> materials() {
  std::map<std::string, material::Material> all;
  material::Material steel{material::IsotropicMaterial::law(3.0, 0.3), 1.0};
  steel.expansion.setConstant(expansion_of_steel);
  material::Material ply{
      material::OrthotropicMaterial::law({5.0, 1.0, 1.2, 0.25, 0.2, 0.3, 0.5, 0.6, 0.4}), 1.0};
  ply.expansion = Vec3(0.02, 0.3, 0.25);
  material::Material oak = steel;
  oak.expansion.setZero();
  all.emplace("steel", steel);
  all.emplace("ply", ply);
  all.emplace("oak", oak);
  all.emplace("rubber", material::Material{material::NeoHooke::from_moduli(1.0, 0.4)});
  return all;
}

const GivenValues single{{"Material", std::string("steel")}, {"Thickness", 0.1}};
const GivenValues layered{{"Materials", Texts{"steel", "ply", "ply"}},
                          {"Thicknesses", Numbers{0.03, 0.02, 0.05}},
                          {"Angles", Numbers{0.0, 0.5, -0.4}}};

void add_shell(model::Model& model, const GivenValues& values) {
  const std::map<std::string, material::Section> sections;
  const auto known = materials();
  InputIssues issues;
  std::ostringstream printed;
  Log log{printed, LogLevel::info};
  structure::StructureRegistry registry;
  shell::register_shells(registry);
  const Schema schema = registry.variants().at("Shell");
  Options options = kit::deck_list(schema, values, "roof");
  Options mesh = kit::deck_list(*schema.find_slot("Mesh")->find("Plane"),
                                {{"Side 1", Numbers{1.0, 0.1, 0}},
                                 {"Side 2", Numbers{0.2, 0.7, 0}},
                                 {"Elements", std::vector<int>{2, 1}}},
                                "Mesh");
  mesh.set("Type", std::string("Plane"));
  options.add_list(mesh);
  structure::StructureContext context{model, sections, known, issues, log};
  registry.make("Shell", options, context);
}

const GivenValues sun_on_roof = sun_on("roof", {6.0});

GivenValues linear(GivenValues values) {
  values.emplace_back("Fidelity", std::string("Linear"));
  return values;
}

Warmed warmed_shell(const GivenValues& values, const std::string& elements) {
  const auto fill = [values](model::Model& model) {
    add_shell(model, values);
    EXPECT_THAT(add_heat(model, sun_on_roof), IsEmpty());
  };
  return {fill, elements};
}
const std::vector<Warmed> warmed_shells = {warmed_shell(layered, "Shell"),
                                           warmed_shell(linear(layered), "Shell, linear")};

TEST(TemperatureOfShells, TangentIsDerivativeOfResidual) {
  for (const Warmed& shell : warmed_shells) kit::expect_tangent_is_derivative(shell.fill, effect);
}
TEST(TemperatureOfShells, NullSpaceResidualIsProjected) {
  for (const Warmed& shell : warmed_shells) kit::expect_residual_is_projected(shell.fill, effect);
}
TEST(TemperatureOfShells, AssemblesWithoutHeap) {
  for (const Warmed& shell : warmed_shells) kit::expect_no_allocation(shell.fill, effect);
}
TEST(TemperatureOfShells, AttemptsLeaveNoTrace) {
  for (const Warmed& shell : warmed_shells) kit::expect_attempts_leave_no_trace(shell.fill, effect);
}
TEST(TemperatureOfShells, EnergyBalanceIsExact) {
  for (const Warmed& shell : warmed_shells)
    expect_energy_balance(shell.fill, shell.elements, effect);
}

// A wall of one material that grows alike in all directions, to the Green-Lagrange strain of its
// temperature, has neither stress nor energy.
TEST(TemperatureOfShells, FreeGrowthIsFreeOfStress) {
  model::Model model;
  add_shell(model, single);
  ASSERT_THAT(add_heat(model, {{"Structure", std::string("roof")},
                               {"Value", 0.8},
                               {"Function", std::string("day")}}),
              IsEmpty());
  model.freeze(model::Form::multipliers);
  model::State state = model.initial_state();
  state.time = state.time_prev = 0.5;
  const double held = std::sqrt(1.0 + 2.0 * expansion_of_steel * 0.8 * 1.25);
  for (double& coordinate : state.next) coordinate *= held;
  kit::DenseAssembly dense(model);
  dense.prepare(state, Stencil::statics());
  const std::vector<model::Batch*> batches{kit::find_batch(model, "Shell"),
                                           kit::find_batch(model, effect)};
  const double stiff = kit::largest(dense.residual(state, Stencil::statics(), {batches[0]}));
  EXPECT_LT(kit::largest(dense.residual(state, Stencil::statics(), batches)), 1e-13 * stiff);
  const double energy = batches[0]->stored_energy(state.next);
  EXPECT_NEAR(energy + batches[1]->stored_energy(state.next), 0.0, 1e-13 * energy);
  const model::Structure& roof = *model.find_structure("roof");
  std::vector<double> resultants;
  roof.cells[1].source->resultants(roof.cells[1].item, state.next, resultants);
  for (double resultant : resultants) EXPECT_NEAR(resultant, 0.0, 1e-14);
  for (const model::LayerState& layer : roof.layers->states(1, state.next)) {
    EXPECT_LT(layer.stress.norm(), 1e-14);
    EXPECT_LT((layer.strain.head<3>() - Vec3::Constant(0.1)).norm(), 1e-14);
  }
}

// Resultants of a heated wall are the integrals of the stresses that its layers show, of second
// degree across a layer.
TEST(TemperatureOfShells, ResultantsAreIntegralsOfLayers) {
  model::Model model;
  const Numbers thicknesses{0.04, 0.06};
  add_shell(model, {{"Materials", Texts{"oak", "steel"}}, {"Thicknesses", thicknesses}});
  ASSERT_THAT(add_heat(model, sun_on_roof), IsEmpty());
  model.freeze(model::Form::null_space);
  const model::State state = kit::random_state(model, 5);
  kit::DenseAssembly dense(model);
  dense.prepare(state, Stencil::statics());
  const model::Structure& roof = *model.find_structure("roof");
  std::vector<double> resultants;
  roof.cells[0].source->resultants(roof.cells[0].item, state.next, resultants);
  const auto states = roof.layers->states(0, state.next);
  double force = 0.0;
  double moment = 0.0;
  double bottom = -0.05;
  for (std::size_t layer = 0; layer < 2; ++layer) {
    const double t = thicknesses[layer];
    const auto S = [&](std::size_t k) { return states[3 * layer + k].stress[0]; };
    force += t / 6.0 * (S(0) + 4.0 * S(1) + S(2));
    moment += t / 6.0 * (bottom * S(0) + 4.0 * (bottom + 0.5 * t) * S(1) + (bottom + t) * S(2));
    bottom += t;
  }
  EXPECT_NEAR(resultants[0], force, 1e-13);
  EXPECT_NEAR(resultants[3], moment, 1e-13);
}

TEST(TemperatureOfShells, MistakesAreNamed) {
  const auto message = [](const GivenValues& shell, const GivenValues& heat) {
    model::Model model;
    add_shell(model, shell);
    return add_heat(model, heat);
  };
  const GivenValues oak{{"Material", std::string("oak")}, {"Thickness", 0.1}};
  const GivenValues rubber{{"Material", std::string("rubber")}, {"Thickness", 0.1}};
  EXPECT_THAT(message(oak, sun_on_roof),
              ElementsAre(HasSubstr("its materials need an 'Expansion'")));
  EXPECT_THAT(message(rubber, sun_on_roof), ElementsAre(HasSubstr("for large strains")));
  GivenValues two{{"Structure", std::string("roof")}, {"Gradient", Numbers{1.0, 2.0}}};
  EXPECT_THAT(message(single, two),
              ElementsAre(HasSubstr("must have 1 value for the shell 'roof'")));
}

}  // namespace
}  // namespace culm::heat
