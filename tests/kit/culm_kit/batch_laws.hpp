/// Laws that every batch obeys in both forms of the equations, with and without eliminated nodes.
#pragma once

#include <culm_kit/dense_assembly.hpp>
#include <culm_kit/no_heap.hpp>
#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace culm::kit {

/// Statics, the conserving step, and a step with numerical dissipation.
inline const std::vector<Stencil> law_stencils = {
    Stencil::statics(), Stencil::midpoint(0.4), {0.4, 0.5, 0.75}};

/// Kind of a node of a contract's case: that of `static constexpr NodeKind node_kind(int node)`,
/// a triad where the case has none.
template <class Case>
constexpr NodeKind kind_of(int node) {
  if constexpr (requires { Case::node_kind(node); }) {
    return Case::node_kind(node);
  } else {
    return NodeKind::node12;
  }
}

/// Names the batch that a test looks at.
inline constexpr const char* effect = "tested";

/// Fills a model; called anew for each form.
using FillModel = std::function<void(model::Model&)>;

inline model::Batch* find_batch(const model::Model& model, const std::string& title) {
  for (model::Batch* batch : model.batches()) {
    if (batch->effect().title() == title) return batch;
  }
  return nullptr;
}

inline double largest(const Eigen::MatrixXd& m) { return m.cwiseAbs().maxCoeff(); }

/// The tangent of a batch is the derivative of its residual under the update of the solver.
/// @param step of differences; laws that are not polynomials need a small one
/// @source formulation 6.7
inline void expect_tangent_is_derivative(const FillModel& fill, const std::string& title,
                                         double step = 2e-3) {
  for (const model::Form form : {model::Form::null_space, model::Form::multipliers}) {
    for (const Stencil& stencil : law_stencils) {
      SCOPED_TRACE(testing::Message() << "form " << static_cast<int>(form) << ", theta "
                                      << stencil.theta << " / " << stencil.theta_strain);
      model::Model model;
      fill(model);
      model.freeze(form);
      const DenseAssembly::Batches tested = {find_batch(model, title)};
      ASSERT_NE(tested.front(), nullptr);
      const model::State state = random_state(model, 3);
      DenseAssembly dense(model);
      dense.prepare(state, stencil);
      const Eigen::MatrixXd K = dense.tangent(state, stencil, tested);
      const Eigen::MatrixXd expected = dense.difference_tangent(state, stencil, tested, step);
      const double scale = 1.0 + largest(dense.residual(state, stencil, tested));
      EXPECT_LT(largest(K - expected), 1e-11 * (scale + largest(expected)));
      EXPECT_TRUE(tested.front()->has_tangent() || K.isZero(0.0));
    }
  }
}

/// Gives the multipliers of all constraints of a name the same values, whatever their number.
inline void set_multipliers(const model::Model& model, const std::string& name,
                            model::State& state) {
  for (std::size_t c = 0; c < model.equations().size(); ++c) {
    if (model.equations()[c].name != name) continue;
    const auto& block =
        model.unknowns().block(model.unknowns().constraint_block(static_cast<int>(c)));
    Random random(17);
    for (int i = 0; i < block.shape.width; ++i) {
      state.multipliers[static_cast<std::size_t>(block.first_value + i)] = random.number();
    }
  }
}

/// The node rows of a residual, for all nodes, zero where there are none.
inline Eigen::VectorXd node_rows(const model::Model& model, const Eigen::VectorXd& residual) {
  const bool reduced = model.unknowns().form() == model::Form::null_space;
  const int width = reduced ? 6 : 12;
  Eigen::VectorXd rows = Eigen::VectorXd::Zero(width * model.nodes().size());
  for (const model::Block& block : model.unknowns().blocks()) {
    if (block.kind != model::BlockKind::node || block.shape.active == 0) continue;
    rows.segment(width * block.owner, block.shape.width) =
        residual.segment(block.first, block.shape.width);
  }
  return rows;
}

/// The residual of the null-space form is P(q_theta)^T times that of the multiplier form.
/// No node of the model may have supports. @source formulation 6.2
inline void expect_residual_is_projected(const FillModel& fill, const std::string& title,
                                         const std::vector<Stencil>& stencils = law_stencils) {
  model::Model reduced;
  model::Model full;
  fill(reduced);
  fill(full);
  reduced.freeze(model::Form::null_space);
  full.freeze(model::Form::multipliers);
  DenseAssembly reduced_system(reduced);
  DenseAssembly full_system(full);
  for (const Stencil& stencil : stencils) {
    SCOPED_TRACE(testing::Message() << "theta " << stencil.theta);
    model::State state = random_state(reduced, 4);
    model::State full_state = full.initial_state();
    full_state.time_prev = state.time_prev;
    full_state.time = state.time;
    full_state.prev = state.prev;
    full_state.next = state.next;
    full_state.velocity = state.velocity;
    full_state.acceleration_offset = state.acceleration_offset;
    set_multipliers(reduced, title, state);
    set_multipliers(full, title, full_state);
    full_state.own_prev = state.own_prev;
    full_state.own = state.own;
    reduced_system.prepare(state, stencil);
    full_system.prepare(full_state, stencil);
    const Eigen::VectorXd r =
        node_rows(reduced, reduced_system.residual(state, stencil, {find_batch(reduced, title)}));
    const Eigen::VectorXd R =
        node_rows(full, full_system.residual(full_state, stencil, {find_batch(full, title)}));
    const Eigen::MatrixXd P = null_space_matrix(reduced.nodes(), at_theta(state, stencil.theta));
    ASSERT_GT(largest(R), 0.0);
    EXPECT_LT(largest(r - P.transpose() * R), 1e-13 * (1.0 + largest(R)));
  }
}

/// Two steps of a batch: what the second one sees, with `attempt` made before each of the first's
/// and the second's own evaluation.
inline std::pair<Eigen::VectorXd, Eigen::MatrixXd> second_step(
    const FillModel& fill, const std::string& title, const Stencil& stencil,
    const std::function<void(DenseAssembly&, const model::State&)>& attempt) {
  model::Model model;
  fill(model);
  model.freeze(model::Form::null_space);
  const DenseAssembly::Batches tested = {find_batch(model, title)};
  DenseAssembly dense(model);
  model::State state = random_state(model, 3);
  const model::State later = random_state(model, 8);
  attempt(dense, state);
  dense.prepare(state, stencil);
  dense.residual(state, stencil, tested);
  dense.accept(state);
  state.prev = state.next;
  state.next = later.next;
  state.time_prev = state.time;
  state.time += 0.4;
  attempt(dense, state);
  dense.prepare(state, stencil);
  return {dense.residual(state, stencil, tested), dense.tangent(state, stencil, tested)};
}

/// What was attempted and discarded leaves no trace, bit by bit: neither other ends of a step nor
/// other lengths, nor a preparation that nothing followed.
inline void expect_attempts_leave_no_trace(const FillModel& fill, const std::string& title) {
  const auto wander = [&](DenseAssembly& dense, const model::State& state) {
    for (const Stencil& other : law_stencils) {
      for (const int seed : {21, 22}) {
        model::State trial = state;
        trial.next = random_state(dense.model(), seed).next;
        trial.time = state.time_prev + 0.1 * seed;
        dense.prepare(trial, other);
        dense.tangent(trial, other, {find_batch(dense.model(), title)});
      }
    }
    dense.prepare(state, Stencil::statics());
  };
  for (const Stencil& stencil : law_stencils) {
    SCOPED_TRACE(testing::Message() << "theta " << stencil.theta << " / " << stencil.theta_strain);
    const auto undisturbed =
        second_step(fill, title, stencil, [](DenseAssembly&, const model::State&) {});
    const auto disturbed = second_step(fill, title, stencil, wander);
    EXPECT_EQ(undisturbed.first, disturbed.first);
    EXPECT_EQ(undisturbed.second, disturbed.second);
  }
}

/// Assembling the tangent in a step takes no memory from the heap, in neither form.
inline void expect_no_allocation(const FillModel& fill, const std::string& title) {
  for (const model::Form form : {model::Form::null_space, model::Form::multipliers}) {
    model::Model model;
    fill(model);
    model.freeze(form);
    DenseAssembly dense(model);
    const model::State state = random_state(model, 3);
    const Stencil stencil = Stencil::midpoint(0.4);
    dense.prepare(state, stencil);
    const DenseAssembly::Batches tested = {find_batch(model, title)};
    NoHeap guard;
    EXPECT_EQ(dense.assemble(state, stencil, Want::residual_and_tangent, tested), Verdict::ok);
  }
}

}  // namespace culm::kit
