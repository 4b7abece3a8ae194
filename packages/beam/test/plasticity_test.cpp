#include <culm/beam/beam_structure.hpp>
#include <culm/beam/element_batches.hpp>
#include <culm/material/fibres.hpp>
#include <culm/structure/plastic_batch.hpp>

#include <culm_kit/batch_laws.hpp>
#include <culm_kit/deck_list.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace culm::beam {
namespace {

using Numbers = std::vector<double>;
constexpr const char* plastic_part = "Plasticity, bar";
constexpr double E = 200.0;

// A rectangle 0.2 x 0.5 off the axis that yields early.
material::Section yielding_section(double yield_stress) {
  material::Section section;
  section.fibres = material::rectangle_fibres({-0.1, -0.2}, {0.1, 0.3}, {1, 4});
  section.plasticity = {E, {.yield_stress = yield_stress, .isotropic = 10.0, .kinematic = 5.0}};
  section.stiffness.diagonal() << 8.0, 8.0, 0.0, 0.0, 0.0, 0.5;
  for (const material::Fibre& fibre : section.fibres) {
    const Vec3 map(1.0, fibre.place[1], -fibre.place[0]);
    section.stiffness.block<3, 3>(2, 2) += E * fibre.area * map * map.transpose();
  }
  section.mass = Vec3(1.0, 0.02, 0.02).asDiagonal();
  return section;
}

void add_bar(model::Model& model, const kit::GivenValues& values, double yield_stress) {
  std::map<std::string, material::Section> sections{{"steel", yielding_section(yield_stress)}};
  std::map<std::string, material::Material> materials;
  InputIssues issues;
  std::ostringstream messages;
  Log log{messages, LogLevel::info};
  structure::StructureContext context{model, sections, materials, issues, log};
  const Schema schema = beam_schema();
  kit::GivenValues all{{"Section", std::string("steel")}};
  all.insert(all.end(), values.begin(), values.end());
  Options options = kit::deck_list(schema, all, "bar");
  Options line = kit::deck_list(
      *schema.find_slot("Curve")->find("Line"),
      {{"From", Numbers{0, 0, 0}}, {"To", Numbers{0, 0, 1.5}}, {"Elements", 2}}, "Curve");
  line.set("Type", std::string("Line"));
  options.add_list(line);
  add_beam(options, context);
}

struct Kind {
  kit::GivenValues values;
  std::string effect;  // of its elements
};
const std::vector<Kind> kinds = {
    {{{"Order", 1}}, "Beam, director, order 1"},
    {{{"Order", 2}}, "Beam, director, order 2"},
    {{{"Order", 3}}, "Beam, director, order 3"},
    {{{"Order", 2}, {"Fidelity", std::string("Linear")}}, "Beam, linear, order 2"},
};

kit::FillModel filled(const Kind& kind, double yield_stress = 1.0) {
  return [&kind, yield_stress](model::Model& model) { add_bar(model, kind.values, yield_stress); };
}

TEST(YieldingBeam, NullSpaceResidualIsProjected) {
  for (const Kind& kind : kinds) kit::expect_residual_is_projected(filled(kind), plastic_part);
}
TEST(YieldingBeam, AssemblesWithoutHeap) {
  for (const Kind& kind : kinds) kit::expect_no_allocation(filled(kind), plastic_part);
}
TEST(YieldingBeam, AttemptsLeaveNoTrace) {
  for (const Kind& kind : kinds) kit::expect_attempts_leave_no_trace(filled(kind), plastic_part);
}

// From a state on the yield surface, as all states of steps that were accepted. Differences do not
// cross the corners of the law here.
TEST(YieldingBeam, TangentIsDerivativeOfResidual) {
  for (const Kind& kind : kinds) {
    for (const Stencil& stencil : kit::law_stencils) {
      SCOPED_TRACE(testing::Message() << kind.effect << ", theta " << stencil.theta);
      model::Model model;
      filled(kind)(model);
      model.freeze(model::Form::null_space);
      const kit::DenseAssembly::Batches tested = {kit::find_batch(model, plastic_part)};
      model::State state = kit::random_state(model, 3);
      kit::DenseAssembly dense(model);
      state.prev = model.initial_state().prev;
      dense.prepare(state, Stencil::statics());
      dense.accept(state);
      state.prev = state.next;
      state.next = kit::random_state(model, 4).next;
      dense.prepare(state, stencil);
      const Eigen::MatrixXd K = dense.tangent(state, stencil, tested);
      const Eigen::MatrixXd expected = dense.difference_tangent(state, stencil, tested, 1e-5);
      EXPECT_LT(kit::largest(K - expected), 1e-7 * kit::largest(expected));
    }
  }
}

// What stresses do over two steps of the conserving scheme is stored or becomes heat.
TEST(YieldingBeam, EnergyBalanceIsExact) {
  for (const Kind& kind : kinds) {
    SCOPED_TRACE(kind.effect);
    model::Model model;
    filled(kind)(model);
    model.freeze(model::Form::multipliers);
    kit::DenseAssembly dense(model);
    const std::vector<model::Batch*> batches{kit::find_batch(model, kind.effect),
                                             kit::find_batch(model, plastic_part)};
    const auto stored = [&](const model::Coordinates& q) {
      return batches[0]->stored_energy(q) + batches[1]->stored_energy(q);
    };
    model::State state = model.initial_state();
    for (const int seed : {3, 4, 5}) {
      state.next = kit::random_state(model, seed).next;
      state.time = state.time_prev + 0.4;
      const Stencil stencil{0.4, 0.5, 0.5, 0.0};  // without inertia
      const double before = stored(state.prev);
      dense.prepare(state, stencil);
      const Eigen::VectorXd force = kit::node_rows(model, dense.residual(state, stencil, batches));
      double work = 0.0;
      for (std::size_t i = 0; i < state.next.size(); ++i) {
        work += force[static_cast<Eigen::Index>(i)] * (state.next[i] - state.prev[i]);
      }
      const double heat = batches[1]->step_work(state, stencil).damping;
      dense.accept(state);
      const double after = stored(state.next);
      EXPECT_GT(heat, 1e-3);
      EXPECT_NEAR(work, after - before + heat, 1e-12 * (before + after + heat));
      state.prev = state.next;
      state.time_prev = state.time;
    }
  }
}

// Far from yielding there is nothing that the elastic beam has not.
TEST(YieldingBeam, IsElasticBelowItsYieldStress) {
  model::Model model;
  filled(kinds[1], 1e9)(model);
  model.freeze(model::Form::null_space);
  kit::DenseAssembly dense(model);
  const model::State state = kit::random_state(model, 3);
  const std::vector<model::Batch*> batches{kit::find_batch(model, plastic_part)};
  dense.prepare(state, Stencil::statics());
  EXPECT_TRUE(dense.residual(state, Stencil::statics(), batches).isZero(0.0));
  EXPECT_TRUE(dense.tangent(state, Stencil::statics(), batches).isZero(0.0));
}

// Pulled far: all fibres yield alike, and the force shown is that of the law.
TEST(YieldingBeam, ShowsTheForceOfItsFibres) {
  model::Model model;
  filled(kinds[1])(model);
  model.freeze(model::Form::null_space);
  kit::DenseAssembly dense(model);
  model::State state = model.initial_state();
  for (int node = 0; node < model.nodes().size(); ++node) {
    model::NodeTable::slots(state.next, node)(2, 0) *= 1.05;
  }
  dense.prepare(state, Stencil::statics());
  dense.residual(state, Stencil::statics(), {kit::find_batch(model, plastic_part)});
  dense.accept(state);
  const double plastic = (E * 0.05 - 1.0) / (E + 15.0);
  const model::Cell& cell = model.find_structure("bar")->cells[1];
  std::vector<double> found;
  cell.source->resultants(cell.item, state.next, found);
  EXPECT_NEAR(found[2], 0.1 * (1.0 + 15.0 * plastic), 1e-12);
  EXPECT_NEAR(found[3], 0.05 * found[2], 1e-12);  // about the axis, the centre is at xi2 = 0.05
  EXPECT_NEAR(found[4], 0.0, 1e-12);
}

TEST(YieldingBeam, OtherElementsAreRefused) {
  const auto message = [](const kit::GivenValues& values) {
    model::Model model;
    try {
      add_bar(model, values, 1.0);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  for (const char* fidelity : {"Kirchhoff"}) {
    EXPECT_THAT(message({{"Fidelity", std::string(fidelity)}}), testing::HasSubstr("yield"));
  }
  EXPECT_THAT(message({{"Torsion", false}}), testing::HasSubstr("yield"));
  EXPECT_THAT(message({{"Element", std::string("Helical")}}), testing::HasSubstr("yield"));
  EXPECT_EQ(message({{"Fidelity", std::string("Rigid")}}), "");
}

}  // namespace
}  // namespace culm::beam
