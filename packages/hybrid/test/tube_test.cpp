#include <culm/base/error.hpp>
#include <culm/hybrid/tube.hpp>
#include <culm/material/isotropic.hpp>
#include <culm/model/mass_properties.hpp>

#include <culm_kit/deck_list.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <sstream>

namespace culm::hybrid {
namespace {

using kit::GivenValues;
using Numbers = std::vector<double>;

class Tube : public testing::Test {
 protected:
  Tube() {
    register_hybrids(registry);
    materials.emplace("steel",
                      material::Material{material::IsotropicMaterial::law(2e11, 0.3), 7850.0});
    Mat6 other = Mat6::Identity();
    other(0, 0) = 3.0;
    materials.emplace("wood", material::Material{material::StVenantKirchhoff{other}, 500.0});
  }

  void add(model::Model& model, const std::string& kind, const std::string& material = "steel") {
    const Options tube = kit::deck_list(registry.variants().at("Tube"),
                                        {{"Model", kind},
                                         {"From", Numbers{1, 0, 0}},
                                         {"To", Numbers{1, 4, 0}},
                                         {"Material", material},
                                         {"Outer Radius", 0.5},
                                         {"Wall Thickness", 0.1},
                                         {"Elements", std::vector<int>{64, 4}}},
                                        "mast");
    structure::StructureContext context{model, sections, materials, issues, log};
    registry.make("Tube", tube, context);
  }

  // Of one of the ends.
  static model::NodeSlots end(const model::Model& model, const std::string& name) {
    const std::vector<int> nodes = model.select_nodes("mast/" + name);
    EXPECT_EQ(nodes.size(), 1u);
    EXPECT_EQ(model.nodes().kind(nodes.front()), NodeKind::node12);
    return model::NodeTable::slots(model.nodes().reference(), nodes.front());
  }

  structure::StructureRegistry registry;
  std::map<std::string, material::Material> materials;
  std::map<std::string, material::Section> sections;
  InputIssues issues;
  std::ostringstream messages;
  Log log{messages, LogLevel::quiet};
};

TEST_F(Tube, BothModelsHaveTheSameEnds) {
  model::Model beam;
  model::Model shell;
  add(beam, "Beam");
  add(shell, "Shell");
  for (const char* name : {"first", "last"}) {
    EXPECT_LT((end(beam, name) - end(shell, name)).norm(), 1e-15) << name;
  }
  EXPECT_EQ(end(beam, "last").col(0), Vec3(1, 4, 0));
}

TEST_F(Tube, BothModelsHaveTheMassOfTheRing) {
  const double exact = 7850.0 * std::numbers::pi * (0.25 - 0.16) * 4.0;
  model::Model beam;
  model::Model shell;
  add(beam, "Beam");
  add(shell, "Shell");
  EXPECT_NEAR(beam.mass(), exact, 1e-12 * exact);
  // sides are (pi / 64)^2 / 6 shorter than their arcs, directors between nodes (pi / 64)^2 / 2
  const double x = std::numbers::pi / 64;
  EXPECT_NEAR(shell.mass(), exact * (1.0 - x * x * (1.0 / 6.0 + 0.5)), 1e-5 * exact);
}

TEST_F(Tube, RefusesMaterialsThatAreNotIsotropicOrNotThere) {
  for (const char* kind : {"Beam", "Shell"}) {
    model::Model model;
    EXPECT_THROW(add(model, kind, "wood"), InputError);
    EXPECT_THROW(add(model, kind, "steal"), InputError);
  }
}

}  // namespace
}  // namespace culm::hybrid
