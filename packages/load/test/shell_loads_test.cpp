#include <culm/load/pressure_load.hpp>
#include <culm/load/register_load.hpp>

#include <culm_kit/deck_list.hpp>
#include <culm_kit/load_contract.hpp>
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

/// The six faces of a box of 2 x 3 x 4 as one shell, directors outwards: eight nodes per face pair,
/// four per face, so that every face is flat with its own director.
class ShellLoads : public testing::Test {
 protected:
  model::BuilderRegistry registry;
  model::Model model;
  std::map<std::string, model::Amplitude> functions;
  InputIssues issues;
  const Vec3 size{2.0, 3.0, 4.0};
  const double thickness = 0.2;

  ShellLoads() {
    register_loads(registry);
    model::Structure& box = model.add_structure("box");
    for (int k = 0; k < 3; ++k) {
      for (double side : {-1.0, 1.0}) add_wall(box, k, side);
    }
    box.parts = {{"walls", {0, 1, 2, 3}}, {"lid", {5}}};
    box.sets = {{"corner", {0}}};
    box.edges["rim"] = {edge_point(0.21), edge_point(0.79)};
    model.add_structure("body").nodes = {model.nodes().add(kit::random_node(7))};
  }

  void add_wall(model::Structure& box, int k, double side) {
    const Vec3 d = side * Vec3::Unit(k);
    const Vec3 along = Vec3::Unit((k + 1) % 3);
    const Vec3 across = side * Vec3::Unit((k + 2) % 3);
    const double corners[4][2] = {{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}};
    model::Face face;
    face.thickness = thickness;
    for (std::size_t a = 0; a < 4; ++a) {
      model::NodeSlots slots = model::NodeSlots::Zero();
      slots.col(0) = (0.5 * d + corners[a][0] * along + corners[a][1] * across).cwiseProduct(size);
      slots.col(1) = d;
      face.nodes[a] = model.nodes().add(slots, NodeKind::node6);
      box.nodes.push_back(face.nodes[a]);
    }
    box.faces.push_back(face);
  }
  static model::LinePoint edge_point(double xi) {
    return {{{0, 1}, {1.0 - xi, xi}, Vec3::Zero()}, 1.5};
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
  /// External forces on the slots in the reference, at time 1, shape (3, 4 nodes).
  Eigen::Matrix3Xd forces() {
    model.freeze(model::Form::multipliers);
    kit::DenseAssembly dense(model);
    model::State state = model.initial_state();
    state.time = 1.0;
    const Eigen::VectorXd f =
        -kit::node_rows(model, dense.residual(state, Stencil::statics(), {model.batches().back()}));
    return f.reshaped(3, f.size() / 3);
  }
  static Vec3 total(const Eigen::Matrix3Xd& f, int slot) {
    Vec3 sum = Vec3::Zero();
    for (Eigen::Index s = slot; s < f.cols(); s += 4) sum += f.col(s);
    return sum;
  }

  static constexpr double round_off = 1e-13;
};

TEST_F(ShellLoads, PressureInAClosedSurfaceHasNoResultant) {
  build("Pressure", {{"Structure", std::string("box")}, {"Pressure", 7.0}});
  const Eigen::Matrix3Xd f = forces();
  EXPECT_LT(total(f, 0).norm(), round_off);
  EXPECT_LT((f.col(0) - Vec3(-7.0 * 12.0 / 4.0, 0.0, 0.0)).norm(), round_off);
}

TEST_F(ShellLoads, PressureOnAPartPushesAlongItsDirectors) {
  build("Pressure", {{"Structure", std::string("box/lid")}, {"Pressure", 7.0}});
  EXPECT_LT((total(forces(), 0) - Vec3(0.0, 0.0, 7.0 * 6.0)).norm(), round_off);
}

TEST_F(ShellLoads, PressureOnAFaceStretchesTheDirectors) {
  build(
      "Pressure",
      {{"Structure", std::string("box/lid")}, {"Pressure", 7.0}, {"Face", std::string("Bottom")}});
  const Eigen::Matrix3Xd f = forces();
  EXPECT_LT((total(f, 1) + 0.5 * thickness * Vec3(0.0, 0.0, 7.0 * 6.0)).norm(), round_off);
}

// Power in any motion of the nodes against that of the dead weight of the surface.
TEST_F(ShellLoads, SurfaceForceIsForceTimesArea) {
  build("Surface Force", {{"Structure", std::string("box")},
                          {"Force", Numbers{1.0, 2.0, -3.0}},
                          {"Face", std::string("Top")}});
  const Eigen::Matrix3Xd f = forces();
  const Vec3 per_area(1.0, 2.0, -3.0);
  EXPECT_LT((total(f, 0) - 52.0 * per_area).norm(), round_off);
  EXPECT_LT((total(f, 1) - 0.5 * thickness * 52.0 * per_area).norm(), round_off);
}

TEST_F(ShellLoads, LineLoadsActOnEdges) {
  build("Line Force", {{"Structure", std::string("box/rim")}, {"Force", Numbers{1.0, 2.0, -3.0}}});
  const Eigen::Matrix3Xd f = forces();
  EXPECT_LT((total(f, 0) - 3.0 * Vec3(1.0, 2.0, -3.0)).norm(), round_off);
}

TEST_F(ShellLoads, TablesActOnEdges) {
  build("Line Load", {{"Structure", std::string("box/rim")},
                      {"Position Measure", std::string("Metres")},
                      {"Positions", Numbers{1.0, 3.0}},
                      {"Forces", Numbers{1.0, 2.0, -3.0, 3.0, 0.0, 1.0}}});
  EXPECT_LT((total(forces(), 0) - 2.0 * Vec3(2.0, 1.0, -1.0)).norm(), 1e-13);
}

// m x d / (d . d) with d = -e1, all over the length of the edge
TEST_F(ShellLoads, LineMomentsActOnEdges) {
  build("Line Moment",
        {{"Structure", std::string("box/rim")}, {"Moment", Numbers{5.0, 2.0, -3.0}}});
  const Eigen::Matrix3Xd f = forces();
  EXPECT_LT((total(f, 1) - 3.0 * Vec3(5.0, 2.0, -3.0).cross(-Vec3::UnitX())).norm(), round_off);
  EXPECT_LT(total(f, 0).norm(), round_off);
}

TEST_F(ShellLoads, ForcesFollowTheDirector) {
  build("Follower Force", {{"Node", std::string("box/corner")}, {"Force", Numbers{4.0, 0.0, 0.0}}});
  EXPECT_LT((total(forces(), 0) + 4.0 * Vec3::UnitX()).norm(), round_off);
}

TEST_F(ShellLoads, DirectorForcesActOnTheDirectorOnly) {
  build("Director Force", {{"Node", std::string("box/corner")}, {"Force", Numbers{4.0, 1.0, 2.0}}});
  const Eigen::Matrix3Xd f = forces();
  EXPECT_LT((f.col(1) - Vec3(4.0, 1.0, 2.0)).norm(), round_off);
  EXPECT_LT(total(f, 0).norm(), round_off);
}

TEST_F(ShellLoads, MistakesAreNamed) {
  build("Pressure", {{"Structure", std::string("bix")}, {"Pressure", 7.0}});
  build("Pressure", {{"Structure", std::string("body")}, {"Pressure", 7.0}});
  build("Surface Force",
        {{"Structure", std::string("box/lit")}, {"Force", Numbers{1.0, 0.0, 0.0}}});
  build("Follower Force", {{"Node", std::string("box/corner")}, {"Force", Numbers{1.0, 0.0, 2.0}}});
  build("Force", {{"Node", std::string("box/corner")},
                  {"Force", Numbers{1.0, 0.0, 2.0}},
                  {"Offset", Numbers{0.0, 0.1, 0.0}}});
  build("Follower Moment",
        {{"Node", std::string("box/corner")}, {"Moment", Numbers{1.0, 0.0, 2.0}}});
  build("Director Force", {{"Node", std::string("body/0")}, {"Force", Numbers{1.0, 0.0, 2.0}}});
  const std::string components =
      "node 'box/0' of a shell has one director: only the first component may differ from zero";
  EXPECT_THAT(
      messages(),
      testing::UnorderedElementsAre(
          "unknown structure 'bix' – did you mean 'box'?",
          "structure 'body' is no shell: it has no area to load",
          "no part 'box/lit'; the shell has the parts 'lid', 'walls'", components, components,
          "node 'box/0' of a shell has one director, which no moment can follow; a Moment fixed in "
          "space is possible",
          "node 'body/0' is not one of a shell; a triad takes a Moment"));
}

}  // namespace
}  // namespace culm::load
