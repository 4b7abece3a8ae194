#include <culm/load/register_load.hpp>
#include <culm/model/element_batch.hpp>

#include "sample_load.hpp"

#include <culm_kit/deck_list.hpp>
#include <culm_kit/load_contract.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

namespace culm::load {
namespace {

using kit::Resultant;
using testing::ElementsAre;
using testing::IsEmpty;
using Numbers = std::vector<double>;

/// Inertia without stiffness: a rigid body on one node.
struct Lump {
  static constexpr NodeKind node_kind = NodeKind::node12;
  static constexpr int num_nodes = 1;
  static constexpr int num_slots = 4;
  static constexpr int num_points = 1;
  static constexpr int num_strains = 1;
  static constexpr int num_resultants = 1;

  Mat<4, 4> inertia;

  void strain(int, const Slots<4>&, Vec<1>& y) const noexcept { y.setZero(); }
  void gradient(int, const Slots<4>&, Gradient<4, 1>& B) const noexcept { B.setZero(); }
  void add_curvature(int, const Vec<1>&, SlotMatrix<4>&) const noexcept {}
  Verdict respond(int, const Vec<1>&, const Vec<1>&, const Stencil&,
                  Response<1>& response) const noexcept {
    response.stress.setZero();
    response.tangent.setZero();
    return Verdict::ok;
  }
  double energy(int, const Vec<1>&) const noexcept { return 0.0; }
  SlotMatrix<4> mass() const noexcept { return inertia; }
  Vec<1> resultants(int, const Vec<1>& y) const noexcept { return y; }
  static constexpr std::array<const char*, 1> resultant_names() { return {"None"}; }
};

const Numbers numbers(components.begin(), components.end());
const Numbers offset_numbers(offset.begin(), offset.end());

/// A line of three nodes with four points, and a lonely node.
class Loads : public testing::Test {
 protected:
  model::BuilderRegistry registry;
  model::Model model;
  std::map<std::string, model::Amplitude> functions;
  InputIssues issues;

  Loads() {
    register_loads(registry);
    model::Structure& line = model.add_structure("line");
    for (int seed = 0; seed < 3; ++seed) {
      line.nodes.push_back(model.nodes().add(kit::random_node(seed)));
    }
    line.sets = {{"last", {2}}};
    line.line_points = {point(0, 1, 0.2, 0.3), point(0, 1, 0.8, 0.4), point(1, 2, 0.3, 0.5),
                        point(1, 2, 0.6, 0.6)};
    model.add_structure("body").nodes = {model.nodes().add(kit::random_node(7))};
  }

  static model::LinePoint point(int a, int b, double xi, double length) {
    return {{{a, b}, {1.0 - xi, xi}}, length};
  }

  Schema schema(const std::string& type) const { return registry.variants().at(type); }
  void build(const std::string& type, const kit::GivenValues& values) {
    const Options options = kit::deck_list(schema(type), values, "push");
    EXPECT_THAT(kit::mistakes_in(schema(type), options), IsEmpty());
    model::BuildContext context{model, functions, issues};
    registry.make(type, options, context);
  }
  std::vector<std::string> messages() const {
    std::vector<std::string> result;
    for (const InputIssue& issue : issues.sorted()) result.push_back(issue.message);
    return result;
  }

  /// External forces on all slots in a state of all nodes, at time 1.
  Eigen::VectorXd slot_forces(const model::Coordinates& q) {
    model.freeze(model::Form::multipliers);
    kit::DenseAssembly dense(model);
    model::State state = model.initial_state();
    state.time = 1.0;
    state.prev = state.next = q;
    return -dense.residual(state, Stencil::statics(), {model.batches().back()}).head(12 * 4);
  }
  model::Coordinates moved() const {
    model::Coordinates q;
    for (int seed = 30; seed < 34; ++seed) {
      const model::NodeSlots slots = kit::random_node(seed);
      q.append({slots.data(), static_cast<std::size_t>(slots.size())});
    }
    return q;
  }
  /// sum_s T_s q_s of a marker, moved further in its directors
  static Vec3 position(const model::Marker& marker, const Vec3& further,
                       const model::Coordinates& q) {
    Vec3 x = Vec3::Zero();
    for (std::size_t a = 0; a < marker.nodes.size(); ++a) {
      const auto slots = model::NodeTable::slots(q, marker.nodes[a]);
      x += marker.weights[a] * (slots.col(0) + slots.rightCols<3>() * (marker.offset + further));
    }
    return x;
  }
  static Mat3 triad(const model::Marker& marker, const model::Coordinates& q) {
    Mat3 directors = Mat3::Zero();
    for (std::size_t a = 0; a < marker.nodes.size(); ++a) {
      directors += marker.weights[a] * model::NodeTable::slots(q, marker.nodes[a]).rightCols<3>();
    }
    return directors;
  }
  /// Slots that move as they like: sum_s f_s . v_s = sum_p length_p F_p . v(p)
  template <class Force>
  void expect_work_of_points(const std::string& type, Force force_at) {
    build(type,
          {{"Structure", std::string("line")}, {"Force", numbers}, {"Offset", offset_numbers}});
    const model::Coordinates q = moved();
    const Eigen::VectorXd forces = slot_forces(q);
    kit::Random random(8);
    model::Coordinates v(q.size());
    for (double& value : v) value = random.number();
    double expected = 0.0;
    for (const auto& [marker, length] : model.find_structure("line")->line_points.copy()) {
      expected += length * force_at(triad(marker, q)).dot(position(marker, offset, v));
    }
    const Eigen::Map<const Eigen::VectorXd> velocity(v.data(), forces.size());
    EXPECT_NEAR(forces.dot(velocity), expected, round_off);
  }
};

TEST_F(Loads, TheTypes) {
  EXPECT_THAT(
      registry.names(),
      ElementsAre("Catenary", "Damper", "Directed Damper", "Directed Ground Damper",
                  "Directed Ground Spring", "Directed Spring", "Director Force", "External",
                  "Field Force", "Follower Force", "Follower Line Force", "Follower Line Load",
                  "Follower Line Moment", "Follower Moment", "Force", "Gravity", "Ground Damper",
                  "Ground Spring", "Line Force", "Line Load", "Line Moment", "Moment",
                  "Plane Ground Damper", "Plane Ground Spring", "Pressure", "Restoring",
                  "Rotating Frame", "Rotation Damper", "Rotation Damper Local", "Spring",
                  "Surface Force", "Torsion Damper", "Torsion Drive", "Torsion Spring"));
}

TEST_F(Loads, VirtualWorkOfALineForceIsThatOfItsPoints) {
  expect_work_of_points("Line Force", [](const Mat3&) { return components; });
}

TEST_F(Loads, VirtualWorkOfAFollowerLineForceIsThatOfItsPoints) {
  expect_work_of_points("Follower Line Force",
                        [](const Mat3& triad) -> Vec3 { return triad * components; });
}

TEST_F(Loads, PointsOfOneElementShareAnItem) {
  build("Line Force", {{"Structure", std::string("line")}, {"Force", numbers}});
  EXPECT_EQ(model.batches().back()->size(), 2);
}

TEST_F(Loads, LineMomentsAddUpToMomentTimesLength) {
  build("Line Moment", {{"Structure", std::string("line")}, {"Moment", numbers}});
  const model::Coordinates q = moved();
  const Resultant total = kit::resultant_of(slot_forces(q), q);
  EXPECT_LT(total.force.norm(), round_off);
  EXPECT_LT((total.moment - 1.8 * components).norm(), round_off);
}

TEST_F(Loads, FollowerLineMomentsTurnWithTheirNodes) {
  build("Follower Line Moment", {{"Structure", std::string("line")}, {"Moment", numbers}});
  const model::Coordinates q = moved();
  const Resultant total = kit::resultant_of(slot_forces(q), q);
  // lengths of the nodes: sum of weight times length of the points above
  Vec3 expected = Vec3::Zero();
  const double lengths[] = {0.3 * 0.8 + 0.4 * 0.2, 0.3 * 0.2 + 0.4 * 0.8 + 0.5 * 0.7 + 0.6 * 0.4,
                            0.5 * 0.3 + 0.6 * 0.6};
  for (int node = 0; node < 3; ++node) {
    expected += lengths[node] * (model::NodeTable::slots(q, node).rightCols<3>() * components);
  }
  EXPECT_LT((total.moment - expected).norm(), round_off);
}

TEST_F(Loads, FollowersThatDoNotTurnKeepTheDirectionOfTheReference) {
  build("Follower Force",
        {{"Node", std::string("line/last")}, {"Force", numbers}, {"Turning", false}});
  const Mat3 directors = triad(model::marker_at(2), model.nodes().reference());
  const model::Coordinates q = moved();
  EXPECT_LT((kit::resultant_of(slot_forces(q), q).force - directors * components).norm(),
            round_off);
}

TEST_F(Loads, FollowerMomentsThatDoNotTurnKeepTheDirectionOfTheReference) {
  build("Follower Moment",
        {{"Node", std::string("line/last")}, {"Moment", numbers}, {"Turning", false}});
  const Mat3 directors = triad(model::marker_at(2), model.nodes().reference());
  const model::Coordinates q = moved();
  EXPECT_LT((kit::resultant_of(slot_forces(q), q).moment - directors * components).norm(),
            round_off);
}

TEST_F(Loads, EachSelectedNodeCarriesTheWholeForce) {
  build("Force", {{"Node", std::string("line")}, {"Force", numbers}});
  const model::Coordinates q = moved();
  EXPECT_LT((kit::resultant_of(slot_forces(q), q).force - 3.0 * components).norm(), round_off);
  EXPECT_EQ(model.batches().back()->effect().title(), "Force, push");
}

TEST_F(Loads, GravityActsAtTheCentreOfMass) {
  // 1/2 (v + w_k xi_k)^2 dm of a mass of 3 kg at a point, and one of 2 kg at a node
  const Eigen::Vector4d point(1.0, offset[0], offset[1], offset[2]);
  auto& lumps = model::elements<Lump>(model, "Lumps");
  lumps.add({3.0 * point * point.transpose()}, {1});
  Mat<4, 4> central = Mat<4, 4>::Zero();
  central(0, 0) = 2.0;
  central(1, 1) = 0.7;  // moments of inertia weigh nothing
  lumps.add({central}, {3});
  build("Gravity", {{"Acceleration", Numbers{0.5, 0.0, -9.0}}, {"Function", std::string("Ramp")}});
  EXPECT_EQ(model.batches().back()->size(), 2);

  const model::Coordinates q = moved();
  const Resultant total = kit::resultant_of(slot_forces(q), q);
  const Vec3 g(0.5, 0.0, -9.0);
  const Vec3 first = position(model::marker_at(1), offset, q);
  const Vec3 second = model::NodeTable::slots(q, 3).col(0);
  EXPECT_LT((total.force - 5.0 * g).norm(), 10.0 * round_off);
  EXPECT_LT((total.moment - (3.0 * first + 2.0 * second).cross(g)).norm(), 10.0 * round_off);
}

TEST_F(Loads, GravityActsInFullFromTheStartUnlessAsked) {
  EXPECT_EQ(schema("Gravity").find_field("Function")->default_value(),
            Value(std::string("Constant")));
  EXPECT_EQ(schema("Force").find_field("Function")->default_value(), Value(std::string("Ramp")));
}

TEST_F(Loads, GravityOfMasslessStructuresIsAMistake) {
  build("Gravity", {});
  EXPECT_THAT(messages(), ElementsAre("acts on nothing: no structure has mass"));
}

TEST_F(Loads, UserFunctionsScaleLoads) {
  functions.emplace("half", model::Amplitude::constant(0.5));
  build("Moment",
        {{"Node", std::string("body/0")}, {"Moment", numbers}, {"Function", std::string("half")}});
  const model::Coordinates q = moved();
  EXPECT_LT((kit::resultant_of(slot_forces(q), q).moment - 0.5 * components).norm(), round_off);
}

TEST_F(Loads, MistakesAreNamedWithTheNearestName) {
  build("Force", {{"Node", std::string("line/lats")}, {"Force", numbers}});
  build("Moment", {{"Node", std::string("line/3")}, {"Moment", numbers}});
  build("Line Force", {{"Structure", std::string("lime")}, {"Force", numbers}});
  build("Line Moment", {{"Structure", std::string("body")}, {"Moment", numbers}});
  build("Follower Force",
        {{"Node", std::string("line/last")}, {"Force", numbers}, {"Function", std::string("Rmp")}});
  EXPECT_THAT(messages(), ElementsAre("unknown node 'line/lats' – did you mean 'line/last'?",
                                      "no node 'line/3': 'line' has 3 nodes, numbered from 0",
                                      "unknown structure 'lime' – did you mean 'line'?",
                                      "structure 'body' is not a line: it has no length to load",
                                      "unknown function 'Rmp' – did you mean 'Ramp'?"));
}

}  // namespace
}  // namespace culm::load
