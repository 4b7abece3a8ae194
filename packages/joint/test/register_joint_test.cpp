#include <culm/base/error.hpp>
#include <culm/joint/register_joint.hpp>

#include <culm_kit/deck_list.hpp>
#include <culm_kit/dense_assembly.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace culm::joint {
namespace {

using testing::ElementsAre;
using Numbers = std::vector<double>;

class Joints : public testing::Test {
 protected:
  model::BuilderRegistry registry;
  model::Model model;
  std::map<std::string, model::Amplitude> functions;
  InputIssues issues;

  Joints() {
    register_joints(registry);
    model::Structure& beam = model.add_structure("beam");
    for (int seed = 0; seed < 3; ++seed) {
      beam.nodes.push_back(model.nodes().add(kit::random_node(seed)));
    }
    beam.sets = {{"first", {0}}, {"last", {2}}};
  }

  Schema schema(const std::string& type) const { return registry.variants().at(type); }
  void build(const std::string& type, const kit::GivenValues& values) {
    const Options options = kit::deck_list(schema(type), values, "clamp");
    EXPECT_THAT(kit::mistakes_in(schema(type), options), ElementsAre());
    model::BuildContext context{model, functions, issues};
    registry.make(type, options, context);
  }
  std::vector<std::string> messages() const {
    std::vector<std::string> result;
    for (const InputIssue& issue : issues.sorted()) result.push_back(issue.message);
    return result;
  }
};

TEST_F(Joints, EveryTypeBuildsFromItsSchema) {
  const kit::GivenValues node = {{"Node", std::string("beam/last")}};
  const auto with = [&](const char* name, Value value) {
    kit::GivenValues values = node;
    values.emplace_back(name, std::move(value));
    return values;
  };
  const Numbers z = {0.0, 0.0, 2.0};
  build("Rigid Support", node);
  build("Spherical Support", node);
  build("Simple Support", with("Direction", z));
  build("Simple Support Local", with("Direction", z));
  build("Revolute Support", with("Axis", z));
  build("Planar Support", with("Normal", z));
  build("Rotation", with("Axis", z));
  build("Rotation Local", with("Axis", z));
  build("Rigid Connection", with("Master", std::string("beam/0")));
  EXPECT_THAT(messages(), ElementsAre());
  ASSERT_EQ(model.constraints().size(), 9U);
  std::vector<std::size_t> rows;
  std::vector<std::size_t> fixed;
  for (const model::Constraint& c : model.constraints()) {
    rows.push_back(c.rows.size());
    fixed.push_back(c.fix ? c.fix->unknowns.count() : 0);
    EXPECT_EQ(c.name, "clamp");
    EXPECT_TRUE(registry.contains(c.type));
    EXPECT_EQ(c.nodes.back(), 2);
  }
  EXPECT_THAT(rows, ElementsAre(12, 3, 1, 1, 5, 3, 1, 1, 12));
  EXPECT_THAT(fixed, ElementsAre(6, 3, 1, 0, 5, 3, 0, 0, 0));
  EXPECT_NEAR(model.constraints()[2].rows.front().direction.norm(), 1.0, 1e-15);
}

TEST_F(Joints, EveryPairJointBuildsFromItsSchema) {
  const kit::GivenValues pair = {{"First", std::string("beam/0")},
                                 {"Second", std::string("beam/last")}};
  const auto with = [&](kit::GivenValues more) {
    more.insert(more.begin(), pair.begin(), pair.end());
    return more;
  };
  const Numbers x = {3.0, 0.0, 0.0};
  const Numbers z = {0.0, 0.0, 2.0};
  build("Spherical Joint", pair);
  build("Revolute Joint", with({{"Axis", z}}));
  build("Cylindrical Joint", with({{"Axis", z}}));
  build("Prismatic Joint", with({{"Axis", z}}));
  build("Universal Joint", with({{"First Axis", x}, {"Second Axis", z}}));
  build("Weld", pair);
  build("Joint Angle", with({{"Axis", z}, {"Angle", 0.5}}));
  EXPECT_THAT(messages(), ElementsAre());
  // the supports above, angular velocities, and what joins shells
  EXPECT_EQ(model.constraints().size() + 19U, registry.names().size());
  std::vector<std::size_t> rows;
  for (const model::Constraint& c : model.constraints()) {
    rows.push_back(c.rows.size());
    EXPECT_TRUE(c.is_internal);
    EXPECT_THAT(c.nodes, ElementsAre(0, 2));
  }
  EXPECT_THAT(rows, ElementsAre(3, 5, 4, 5, 4, 6, 1));
}

TEST_F(Joints, AngularVelocitiesHaveOneMultiplierPerNode) {
  build(
      "Angular Velocity",
      {{"Node", std::string("beam")}, {"Axis", Numbers{0.0, 0.0, 2.0}}, {"Angular Velocity", 3.0}});
  build("Angular Velocity Local", {{"Node", std::string("beam/0")},
                                   {"Axis", Numbers{0.0, 2.0, 0.0}},
                                   {"Angular Velocity", 3.0}});
  EXPECT_THAT(messages(), ElementsAre());
  ASSERT_EQ(model.loads().size(), 2U);
  EXPECT_EQ(model.loads()[0]->size(), 3);
  EXPECT_EQ(model.loads()[0]->effect().title(), "Angular Velocity, clamp");
  EXPECT_THAT(model.freeze(model::Form::null_space), ElementsAre());
  EXPECT_EQ(model.unknowns().num_forces(), 4);
  const kit::DenseAssembly dense(model);
  EXPECT_EQ(dense.size(), 3 * 6 + 4);
}

TEST_F(Joints, ASelectionOfNodesMakesOneConstraintEach) {
  build("Spherical Support", {{"Node", std::string("beam")}});
  ASSERT_EQ(model.constraints().size(), 3U);
  EXPECT_EQ(model.constraints()[1].name, "clamp at beam/1");
  EXPECT_THAT(model.constraints()[1].nodes, ElementsAre(1));
}

TEST_F(Joints, MotionFollowsTheFunctionAndIsNotEliminated) {
  functions.emplace("push", model::Amplitude::of_time([](double t) { return 3.0 * t; }));
  build("Simple Support", {{"Node", std::string("beam/0")},
                           {"Direction", Numbers{0.0, 1.0, 0.0}},
                           {"Translation", 0.5},
                           {"Function", std::string("push")}});
  model::Constraint support = model.constraints().front();
  EXPECT_FALSE(support.fix);
  const double at_rest = support.rows.front().constant;
  support.drive(2.0, support.rows);
  EXPECT_NEAR(support.rows.front().constant - at_rest, 3.0, 1e-15);
}

TEST_F(Joints, PointsBetweenNodesAreHeldAndJoined) {
  model::Structure& line = model.add_structure("line");
  line.nodes = {0, 1, 2};
  line.cells = {{{0, 1}, nullptr, 0}, {{1, 2}, nullptr, 1}};
  line.line_points = {{{}, 1.0}, {{}, 1.0}};
  build("Spherical Support", {{"Node", std::string("line@0.25")}});
  build("Rigid Support", {{"Node", std::string("line@0.25")}});
  build("Rigid Support", {{"Node", std::string("line@0.5")}});  // a node
  build("Weld", {{"First", std::string("line@0.25")}, {"Second", std::string("beam/last")}});
  EXPECT_THAT(messages(), ElementsAre());
  const auto& made = model.constraints();
  ASSERT_EQ(made.size(), 4U);
  EXPECT_THAT(made[0].nodes, ElementsAre(0, 1));
  EXPECT_FALSE(made[0].fix);
  EXPECT_EQ(made[1].rows.size(), 6U);
  EXPECT_THAT(made[2].nodes, ElementsAre(1));
  EXPECT_TRUE(made[2].fix);
  EXPECT_THAT(made[3].nodes, ElementsAre(0, 1, 2));
  for (const model::Constraint& c : made) {
    const auto q = model::slots_of(c, model.nodes().reference());
    for (const model::ConstraintRow& row : c.rows) EXPECT_LT(std::abs(row_value(row, q)), 1e-14);
  }
}

TEST_F(Joints, MistakesInPointsAreNamed) {
  build("Spherical Support", {{"Node", std::string("baem@0.25")}});
  build("Spherical Support", {{"Node", std::string("beam@1.25")}});
  build("Spherical Support", {{"Node", std::string("beam@0.5")}});
  EXPECT_THAT(messages(),
              ElementsAre("unknown structure in 'baem@0.25' – did you mean 'beam'?",
                          "needs a fraction between 0 and 1 behind '@', got 'beam@1.25'",
                          "structure 'beam' is no line, got 'beam@0.5'"));
}

TEST_F(Joints, MistakesAreNamedWithTheNearestName) {
  build("Rigid Support", {{"Node", std::string("beam/lst")}});
  build("Rigid Support", {{"Node", std::string("beam/7")}});
  functions.emplace("push", model::Amplitude::ramp());
  const Value z = Numbers{0.0, 0.0, 1.0};
  const std::string first = "beam/first";
  build("Rotation", {{"Node", first}, {"Axis", z}, {"Function", std::string("pusch")}});
  EXPECT_THAT(messages(), ElementsAre("unknown node 'beam/lst' – did you mean 'beam/last'?",
                                      "no node 'beam/7': 'beam' has 3 nodes, numbered from 0",
                                      "unknown function 'pusch' – did you mean 'push'?"));
  EXPECT_TRUE(model.constraints().empty());
}

TEST_F(Joints, ImpulsesAndNoisePrescribeNoMotion) {
  functions.emplace("hit", model::Amplitude::of_step([](double, double) { return 1.0; }));
  build("Rotation Local", {{"Node", std::string("beam")},
                           {"Axis", Numbers{0.0, 0.0, 1.0}},
                           {"Angle", 1.0},
                           {"Function", std::string("hit")}});
  EXPECT_THAT(messages(), ElementsAre("function 'hit' has one value per step and cannot prescribe "
                                      "a motion"));
}

TEST_F(Joints, ADirectionHasALength) {
  const Options options =
      kit::deck_list(schema("Simple Support"),
                     {{"Node", std::string("beam/0")}, {"Direction", Numbers{0.0, 0.0, 0.0}}});
  EXPECT_THAT(kit::mistakes_in(schema("Simple Support"), options), ElementsAre("must not be zero"));
}

TEST_F(Joints, AConnectionHasOneMasterThatIsAnotherNode) {
  build("Rigid Connection", {{"Node", std::string("beam/0")}, {"Master", std::string("beam")}});
  build("Rigid Connection", {{"Node", std::string("beam")}, {"Master", std::string("beam/1")}});
  EXPECT_THAT(messages(),
              ElementsAre("must name one node, got 3", "node 'beam/1' cannot follow itself"));
  EXPECT_EQ(model.constraints().size(), 2U);
}

}  // namespace
}  // namespace culm::joint
