#include <culm/base/error.hpp>
#include <culm/material/isotropic.hpp>
#include <culm/model/layer_source.hpp>
#include <culm/model/mass_properties.hpp>
#include <culm/shell/mesh_types.hpp>
#include <culm/shell/shell_structure.hpp>

#include <culm_kit/deck_list.hpp>
#include <culm_kit/rigid_motion.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

namespace culm::shell {
namespace {

using kit::GivenValues;
using testing::ElementsAre;
using testing::HasSubstr;
using Numbers = std::vector<double>;
using Integers = std::vector<int>;

const GivenValues three_by_two{
    {"Side 1", Numbers{3, 0, 0}}, {"Side 2", Numbers{0, 2, 0}}, {"Elements", Integers{3, 2}}};

// A model with one shell.
class ShellStructure : public testing::Test {
 protected:
  ShellStructure() {
    register_shells(registry);
    materials.emplace("steel",
                      material::Material{material::IsotropicMaterial::law(2e11, 0.3), 7850.0});
    materials.emplace("rubber", material::Material{material::NeoHooke::from_moduli(1e6, 0.4)});
  }

  const model::Structure& add(const std::string& mesh_type, const GivenValues& mesh) {
    return add_to(model, mesh_type, mesh);
  }
  const model::Structure& add_to(model::Model& target, const std::string& mesh_type,
                                 const GivenValues& mesh) {
    const Schema schema = registry.variants().at("Shell");
    Options options = kit::deck_list(
        schema, {{"Material", material}, {"Thickness", thickness}, {"Fidelity", fidelity}}, "wall");
    Options list = kit::deck_list(*schema.find_slot("Mesh")->find(mesh_type), mesh, "Mesh");
    list.set("Type", mesh_type);
    options.add_list(list);
    structure::StructureContext context{target, sections, materials, issues, log, refinement};
    registry.make("Shell", options, context);
    return *target.find_structure("wall");
  }
  const model::Structure& add_plane() { return add("Plane", three_by_two); }

  int refinement = 1;
  double thickness = 0.1;
  std::string fidelity = "Full";
  std::string material = "steel";
  structure::StructureRegistry registry;
  std::map<std::string, material::Section> sections;
  std::map<std::string, material::Material> materials;
  InputIssues issues;
  std::ostringstream printed;
  Log log{printed, LogLevel::info};
  model::Model model;
};

TEST_F(ShellStructure, PlaneHasNodesElementsAndNamedEdges) {
  const model::Structure& plane = add_plane();
  EXPECT_EQ(plane.nodes.size(), 12u);
  EXPECT_EQ(plane.cells.size(), 6u);
  EXPECT_EQ(plane.faces.size(), 6u);
  EXPECT_EQ(plane.sets.at("u0").size(), 3u);
  EXPECT_EQ(plane.sets.at("v1").size(), 4u);
  ASSERT_EQ(plane.sets.at("u1 v0").size(), 1u);
  const auto corner =
      model::NodeTable::slots(model.nodes().reference(), plane.sets.at("u1 v0").front());
  EXPECT_EQ(Vec3(corner.col(0)), Vec3(3, 0, 0));
  EXPECT_EQ(Vec3(corner.col(1)), Vec3(0, 0, 1));
  EXPECT_TRUE(corner.rightCols<2>().isZero(0.0));
}

TEST_F(ShellStructure, EdgesAndFacesMeasureLengthAndThickness) {
  const model::Structure& plane = add_plane();
  double length = 0.0;
  for (const model::LinePoint& point : model.line_points("wall/v0")) length += point.length;
  EXPECT_NEAR(length, 3.0, 1e-14);
  EXPECT_EQ(model.faces("wall").size(), plane.faces.size());
  EXPECT_EQ(model.faces("wall").front().thickness, 0.1);
  EXPECT_TRUE(model.faces("wall/nowhere").empty());
}

TEST_F(ShellStructure, MassIsThatOfTheWall) {
  add_plane();
  model.freeze(model::Form::null_space);
  EXPECT_NEAR(model.mass(), 7850.0 * 0.1 * 6.0, 1e-9);
}

// Of plane elements with one director all stresses are quadratic in the height: Simpson's rule over
// the layer gives the resultants.
TEST_F(ShellStructure, LayersAddUpToTheResultants) {
  const model::Structure& plane = add_plane();
  ASSERT_EQ(plane.layers->layers(), 1);
  model::Coordinates q = model.nodes().reference();
  for (std::size_t i = 0; i < plane.nodes.size(); ++i) {
    auto slots = model::NodeTable::slots(q, plane.nodes[i]);
    const double t = static_cast<double>(i);
    slots.col(0) += Vec3(0.02 * std::sin(t), 0.03 * std::cos(2.0 * t), 0.1 * std::sin(1.5 * t));
    slots.col(1) += Vec3(0.2 * std::cos(t), 0.1 * std::sin(t), 0.01 * std::cos(0.5 * t));
  }
  const double h = 0.1;
  for (std::size_t cell = 0; cell < plane.cells.size(); ++cell) {
    std::vector<double> R;
    plane.cells[cell].source->resultants(plane.cells[cell].item, q, R);
    const std::vector<model::LayerState> states = plane.layers->states(static_cast<int>(cell), q);
    ASSERT_EQ(states.size(), 3u);
    const Vec6 N = h / 6.0 * (states[0].stress + 4.0 * states[1].stress + states[2].stress);
    const Vec6 M = h * h / 12.0 * (states[2].stress - states[0].stress);
    const std::array<double, 8> wanted{N[0], N[1], N[5], M[0], M[1], M[5], N[4], N[3]};
    for (std::size_t k = 0; k < 8; ++k) {
      EXPECT_NEAR(R[k], wanted[k], 1e-12 * N.norm()) << "cell " << cell << ", " << k;
    }
  }
}

TEST_F(ShellStructure, PlacedMeshIsTurnedAndMoved) {
  const model::Structure& tube = add("Cylinder", {{"Radius", 2.0},
                                                  {"Length", 5.0},
                                                  {"Elements", Integers{12, 2}},
                                                  {"Origin", Numbers{1, 0, 0}},
                                                  {"Rotation", Numbers{0, 1.5707963267948966, 0}}});
  EXPECT_EQ(tube.nodes.size(), 36u);  // closed
  for (int node : tube.sets.at("v1")) {
    const auto slots = model::NodeTable::slots(model.nodes().reference(), node);
    EXPECT_NEAR(slots(0, 0), 6.0, 1e-12);
    EXPECT_NEAR(slots(0, 1), 0.0, 1e-12);
  }
}

TEST_F(ShellStructure, UnknownPointOfAQuadIsNamed) {
  try {
    add("Quads",
        {{"Points", Numbers{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}}, {"Quads", Integers{0, 1, 2, 4}}});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("point 4 does not exist"));
  }
}

TEST_F(ShellStructure, ElementWithoutVolumeIsNamed) {
  EXPECT_THROW(add("Quads", {{"Points", Numbers{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}},
                             {"Quads", Integers{0, 1, 2, 3}}}),
               InputError);
}

// A roof of two squares that meet at `angle`.
GivenValues roof(double angle) {
  const double c = std::cos(angle);
  const double s = -std::sin(angle);
  return {{"Points", Numbers{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 1 + c, 0, s, 1 + c, 1, s}},
          {"Quads", Integers{0, 1, 2, 3, 1, 4, 5, 2}}};
}

TEST_F(ShellStructure, WallsThatMeetAtAFoldAreJoined) {
  add("Quads", roof(1.2));
  ASSERT_EQ(model.constraints().size(), 2u);
  for (const model::Constraint& joint : model.constraints()) {
    EXPECT_EQ(joint.type, "Fold");
    EXPECT_EQ(joint.rows.size(), 4u);  // place and angle
    ASSERT_EQ(joint.nodes.size(), 2u);
    const auto slots = [&](int node) {
      return model::NodeSlots(model::NodeTable::slots(model.nodes().reference(), node));
    };
    const auto first = slots(joint.nodes[0]);
    const auto second = slots(joint.nodes[1]);
    EXPECT_EQ(Vec3(first.col(0)), Vec3(second.col(0)));
    EXPECT_NEAR(first.col(1).dot(second.col(1)), std::cos(1.2), 1e-14);
  }
  EXPECT_THAT(printed.str(), HasSubstr("1 folds at 2 places"));
  EXPECT_THAT(printed.str(), testing::Not(HasSubstr("if a curved surface is meant")));
}

TEST_F(ShellStructure, FlatFoldsAreNoted) {
  add("Quads", roof(0.5));
  EXPECT_EQ(model.constraints().size(), 2u);
  EXPECT_THAT(printed.str(), HasSubstr("folds of only 29 degrees"));
}

TEST_F(ShellStructure, FlatRoofHasNoFold) {
  add("Quads", roof(0.3));
  EXPECT_TRUE(model.constraints().empty());
}

TEST_F(ShellStructure, QualityIsReported) {
  add_plane();
  EXPECT_THAT(printed.str(), HasSubstr("12 nodes, 6 elements, aspect up to 1, angles 90 to 90"));
}

TEST_F(ShellStructure, NumbersOfTheDeckKeepTheirPlacesWhenRefined) {
  const model::Structure coarse = add_plane();
  std::vector<Vec3> places;
  for (int node : coarse.nodes) {
    places.emplace_back(model::NodeTable::slots(model.nodes().reference(), node).col(0));
  }
  refinement = 3;
  const auto fine = std::make_unique<model::Model>();
  const model::Structure& plane = add_to(*fine, "Plane", three_by_two);
  EXPECT_EQ(plane.cells.size(), 54u);
  ASSERT_EQ(plane.numbered_nodes().size(), places.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto slots =
        model::NodeTable::slots(fine->nodes().reference(), plane.numbered_nodes()[i]);
    EXPECT_LT((Vec3(slots.col(0)) - places[i]).norm(), 1e-14);
  }
  for (int cell = 0; cell < 6; ++cell) {
    ASSERT_EQ(plane.cells_of(cell).size(), 9u);
    Vec3 mean = Vec3::Zero();
    for (int part : plane.cells_of(cell)) {
      for (int node : plane.cells[static_cast<std::size_t>(part)].nodes) {
        mean += model::NodeTable::slots(fine->nodes().reference(), node).col(0) / 36.0;
      }
    }
    EXPECT_LT((mean - Vec3(0.5 + cell % 3, 0.5 + cell / 3, 0.0)).norm(), 1e-14);
  }
}

TEST_F(ShellStructure, RigidShellWeighsAndTurnsAsTheFullOne) {
  const GivenValues tube{
      {"Radius", 2.0}, {"Length", 5.0}, {"To", 4.0}, {"Elements", Integers{12, 3}}};
  add("Cylinder", tube);
  model::Model rigid;
  fidelity = "Rigid";
  add_to(rigid, "Cylinder", tube);
  const auto total = [](const model::Model& one) {
    model::MassProperties sum;
    for (const auto& part : model::mass_properties(one, one.nodes().reference())) sum += part;
    return sum;
  };
  const model::MassProperties full = total(model);
  const model::MassProperties found = total(rigid);
  EXPECT_NEAR(found.mass, full.mass, 1e-13 * full.mass);
  EXPECT_LT((found.first - full.first).norm(), 1e-13 * full.first.norm());
  EXPECT_LT((found.second - full.second).norm(), 1e-13 * full.second.norm());
  rigid.freeze(model::Form::null_space);
  EXPECT_EQ(rigid.unknowns().num_unknowns(), 6);
  EXPECT_EQ(rigid.batches().size(), 1u) << "its mass and nothing else";
}

TEST_F(ShellStructure, LinearShellHasAFrameAmidItsNodes) {
  fidelity = "Linear";
  add("Cylinder", {{"Radius", 1.0}, {"Length", 2.0}, {"Elements", Integers{8, 3}}});
  ASSERT_EQ(model.element_batches().size(), 1u);
  EXPECT_EQ(model.element_batches().front()->effect().title(), "Shell, linear");
  EXPECT_EQ(model.element_batches().front()->size(), 24);
  EXPECT_EQ(model.find_structure("wall")->layers->layers(), 1);
  ASSERT_EQ(model.select_nodes("wall frame").size(), 1u);
  const int frame = model.select_nodes("wall frame").front();
  const auto slots = model::NodeTable::slots(model.nodes().reference(), frame);
  EXPECT_LT((slots.rightCols<3>().transpose() * slots.rightCols<3>() - Mat3::Identity()).norm(),
            1e-14);
  EXPECT_LT((slots.col(0) - Vec3(0, 0, 1)).norm(), 0.3);
  model.freeze(model::Form::null_space);
  EXPECT_EQ(model.unknowns().num_unknowns(), 6 * 32 + 6 + 6) << "nodes, frame and its constraints";
}

// The frame is where a rigid motion of the shell takes it, and nowhere else.
TEST_F(ShellStructure, FrameMovesWithTheShell) {
  fidelity = "Linear";
  add_plane();
  const model::Constraint& fit = model.constraints().back();
  const kit::RigidMotion move = kit::RigidMotion::random(5);
  Eigen::Matrix3Xd q = model::slots_of(fit, model.nodes().reference());
  Eigen::Matrix3Xd moved = q;
  for (Eigen::Index s = 0; s < q.cols(); s += 4) {
    const Mat<3, 4> node = q.middleCols<4>(s);
    moved.middleCols<4>(s) = move(node, NodeKind::node12);
  }
  for (const model::ConstraintRow& row : fit.rows) {
    EXPECT_NEAR(model::row_value(row, moved), 0.0, 1e-14);
  }
  EXPECT_EQ(fit.rows.size(), 6u);
}

TEST_F(ShellStructure, WallsWhoseBendingIsLostAreTold) {
  thickness = 5e-6;  // 1.4e-6 of the diagonal
  add_plane();
  EXPECT_THAT(printed.str(), testing::Not(HasSubstr("rounding hides")));
  thickness = 3e-6;
  model::Model thin;
  add_to(thin, "Plane", three_by_two);
  EXPECT_THAT(printed.str(), HasSubstr("bending is 7e-13 of its stiffness, which rounding hides"));
  printed.str("");
  fidelity = "Rigid";
  model::Model rigid;
  add_to(rigid, "Plane", three_by_two);
  EXPECT_THAT(printed.str(), testing::Not(HasSubstr("rounding hides")));
}

TEST_F(ShellStructure, LinearShellWantsLinearMaterials) {
  fidelity = "Linear";
  material = "rubber";
  try {
    add_plane();
    FAIL() << "no complaint";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("'Linear' is for small strains"));
    EXPECT_THAT(e.what(), HasSubstr("'Full' or 'Rigid'"));
  }
}

}  // namespace
}  // namespace culm::shell
