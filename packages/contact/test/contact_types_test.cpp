#include <culm/contact/contact_point.hpp>
#include <culm/contact/register_contact.hpp>

#include <culm_kit/deck_list.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>
#include <vector>

namespace culm::contact {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using Numbers = std::vector<double>;

/// Two nodes 5 m apart.
class ContactTypes : public testing::Test {
 protected:
  model::BuilderRegistry registry;
  model::Model model;
  std::map<std::string, model::Amplitude> functions;
  InputIssues issues;

  ContactTypes() {
    register_contact(registry);
    for (const Vec3& x : {Vec3(0.0, 0.0, 0.0), Vec3(3.0, 4.0, 0.0)}) {
      model::NodeSlots slots;
      slots << x, Mat3::Identity();
      const int node = model.nodes().add(slots);
      model.add_structure(node == 0 ? "a" : "b").nodes = {node};
    }
  }

  static kit::GivenValues ball(kit::GivenValues more) {
    more.emplace_back("Node", std::string("b"));
    more.emplace_back("Area", 2.0);
    more.emplace_back("Stiffness", 10.0);
    more.emplace_back("Radius", 0.5);
    return more;
  }
  static kit::GivenValues bar(kit::GivenValues more) {
    more.emplace_back("From", Numbers{0.0, 0.0, 1.0});
    more.emplace_back("To", Numbers{6.0, 0.0, 1.0});
    more.emplace_back("Bar Radius", 4.0);
    return ball(more);
  }
  std::vector<std::string> mistakes(const std::string& type, const kit::GivenValues& values) const {
    const Schema schema = registry.variants().at(type);
    return kit::mistakes_in(schema, kit::deck_list(schema, values));
  }
  Touch build(const std::string& type, const kit::GivenValues& values) {
    const Schema schema = registry.variants().at(type);
    const Options options = kit::deck_list(schema, values, "contact");
    EXPECT_THAT(kit::mistakes_in(schema, options), IsEmpty());
    model::BuildContext context{model, functions, issues};
    registry.make(type, options, context);
    if (model.loads().empty()) return {};
    return dynamic_cast<const Contact&>(*model.loads().back()).touch(model.nodes().reference());
  }
  std::vector<std::string> messages() const {
    std::vector<std::string> result;
    for (const InputIssue& issue : issues.sorted()) result.push_back(issue.message);
    return result;
  }
};

TEST_F(ContactTypes, PlaneIsWhereTheDeckPutsIt) {
  const Touch touch = build("Plane Contact", ball({{"Point", Numbers{0.0, 3.8, 0.0}},
                                                   {"Normal", Numbers{0.0, 2.0, 0.0}},
                                                   {"Offset", Numbers{0.0, 0.1, 0.0}}}));
  EXPECT_NEAR(touch.depth, 0.2, 1e-14);
  EXPECT_NEAR(touch.force, 4.0, 1e-13);
}

TEST_F(ContactTypes, BarStandsInSpaceOrMovesWithItsBody) {
  const double depth = 4.5 - std::sqrt(17.0);
  EXPECT_NEAR(build("Cylinder Contact", bar({})).depth, depth, 1e-14);
  EXPECT_NEAR(build("Cylinder Contact", bar({{"Body", std::string("a")}})).depth, depth, 1e-14);
}

TEST_F(ContactTypes, ParametersMustFit) {
  EXPECT_THAT(mistakes("Plane Contact", {{"Stiffness", 1.0}}),
              ElementsAre("needs either 'Structure' or 'Node'"));
  EXPECT_THAT(mistakes("Plane Contact", {{"Stiffness", 1.0}, {"Node", std::string("b")}}),
              ElementsAre("'Node' and 'Area' need each other"));
  EXPECT_THAT(mistakes("Plane Contact", {{"Stiffness", 1.0}, {"Structure", std::string("b")}}),
              ElementsAre("needs 'Width', or a 'Radius', half of it"));
  EXPECT_THAT(mistakes("Plane Contact", ball({{"Normal", Numbers{0.0, 0.0, 0.0}}})),
              ElementsAre("must not be zero"));
  EXPECT_THAT(mistakes("Cylinder Contact", ball({{"From", Numbers{1.0, 0.0, 0.0}},
                                                 {"To", Numbers{1.0, 0.0, 0.0}},
                                                 {"Bar Radius", 1.0}})),
              ElementsAre("must not be 'From'"));
}

TEST_F(ContactTypes, BarCannotTouchItsOwnBody) {
  build("Cylinder Contact", bar({{"Body", std::string("b")}}));
  EXPECT_THAT(messages(), ElementsAre("is a node of what it shall touch"));
}

TEST_F(ContactTypes, NothingShouldBeginDeepInsideABar) {
  const auto objection = [this](const Numbers& offset) {
    build("Cylinder Contact", bar({{"Offset", offset}}));
    return dynamic_cast<const Contact&>(*model.loads().back()).objection(model.nodes().reference());
  };
  EXPECT_EQ(objection({0.0, -4.0, 0.5}), "lies 4 m deep in the bar, more than half of both radii");
  EXPECT_EQ(objection({0.0, -1.7, 1.0}), "");
}

TEST_F(ContactTypes, BeamsNeedLinesThatAreApart) {
  const auto with = [](const std::string& name, const std::string& other) {
    return kit::GivenValues{{"Structure", name},   {"Other", other},      {"Radius", 0.1},
                            {"Other Radius", 0.2}, {"Line Force", 100.0}, {"Depth", 0.01}};
  };
  EXPECT_THAT(mistakes("Beam Contact", {{"Structure", std::string("a")},
                                        {"Other", std::string("b")},
                                        {"Radius", 0.1},
                                        {"Other Radius", 0.2},
                                        {"Line Force", 100.0},
                                        {"Depth", 0.1}}),
              ElementsAre("must be at most 0.075 m, a quarter of both radii, got 0.1"));
  build("Beam Contact", with("a", "c"));
  EXPECT_THAT(messages(), ElementsAre("'a' is no line, nor an element set of lines",
                                      "'c' is no line, nor an element set of lines"));
}

TEST_F(ContactTypes, LineMustBeALine) {
  build("Plane Contact", {{"Stiffness", 1.0}, {"Structure", std::string("b")}, {"Width", 0.1}});
  EXPECT_THAT(messages(), ElementsAre("structure 'b' is not a line: name its nodes instead"));
}

}  // namespace
}  // namespace culm::contact
