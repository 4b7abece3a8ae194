#include <culm/beam/beam_structure.hpp>

#include "heat_case.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace culm::heat {
namespace {

using kit::GivenValues;
using testing::ElementsAre;
using testing::HasSubstr;
using Numbers = std::vector<double>;

constexpr double expansion_of_beam = 0.3;

// A fully coupled section.
material::Section section(double of_expansion = expansion_of_beam) {
  material::Section section;
  section.stiffness = kit::Random(1).positive_matrix<6>();
  section.mass = kit::Random(2).positive_matrix<3>();
  section.expansion = of_expansion;
  return section;
}

void add_beam(model::Model& model, const GivenValues& values,
              double of_expansion = expansion_of_beam) {
  std::map<std::string, material::Section> sections{{"bar", section(of_expansion)}};
  std::map<std::string, material::Material> materials;
  InputIssues issues;
  std::ostringstream messages;
  Log log{messages, LogLevel::info};
  structure::StructureContext context{model, sections, materials, issues, log};
  const Schema schema = beam::beam_schema();
  GivenValues all{{"Section", std::string("bar")}};
  for (const auto& one : values) all.push_back(one);
  Options options = kit::deck_list(schema, all, "bridge");
  Options line = kit::deck_list(
      *schema.find_slot("Curve")->find("Line"),
      {{"From", Numbers{0, 0, 0}}, {"To", Numbers{0, 0, 1.5}}, {"Elements", 2}}, "Curve");
  line.set("Type", std::string("Line"));
  options.add_list(line);
  beam::add_beam(options, context);
}

const GivenValues sun_on_bridge = sun_on("bridge", {0.4, -0.7});

Warmed warmed_beam(const GivenValues& values, const std::string& elements) {
  const auto fill = [values](model::Model& model) {
    add_beam(model, values);
    EXPECT_THAT(add_heat(model, sun_on_bridge), testing::IsEmpty());
  };
  return {fill, elements};
}
const std::vector<Warmed> warmed_beams = {
    warmed_beam({{"Order", 1}}, "Beam, director, order 1"),
    warmed_beam({{"Order", 2}}, "Beam, director, order 2"),
    warmed_beam({{"Order", 2}, {"Fidelity", std::string("Linear")}}, "Beam, linear, order 2"),
    warmed_beam({{"Order", 2}, {"Torsion", false}}, ""),
};

TEST(TemperatureOfBeams, TangentIsDerivativeOfResidual) {
  for (const Warmed& beam : warmed_beams) kit::expect_tangent_is_derivative(beam.fill, effect);
}
TEST(TemperatureOfBeams, NullSpaceResidualIsProjected) {
  for (const Warmed& beam : warmed_beams) kit::expect_residual_is_projected(beam.fill, effect);
}
TEST(TemperatureOfBeams, AssemblesWithoutHeap) {
  for (const Warmed& beam : warmed_beams) kit::expect_no_allocation(beam.fill, effect);
}
TEST(TemperatureOfBeams, AttemptsLeaveNoTrace) {
  for (const Warmed& beam : warmed_beams) kit::expect_attempts_leave_no_trace(beam.fill, effect);
}

TEST(TemperatureOfBeams, EnergyBalanceIsExact) {
  for (const Warmed& beam : warmed_beams) {
    if (!beam.elements.empty()) expect_energy_balance(beam.fill, beam.elements, effect);
  }
}

// Held at its length and straight, a beam has the stresses of the free strains, reversed.
TEST(TemperatureOfBeams, ResultantsAreThoseOfStrainLessFreeStrain) {
  model::Model model;
  add_beam(model, {{"Order", 2}});
  ASSERT_THAT(add_heat(model, sun_on_bridge), testing::IsEmpty());
  model.freeze(model::Form::null_space);
  model::State state = model.initial_state();
  state.time = state.time_prev = 0.5;
  kit::DenseAssembly dense(model);
  dense.prepare(state, Stencil::statics());
  Vec6 free;
  free << 0.0, 0.0, 0.8, -0.7, -0.4, 0.0;
  const Vec6 expected = -1.25 * expansion_of_beam * section().stiffness * free;
  const model::Cell& cell = model.find_structure("bridge")->cells[1];
  std::vector<double> found;
  cell.source->resultants(cell.item, state.next, found);
  EXPECT_LT((Eigen::Map<const Vec6>(found.data()) - expected).norm(), 1e-13 * expected.norm());
}

/// A temperature and gradients that grow along z.
struct Slope final : model::VectorField {
  double with_time = 0.0;
  Vec3 value(const Vec3& place, double time) const override {
    return (place[2] + with_time * time) * Vec3(1.0, 0.5, -2.0);
  }
  Mat3 gradient(const Vec3&, double) const override { return Mat3::Zero(); }
};

// An element from 0.75 to 1.5 m has the mean of its points, z = 1.125 m.
TEST(TemperatureOfBeams, FieldAddsByPlace) {
  model::Model model;
  add_beam(model, {{"Order", 2}});
  GivenValues values = sun_on_bridge;
  values.emplace_back("Field", std::string("slope"));
  ASSERT_THAT(add_heat(model, values, {{"slope", std::make_shared<Slope>()}}), testing::IsEmpty());
  model.freeze(model::Form::null_space);
  model::State state = model.initial_state();
  kit::DenseAssembly dense(model);
  dense.prepare(state, Stencil::statics());
  Vec6 free;
  free << 0.0, 0.0, 0.8 + 1.125, -0.7 - 2.0 * 1.125, -0.4 - 0.5 * 1.125, 0.0;
  const Vec6 expected = -expansion_of_beam * section().stiffness * free;
  const model::Cell& cell = model.find_structure("bridge")->cells[1];
  std::vector<double> found;
  cell.source->resultants(cell.item, state.next, found);
  EXPECT_LT((Eigen::Map<const Vec6>(found.data()) - expected).norm(), 1e-13 * expected.norm());
}

TEST(TemperatureOfBeams, FieldMustRest) {
  model::Model model;
  add_beam(model, {});
  GivenValues values = sun_on_bridge;
  values.emplace_back("Field", std::string("slope"));
  const auto slope = std::make_shared<Slope>();
  slope->with_time = 1.0;
  EXPECT_THAT(add_heat(model, values, {{"slope", slope}}),
              ElementsAre(HasSubstr("'slope' changes in time")));
  EXPECT_THAT(add_heat(model, values), ElementsAre(HasSubstr("unknown field 'slope'")));
}

TEST(TemperatureOfBeams, MistakesAreNamed) {
  const auto message = [](const GivenValues& beam, const GivenValues& heat, double of_expansion) {
    model::Model model;
    add_beam(model, beam, of_expansion);
    return add_heat(model, heat);
  };
  EXPECT_THAT(message({}, sun_on_bridge, 0.0),
              ElementsAre(HasSubstr("its sections need an 'Expansion'")));
  EXPECT_THAT(message({{"Fidelity", std::string("Kirchhoff")}}, sun_on_bridge, expansion_of_beam),
              ElementsAre(HasSubstr("holds its length")));
  EXPECT_THAT(message({{"Element", std::string("Helical")}}, sun_on_bridge, expansion_of_beam),
              ElementsAre(HasSubstr("has helical elements")));
  EXPECT_THAT(message({{"Fidelity", std::string("Rigid")}}, sun_on_bridge, expansion_of_beam),
              ElementsAre(HasSubstr("no elements that expand")));
  EXPECT_THAT(message({}, {{"Structure", std::string("bridge")}}, expansion_of_beam),
              ElementsAre(HasSubstr("heats nothing")));
  GivenValues noisy{
      {"Structure", std::string("bridge")}, {"Value", 1.0}, {"Function", std::string("noise")}};
  EXPECT_THAT(message({}, noisy, expansion_of_beam), ElementsAre(HasSubstr("one value per step")));
}

}  // namespace
}  // namespace culm::heat
