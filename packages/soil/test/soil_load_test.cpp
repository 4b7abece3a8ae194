#include <culm/soil/api_curves.hpp>
#include <culm/soil/register_soil.hpp>
#include <culm/soil/soil_load.hpp>

#include <culm_kit/batch_laws.hpp>
#include <culm_kit/deck_list.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace culm::soil {
namespace {

using kit::effect;

// Smooth laws of the size of the random motions.
void fill(model::Model& model) {
  for (const int seed : {10, 11}) model.nodes().add(kit::random_node(seed));
  auto load = std::make_unique<SoilLoad>(effect, model.nodes());
  const auto sand = std::make_shared<SandCurve>(Sand{0.6, 1.0, 2.0}, 0.7, 2.0, false);
  const auto spring = std::make_shared<LinearCurve>(3.0);
  const Vec3 along = Vec3(0.2, -0.3, 0.9).normalized();
  load->add({{{0, 1}, {0.3, 0.7}, Vec3::Zero()}, along, 1.7, sand, spring});
  load->add({model::marker_at(1), Vec3::UnitX(), 0.6, spring, sand});
  model.add_load(std::move(load));
  model.add_rigid_link("link", 0, model.nodes().add(kit::random_node(20)));
}

/// The same as springs that slide.
void fill_with_sliders(model::Model& model) {
  for (const int seed : {10, 11}) model.nodes().add(kit::random_node(seed));
  auto load = std::make_unique<SoilLoad>(effect, model.nodes());
  const std::vector<Slider> soft = {{1.0, 0.2}, {2.0, 1.1}, {0.5, 100.0}}, stiff = {{3.0, 0.4}};
  const Vec3 along = Vec3(0.2, -0.3, 0.9).normalized();
  load->add({{{0, 1}, {0.3, 0.7}, Vec3::Zero()}, along, 1.7, {}, {}, soft, stiff});
  load->add({model::marker_at(1), Vec3::UnitX(), 0.6, {}, {}, stiff, soft});
  model.add_load(std::move(load));
  model.add_rigid_link("link", 0, model.nodes().add(kit::random_node(20)));
}

TEST(SoilLoad, TangentIsDerivativeOfResidual) {
  kit::expect_tangent_is_derivative(fill, effect);
  kit::expect_tangent_is_derivative(fill_with_sliders, effect, 3e-4);
}
TEST(SoilLoad, AttemptsLeaveNoTrace) {
  kit::expect_attempts_leave_no_trace(fill_with_sliders, effect);
}

// Two steps, with what the first one slid kept through a save and a restore.
TEST(SoilLoad, WorkIsStoredOrSlid) {
  model::Model model;
  fill_with_sliders(model);
  model.freeze(model::Form::multipliers);
  kit::DenseAssembly dense(model);
  model::Batch* batch = kit::find_batch(model, effect);
  model::State state = kit::random_state(model, 3);
  const Stencil stencil{0.4, 0.5, 0.5, 0.0};
  double stored = batch->stored_energy(model.nodes().reference());
  EXPECT_EQ(stored, 0.0);
  state.prev = model.nodes().reference();
  for (const int seed : {3, 4}) {
    state.next = kit::random_state(model, seed).next;
    dense.prepare(state, stencil);
    const Eigen::VectorXd force = kit::node_rows(model, dense.residual(state, stencil, {batch}));
    double work = 0.0;
    for (std::size_t i = 0; i < state.next.size(); ++i) {
      work += force[static_cast<Eigen::Index>(i)] * (state.next[i] - state.prev[i]);
    }
    const double slid = batch->step_work(state, stencil).damping;
    dense.accept(state);
    std::vector<double> memory(batch->memory_size());
    batch->save(model::Items::owned, memory);
    batch->restore(memory);
    const double now = batch->stored_energy(state.next);
    EXPECT_GT(slid, 1e-3);
    EXPECT_NEAR(work, now - stored + slid, 1e-13 * (1.0 + now + slid));
    stored = now;
    state.prev = state.next;
  }
}

TEST(SoilLoad, NullSpaceResidualIsProjected) { kit::expect_residual_is_projected(fill, effect); }
TEST(SoilLoad, AssemblesWithoutHeap) {
  kit::expect_no_allocation(fill, effect);
  kit::expect_no_allocation(fill_with_sliders, effect);
}

TEST(SoilLoad, WorkIsTheChangeOfThePotential) {
  model::Model model;
  fill(model);
  model.freeze(model::Form::multipliers);
  kit::DenseAssembly dense(model);
  const std::vector<model::Batch*> batches{kit::find_batch(model, effect)};
  const model::State state = kit::random_state(model, 3);
  const Stencil stencil{0.4, 0.5, 0.5, 0.0};
  dense.prepare(state, stencil);
  const Eigen::VectorXd force = kit::node_rows(model, dense.residual(state, stencil, batches));
  double work = 0.0;
  for (std::size_t i = 0; i < state.next.size(); ++i) {
    work += force[static_cast<Eigen::Index>(i)] * (state.next[i] - state.prev[i]);
  }
  const double before = batches[0]->stored_energy(state.prev);
  const double after = batches[0]->stored_energy(state.next);
  EXPECT_GT(std::abs(after - before), 1e-3);
  EXPECT_NEAR(work, after - before, 1e-13 * (before + after));
}

// A line of two elements from z = 4 to -12 with two quadrature points each.
void add_pile(model::Model& model) {
  model::Structure& pile = model.add_structure("pile");
  for (const double z : {4.0, -4.0, -12.0}) {
    model::NodeSlots node;
    node << Vec3(0.0, 0.0, z), Mat3::Identity();
    pile.nodes.push_back(model.nodes().add(node));
  }
  for (int e = 0; e < 2; ++e) {
    pile.cells.push_back({{e, e + 1}, nullptr, 0});
    for (int p = 0; p < 2; ++p) pile.line_points.push_back({{{e, e + 1}, {0.5, 0.5}}, 4.0});
  }
}

struct Built {
  std::vector<Station> stations;
  std::vector<std::string> issues;
};

Options layer_list(const Schema& schema, const std::string& type, const kit::GivenValues& values,
                   const std::string& name) {
  Options list = kit::deck_list(*schema.find_slot("Layers")->schema->find_slot(name)->find(type),
                                values, name);
  list.set("Type", type);
  return list;
}

Built build(const kit::GivenValues& values, double top) {
  model::Model model;
  add_pile(model);
  model::BuilderRegistry registry;
  register_soil(registry);
  const Schema schema = registry.variants().at("Soil");
  Options options = kit::deck_list(schema, values, "soil");
  Options layers("Layers", options.where());
  layers.declare_entries();
  layers.add_entry(layer_list(schema, "Springs",
                              {{"Top", top},
                               {"Depths", std::vector<double>{0.0, 10.0}},
                               {"Stiffnesses", std::vector<double>{0.0, 5.0}}},
                              "above"));
  options.add_list(layers);
  const std::map<std::string, model::Amplitude> functions;
  InputIssues issues;
  model::BuildContext context{model, functions, issues};
  registry.make("Soil", options, context);
  Built built;
  for (const InputIssue& issue : issues.sorted()) built.issues.push_back(issue.message);
  for (const auto& load : model.loads()) {
    built.stations = dynamic_cast<const SoilLoad&>(*load).stations();
  }
  return built;
}

const kit::GivenValues pile{{"Structure", std::string("pile")}, {"Diameter", 2.0}, {"Stations", 6}};

// The part in the ground is 12 long and not a whole number of elements.
TEST(Soil, StationsDivideThePartInTheGround) {
  const Built built = build(pile, 0.0);
  ASSERT_THAT(built.issues, testing::IsEmpty());
  ASSERT_EQ(built.stations.size(), 6u);
  for (std::size_t i = 0; i < 6; ++i) {
    const Station& station = built.stations[i];
    EXPECT_NEAR(station.length, 2.0, 1e-9);
    EXPECT_LT((station.along - Vec3(0.0, 0.0, -1.0)).norm(), 1e-9);
    const double depth = 1.0 + 2.0 * static_cast<double>(i);
    EXPECT_NEAR(station.lateral->slope(0.0), std::min(5.0, 0.5 * depth), 1e-9);
  }
}

TEST(Soil, BeginsWhereTheFirstLayerDoes) { EXPECT_EQ(build(pile, 5.5).stations.size(), 3u); }

TEST(Soil, MistakesAreNamed) {
  EXPECT_THAT(build(pile, 20.0).issues,
              testing::ElementsAre(testing::HasSubstr("begin below the tip")));
  kit::GivenValues high = pile;
  high.emplace_back("Ground", std::vector<double>{0.0, 0.0, -20.0});
  EXPECT_THAT(build(high, 0.0).issues,
              testing::ElementsAre(testing::HasSubstr("no end in the ground")));
}

}  // namespace
}  // namespace culm::soil
