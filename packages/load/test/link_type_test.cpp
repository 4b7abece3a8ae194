#include <culm/load/register_load.hpp>

#include "sample_load.hpp"

#include <culm_kit/deck_list.hpp>
#include <culm_kit/dense_assembly.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

namespace culm::load {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using Numbers = std::vector<double>;

/// Two nodes 5 m apart.
class LinkTypes : public testing::Test {
 protected:
  model::BuilderRegistry registry;
  model::Model model;
  std::map<std::string, model::Amplitude> functions;
  InputIssues issues;

  LinkTypes() {
    register_loads(registry);
    for (const Vec3& x : {Vec3(0.0, 0.0, 0.0), Vec3(3.0, 4.0, 0.0)}) {
      model::NodeSlots slots;
      slots << x, Mat3::Identity();
      const int node = model.nodes().add(slots);
      model.add_structure(node == 0 ? "a" : "b").nodes = {node};
    }
  }

  static kit::GivenValues pair(kit::GivenValues more) {
    more.emplace_back("First", std::string("a"));
    more.emplace_back("Second", std::string("b"));
    return more;
  }
  static kit::GivenValues node(kit::GivenValues more) {
    more.emplace_back("Node", std::string("b"));
    return more;
  }
  std::vector<std::string> mistakes(const std::string& type, const kit::GivenValues& values) const {
    const Schema schema = registry.variants().at(type);
    return kit::mistakes_in(schema, kit::deck_list(schema, values));
  }
  void build(const std::string& type, const kit::GivenValues& values) {
    const Schema schema = registry.variants().at(type);
    const Options options = kit::deck_list(schema, values, "link");
    EXPECT_THAT(kit::mistakes_in(schema, options), IsEmpty());
    model::BuildContext context{model, functions, issues};
    registry.make(type, options, context);
  }
  std::vector<std::string> messages() const {
    std::vector<std::string> result;
    for (const InputIssue& issue : issues.sorted()) result.push_back(issue.message);
    return result;
  }
  /// Force on b in statics or, over a second, in motion, when it has moved by u and turned by r.
  Vec6 force_on_second(const Vec3& u, const Vec3& r, double step = 0.0) {
    model.freeze(model::Form::null_space);
    kit::DenseAssembly dense(model);
    model::State state = model.initial_state();
    state.time = 1.0;
    auto slots = model::NodeTable::slots(state.next, 1);
    slots.col(0) += u;
    slots.rightCols<3>() = exp_rotation(r);
    const Stencil stencil = step > 0.0 ? Stencil::midpoint(step) : Stencil::statics();
    dense.prepare(state, stencil);
    return -dense.residual(state, stencil, {model.batches().back()}).tail<6>();
  }
};

TEST_F(LinkTypes, SpringPullsAlongItsLine) {
  build("Spring", pair({{"Stiffness", 10.0}}));
  const Vec6 f = force_on_second(Vec3(3.0, 4.0, 0.0), Vec3::Zero());
  EXPECT_LT((f.head<3>() - Vec3(-30.0, -40.0, 0.0)).norm(), 10.0 * round_off);
  EXPECT_EQ(model.batches().back()->effect().title(), "Spring, link");
}

TEST_F(LinkTypes, FreeLengthPrestresses) {
  build("Spring", pair({{"Stiffness", 10.0}, {"Free Length", 4.0}}));
  const Vec6 f = force_on_second(Vec3::Zero(), Vec3::Zero());
  EXPECT_LT((f.head<3>() - Vec3(-6.0, -8.0, 0.0)).norm(), 10.0 * round_off);
}

TEST_F(LinkTypes, TableOfADamper) {
  build("Damper", pair({{"Rates", Numbers{-1.0, 0.0, 1.0}}, {"Forces", Numbers{-1.0, 0.0, 5.0}}}));
  const Vec6 f = force_on_second(Vec3(0.3, 0.4, 0.0), Vec3::Zero(), 1.0);
  EXPECT_LT((f.head<3>() - Vec3(-1.5, -2.0, 0.0)).norm(), 10.0 * round_off);
}

TEST_F(LinkTypes, DirectedSpringSeesItsDirectionOnly) {
  build("Directed Spring", pair({{"Stiffness", 10.0}, {"Direction", Numbers{2.0, 0.0, 0.0}}}));
  const Vec6 f = force_on_second(Vec3(0.5, 7.0, 1.0), Vec3::Zero());
  EXPECT_LT((f.head<3>() - Vec3(-5.0, 0.0, 0.0)).norm(), 10.0 * round_off);
}

// The digits are those of catenary_test.cpp.
TEST_F(LinkTypes, CatenaryPullsTowardsItsAnchorAndDown) {
  build("Catenary", node({{"Anchor", Numbers{-97.0, 4.0, -20.0}},
                          {"Length", 130.0},
                          {"EA", 1e18},
                          {"Weight", 1000.0},
                          {"Seabed", false}}));
  const Vec6 f = force_on_second(Vec3::Zero(), Vec3::Zero());
  EXPECT_LT((f.head<3>() - Vec3(-39804.646976, 0.0, -76764.775284)).norm(), 2e-5);
}

TEST_F(LinkTypes, CatenaryNeedsToKnowWhereUpIs) {
  EXPECT_THAT(mistakes("Catenary", node({{"Anchor", Numbers{0.0, 0.0, -20.0}},
                                         {"Length", 130.0},
                                         {"EA", 1e9},
                                         {"Weight", 1000.0},
                                         {"Up", Numbers{0.0, 0.0, 0.0}}})),
              ElementsAre("must not be zero"));
}

TEST_F(LinkTypes, FrictionOfACatenaryNeedsASeabed) {
  EXPECT_THAT(mistakes("Catenary", node({{"Anchor", Numbers{0.0, 0.0, -20.0}},
                                         {"Length", 130.0},
                                         {"EA", 1e9},
                                         {"Weight", 1000.0},
                                         {"Seabed", false},
                                         {"Friction", 0.5}})),
              ElementsAre("is that of a seabed, but 'Seabed' is false"));
}

TEST_F(LinkTypes, GroundSpringActsAtItsOffset) {
  build("Ground Spring", node({{"Stiffness", 10.0}, {"Offset", Numbers{0.0, 0.0, 1.0}}}));
  const Vec6 f = force_on_second(Vec3(0.5, 0.0, 0.0), Vec3::Zero());
  EXPECT_LT((f.head<3>() - Vec3(-5.0, 0.0, 0.0)).norm(), 10.0 * round_off);
  EXPECT_LT((f.tail<3>() - Vec3(0.0, -5.0, 0.0)).norm(), 10.0 * round_off);
}

TEST_F(LinkTypes, LocalDirectionTurnsWithTheNode) {
  build("Directed Ground Spring", node({{"Stiffness", 10.0},
                                        {"Direction", Numbers{1.0, 0.0, 0.0}},
                                        {"Frame", std::string("Node")}}));
  const Vec6 f = force_on_second(Vec3(0.3, 0.5, 0.0), Vec3(0.0, 0.0, std::acos(0.0)));
  EXPECT_LT((f.head<3>() - Vec3(0.0, -5.0, 0.0)).norm(), 10.0 * round_off);
}

TEST_F(LinkTypes, PlaneSpringIgnoresItsNormal) {
  build("Plane Ground Spring", node({{"Stiffness", 10.0}, {"Normal", Numbers{0.0, 0.0, 3.0}}}));
  const Vec6 f = force_on_second(Vec3(0.3, -0.4, 9.0), Vec3::Zero());
  EXPECT_LT((f.head<3>() - Vec3(-3.0, 4.0, 0.0)).norm(), 10.0 * round_off);
}

TEST_F(LinkTypes, TorsionSpringAndDrive) {
  const kit::GivenValues axis = pair({{"Axis", Numbers{0.0, 0.0, 2.0}}});
  kit::GivenValues spring = axis;
  spring.emplace_back("Stiffness", 10.0);
  build("Torsion Spring", spring);
  kit::GivenValues drive = axis;
  drive.emplace_back("Moment", 3.0);
  build("Torsion Drive", drive);
  const Vec6 moment = force_on_second(Vec3::Zero(), Vec3(0.0, 0.0, 2.0));
  EXPECT_LT((moment.tail<3>() - Vec3(0.0, 0.0, 3.0)).norm(), 10.0 * round_off);
}

TEST_F(LinkTypes, ALawIsAFactorOrATable) {
  const std::string either = "needs either 'Stiffness' or 'Elongations' with 'Forces'";
  const Numbers rising = {0.0, 1.0};
  EXPECT_THAT(mistakes("Spring", pair({})), ElementsAre(either));
  EXPECT_THAT(mistakes("Spring", pair({{"Elongations", rising}})), ElementsAre(either));
  EXPECT_THAT(
      mistakes("Spring", pair({{"Stiffness", 1.0}, {"Elongations", rising}, {"Forces", rising}})),
      ElementsAre(either));
  EXPECT_THAT(mistakes("Spring", pair({{"Elongations", Numbers{1.0, 0.0}}, {"Forces", rising}})),
              ElementsAre("must increase, got 1 before 0"));
}

TEST_F(LinkTypes, DampersGiveNoEnergy) {
  const auto found = [this](const Numbers& rates, const Numbers& forces) {
    return mistakes("Damper", pair({{"Rates", rates}, {"Forces", forces}})).size();
  };
  EXPECT_EQ(found({-2.0, 0.0, 1.0}, {-1.0, 0.0, 5.0}), 0U);
  EXPECT_EQ(found({-1.0, 1.0}, {-1.0, 1.0}), 0U);
  EXPECT_EQ(found({-1.0, 1.0}, {-1.0, 1.2}), 1U);           // not zero at rest
  EXPECT_EQ(found({-1.0, 0.0, 1.0}, {1.0, 0.0, 1.0}), 1U);  // pushes
  EXPECT_EQ(found({0.0, 1.0, 2.0}, {0.0, 3.0, 2.0}), 1U);   // would push beyond the table
}

TEST_F(LinkTypes, NothingPullsWithoutADirection) {
  build("Ground Spring", node({{"Elongations", Numbers{0.0, 1.0}}, {"Forces", Numbers{2.0, 3.0}}}));
  build("Ground Spring", node({{"Stiffness", 1.0}, {"Free Length", 1.0}}));
  const std::string pulls = "pulls where the points coincide and no direction is known";
  EXPECT_THAT(messages(), ElementsAre(pulls, pulls));
}

TEST_F(LinkTypes, PairsAreTwoNodes) {
  build("Spring", {{"First", std::string("a")}, {"Second", std::string("a")}, {"Stiffness", 1.0}});
  EXPECT_THAT(messages(), ElementsAre("must be another node than First"));
}

}  // namespace
}  // namespace culm::load
