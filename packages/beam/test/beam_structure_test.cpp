#include <culm/base/error.hpp>
#include <culm/beam/beam_structure.hpp>
#include <culm/beam/director_beam.hpp>
#include <culm/beam/element_batches.hpp>
#include <culm/beam/helical_beam.hpp>
#include <culm/beam/register_beam.hpp>
#include <culm/model/mass_properties.hpp>

#include <Eigen/Geometry>
#include <culm_kit/deck_list.hpp>
#include <culm_kit/rigid_motion.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <sstream>

namespace culm::beam {
namespace {

using kit::GivenValues;
using testing::HasSubstr;
using Numbers = std::vector<double>;

Options beam_list(const GivenValues& beam, const std::string& curve_type,
                  const GivenValues& curve) {
  const Schema schema = beam_schema();
  Options options = kit::deck_list(schema, beam, "blade");
  Options list = kit::deck_list(*schema.find_slot("Curve")->find(curve_type), curve, "Curve");
  list.set("Type", curve_type);
  options.add_list(list);
  return options;
}

// A model with one beam.
class BeamStructure : public testing::Test {
 protected:
  const model::Structure& add(const GivenValues& beam, const std::string& curve_type,
                              const GivenValues& curve) {
    structure::StructureContext context{model, sections, materials, issues, log, refinement};
    add_beam(beam_list(beam, curve_type, curve), context);
    return *model.find_structure("blade");
  }
  const model::Structure& add_line(const GivenValues& beam, int elements = 4) {
    return add(beam, "Line",
               {{"From", Numbers{0, 0, 0}}, {"To", Numbers{0, 0, 3}}, {"Elements", elements}});
  }

  static material::Section section() {
    return {kit::Random(1).positive_matrix<6>(),
            kit::Random(2).positive_matrix<3>(),
            {{-1, -1}, {1, -1}, {0, 1}}};
  }

  int refinement = 1;
  model::Model model;
  std::map<std::string, material::Section> sections{{"tube", section()}};
  std::map<std::string, material::Material> materials;
  InputIssues issues;
  std::ostringstream messages;
  Log log{messages, LogLevel::info};
};

const GivenValues director_2{{"Section", std::string("tube")}, {"Order", 2}};
const GivenValues director_1{{"Section", std::string("tube")}, {"Order", 1}};
const GivenValues helical{{"Section", std::string("tube")}, {"Element", std::string("Helical")}};

TEST_F(BeamStructure, HasNodesCellsSetsAndOutlines) {
  const model::Structure& beam = add_line(director_2);
  EXPECT_EQ(beam.nodes.size(), 9U);
  EXPECT_EQ(beam.cells.size(), 4U);
  EXPECT_TRUE(std::ranges::equal(beam.cells[1].nodes, std::vector<int>{2, 3, 4}));
  EXPECT_EQ(beam.cells[1].item, 1);
  EXPECT_EQ(beam.sets.at("first"), std::vector<int>{0});
  EXPECT_EQ(beam.sets.at("middle"), std::vector<int>{4});
  EXPECT_EQ(beam.sets.at("last"), std::vector<int>{8});
  EXPECT_EQ(beam.sets.at("all"), beam.nodes);
  ASSERT_EQ(beam.outlines.size(), 9U);
  EXPECT_EQ(beam.outlines[3].size(), 3U);
  EXPECT_EQ(messages.str(), "");
}

TEST_F(BeamStructure, ElementsOfOneKindShareABatch) {
  add_line(director_1);
  EXPECT_EQ(model::elements<DirectorBeam<1>>(model, "Beam, director, order 1").size(), 4);
  EXPECT_EQ(model.element_batches().size(), 1U);
}

TEST_F(BeamStructure, WeighsWhatItsSectionsWeigh) {
  for (const GivenValues& kind : {director_1, director_2, helical}) {
    model::Model fresh;
    structure::StructureContext context{fresh, sections, materials, issues, log};
    add_beam(beam_list(kind, "Line",
                       {{"From", Numbers{0, 0, 0}}, {"To", Numbers{0, 0, 3}}, {"Elements", 4}}),
             context);
    EXPECT_NEAR(fresh.mass(), 3.0 * section().mass(0, 0), 1e-13);
  }
}

TEST_F(BeamStructure, LinePointsCoverItsLength) {
  const model::Structure& beam = add(helical, "Arc",
                                     {{"Centre", Numbers{0, 0, 0}},
                                      {"Axis", Numbers{0, 0, 1}},
                                      {"From", Numbers{2, 0, 0}},
                                      {"Angle", 1.5},
                                      {"Elements", 2}});
  double length = 0.0;
  for (const model::LinePoint& point : beam.line_points.copy()) {
    length += point.length;
    EXPECT_NEAR(point.marker.weights[0] + point.marker.weights[1], 1.0, 1e-15);
  }
  EXPECT_NEAR(length, 3.0, 1e-14);  // the helix knows the length of its arc
  EXPECT_EQ(beam.line_points.size(), 4U);
}

TEST_F(BeamStructure, LinksTheNodesAtAKink) {
  const model::Structure& beam =
      add(director_1, "Polyline",
          {{"Points", Numbers{0, 0, 0, 0, 2, 0, 1, 2, 0}}, {"Elements", std::vector{4, 2}}});
  EXPECT_EQ(beam.nodes.size(), 8U);
  EXPECT_EQ(beam.cells.size(), 6U);
  EXPECT_EQ(beam.sets.at("corners"), std::vector<int>{4});
  ASSERT_EQ(model.constraints().size(), 1U);
  EXPECT_EQ(model.constraints()[0].name, "blade, corner 1");
  EXPECT_EQ(model.constraints()[0].nodes, (std::vector<int>{4, 5}));
}

TEST_F(BeamStructure, IsFreeOfStressHoweverItIsCurved) {
  add(director_2, "Helix",
      {{"Centre", Numbers{0, 0, 0}},
       {"Axis", Numbers{0, 1, 0}},
       {"From", Numbers{2, 0, 0}},
       {"Angle", 3.0},
       {"Pitch", 1.0},
       {"Elements", 6},
       {"Pre-Twist", Numbers{0.0, 0.8}},
       {"Pre-Twist Positions", Numbers{0.0, 1.0}}});
  auto& batch = model::elements<DirectorBeam<2>>(model, "Beam, director, order 2");
  std::vector<double> resultants;
  for (int item = 0; item < batch.size(); ++item) {
    batch.resultants(item, model.nodes().reference(), resultants);
  }
  EXPECT_EQ(resultants.size(), 36U);
  for (double value : resultants) EXPECT_NEAR(value, 0.0, 1e-13);
}

TEST_F(BeamStructure, TapersBetweenItsSections) {
  material::Section thick = section();
  thick.stiffness *= 3.0;
  sections["root"] = thick;
  add_line({{"Sections", std::vector<std::string>{"root", "tube"}},
            {"Section Positions", Numbers{0.0, 1.0}},
            {"Order", 1}},
           2);
  const auto& batch = model::elements<DirectorBeam<1>>(model, "Beam, director, order 1");
  const Vec6 e = Vec6::Unit(3);
  // the Gauss point of the first element lies at a quarter of the span
  EXPECT_LT((batch.element(0).resultants(0, e) - 2.5 * section().stiffness.col(3)).norm(), 1e-14);
}

TEST_F(BeamStructure, RefusesHelicalElementsTurnedTooFar) {
  EXPECT_THROW(add(helical, "Arc",
                   {{"Centre", Numbers{0, 0, 0}},
                    {"Axis", Numbers{0, 0, 1}},
                    {"From", Numbers{2, 0, 0}},
                    {"Angle", std::numbers::pi},
                    {"Elements", 1}}),
               InputError);
}

TEST_F(BeamStructure, RefusesLengthsBeyondTheRangeOfNumbers) {
  for (const double length : {1e300, 1e-300}) {
    EXPECT_THROW(add(director_1, "Line",
                     {{"From", Numbers{0, 0, 0}}, {"To", Numbers{0, 0, length}}, {"Elements", 2}}),
                 InputError);
  }
}

TEST_F(BeamStructure, HelicalElementsHaveNoOrder) {
  const Schema schema = beam_schema();
  GivenValues given = helical;
  given.emplace_back("Order", 2);
  EXPECT_EQ(kit::mistakes_in(schema, kit::deck_list(schema, given)),
            std::vector<std::string>{"must be 1 for 'Helical' elements: leave it out"});
}

TEST(RegisterBeams, OffersTheBeam) {
  structure::StructureRegistry registry;
  register_beams(registry);
  EXPECT_EQ(registry.names(), std::vector<std::string>{"Beam"});
}

TEST_F(BeamStructure, NumbersOfTheDeckKeepTheirPlacesWhenRefined) {
  refinement = 3;
  const model::Structure& beam = add_line(director_2);  // four elements of three nodes
  EXPECT_EQ(beam.nodes.size(), 25u);
  EXPECT_EQ(beam.numbered_nodes().size(), 9u);
  const std::vector<int> found = model.select_nodes("blade/5");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(model::NodeTable::slots(model.nodes().reference(), found.front())(2, 0), 3.0 * 5 / 8,
              1e-15);
  EXPECT_EQ(model.node_name(found.front()), "blade/5");
  EXPECT_TRUE(model.select_nodes("blade/9").empty());
  EXPECT_EQ(beam.numbered_cells(), 4u);
  EXPECT_THAT(beam.cells_of(2), testing::ElementsAre(6, 7, 8));
}

TEST_F(BeamStructure, RigidBeamWeighsAndTurnsAsTheFullOne) {
  const GivenValues curved{{"Centre", Numbers{0, 5, 0}},
                           {"Axis", Numbers{0, 0, 1}},
                           {"From", Numbers{0, 0, 0}},
                           {"Angle", 1.2},
                           {"Elements", 6}};
  GivenValues given = director_2;
  model::Model whole;
  structure::StructureContext context{whole, sections, materials, issues, log};
  add_beam(beam_list(given, "Arc", curved), context);
  given.push_back({"Fidelity", std::string("Rigid")});
  add(given, "Arc", curved);
  const auto rigid = model::mass_properties(model, model.nodes().reference()).front();
  const auto full = model::mass_properties(whole, whole.nodes().reference()).front();
  EXPECT_NEAR(rigid.mass, full.mass, 1e-13 * full.mass);
  EXPECT_LT((rigid.first - full.first).norm(), 1e-13 * full.first.norm());
  EXPECT_LT((rigid.second - full.second).norm(), 1e-13 * full.second.norm());
  model.freeze(model::Form::null_space);
  EXPECT_EQ(model.unknowns().num_unknowns(), 6);
  EXPECT_EQ(model.batches().size(), 1u) << "its mass and nothing else";
}

TEST_F(BeamStructure, KirchhoffBeamHasThreeEquationsPerPoint) {
  GivenValues given = director_2;
  given.push_back({"Fidelity", std::string("Kirchhoff")});
  add_line(given);
  model.freeze(model::Form::null_space);
  EXPECT_EQ(model.unknowns().num_multipliers(), 4 * 2 * 3);
  for (const model::Constraint& c : model.constraints()) {
    EXPECT_TRUE(c.is_structural);
    // the derivative by arc length and the directors of a straight beam
    const auto q = model::slots_of(c, model.nodes().reference());
    for (const model::ConstraintRow& row : c.rows) EXPECT_NEAR(row_value(row, q), 0.0, 1e-14);
  }
}

TEST_F(BeamStructure, WithoutTorsionThereIsOneEquationPerPoint) {
  GivenValues given = director_2;
  given.push_back({"Torsion", false});
  const model::Structure& blade = add_line(given);
  EXPECT_EQ(blade.cells.front().source->resultant_names(),
            (std::vector<std::string>{"N1", "N2", "N3", "M1", "M2"}));
  model.freeze(model::Form::null_space);
  EXPECT_EQ(model.unknowns().num_multipliers(), 4 * 2);
}

TEST_F(BeamStructure, WithoutTorsionKirchhoffBeamHasFourEquationsPerPoint) {
  GivenValues given = director_2;
  given.push_back({"Torsion", false});
  given.push_back({"Fidelity", std::string("Kirchhoff")});
  add_line(given);
  model.freeze(model::Form::null_space);
  EXPECT_EQ(model.unknowns().num_multipliers(), 4 * 2 * 4);
}

TEST_F(BeamStructure, RotaryInertiaGoesAndTheMassStaysAtItsCentre) {
  GivenValues given = director_2;
  add_line(given);
  given.push_back({"Rotary Inertia", 0.0});
  model::Model points;
  structure::StructureContext context{points, sections, materials, issues, log};
  add_beam(beam_list(given, "Line",
                     {{"From", Numbers{0, 0, 0}}, {"To", Numbers{0, 0, 3}}, {"Elements", 4}}),
           context);
  const auto whole = model::mass_properties(model, model.nodes().reference()).front();
  const auto left = model::mass_properties(points, points.nodes().reference()).front();
  EXPECT_NEAR(left.mass, whole.mass, 1e-13 * whole.mass);
  EXPECT_LT((left.first - whole.first).norm(), 1e-13 * whole.first.norm());
  // along the axis z nothing changes; across, mass times the centre squared is left
  EXPECT_NEAR(left.second(2, 2), whole.second(2, 2), 1e-12 * whole.second(2, 2));
  for (int i = 0; i < 2; ++i) {
    EXPECT_NEAR(left.second(i, i), left.first[i] * left.first[i] / left.mass,
                1e-12 * whole.second(i, i));
    EXPECT_GT(whole.second(i, i), 1.01 * left.second(i, i));
  }
}

TEST_F(BeamStructure, WhatDoesWithoutTorsionIsChecked) {
  const Schema schema = beam_schema();
  GivenValues linear = director_1;
  GivenValues rigid = director_1;
  linear.push_back({"Fidelity", std::string("Linear")});
  rigid.push_back({"Fidelity", std::string("Rigid")});
  const auto mistakes_without_torsion = [&](GivenValues given) {
    given.push_back({"Torsion", false});
    return kit::mistakes_in(schema, kit::deck_list(schema, given));
  };
  for (const GivenValues& given : {linear, rigid}) {
    EXPECT_EQ(mistakes_without_torsion(given),
              std::vector<std::string>{"false needs a 'Fidelity' of 'Full', 'Kirchhoff'"});
  }
  EXPECT_EQ(mistakes_without_torsion(helical),
            std::vector<std::string>{"must be true for 'Helical' elements"});
  GivenValues unknown = helical;
  unknown.push_back({"Fidelity", std::string("Linear")});
  EXPECT_EQ(kit::mistakes_in(schema, kit::deck_list(schema, unknown)),
            std::vector<std::string>{"of 'Helical' elements must be one of 'Full', 'Rigid'"});
}

TEST_F(BeamStructure, StrainDampingHasSixValuesOfDirectorElements) {
  const Schema schema = beam_schema();
  GivenValues given = director_1;
  given.push_back({"Strain Damping", Numbers{1, 2, 3}});
  EXPECT_EQ(kit::mistakes_in(schema, kit::deck_list(schema, given)),
            std::vector<std::string>{"must have six values, got 3"});
  given = helical;
  given.push_back({"Strain Damping", Numbers{1, 2, 3, 4, 5, 6}});
  EXPECT_EQ(kit::mistakes_in(schema, kit::deck_list(schema, given)),
            std::vector<std::string>{
                "needs elements whose strains are damped one by one, got 'Helical'"});
}

}  // namespace
}  // namespace culm::beam
