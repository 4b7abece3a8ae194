/// A model in motion without deck: what the tests of time stepping share.
#pragma once

#include <culm/analysis/analysis.hpp>
#include <culm/analysis/predictor.hpp>
#include <culm/analysis/time_scheme.hpp>

#include <culm_kit/chain_model.hpp>

#include <functional>
#include <memory>

namespace culm::analysis {

/// A model with velocities, its equations, and single steps of a scheme.
class Motion {
 public:
  explicit Motion(const std::function<void(model::Model&)>& build,
                  std::unique_ptr<TimeScheme> time_scheme = std::make_unique<ConservingScheme>(),
                  solver::NewtonSettings settings = {})
      : scheme(std::move(time_scheme)) {
    build(model);
    model.freeze(model::Form::null_space);
    system = std::make_unique<assembly::System>(model, comm, ledger);
    linear = solver::make_rooted_klu2(system->matrix(), comm);
    settings.force_tolerance = 1e-12;
    newton = std::make_unique<solver::NewtonSolver>(*system, *linear, settings, ledger);
    state = model.initial_state();
    state.velocity.assign(state.next.size(), 0.0);
    model.add_initial_velocities(state.next, state.velocity);
    state.at_rest = false;
    scheme->start(state);
  }

  /// Solves a step of length h [s]; accepts nothing.
  solver::StepOutcome solve(double h) {
    state.time = state.time_prev + h;
    stencil = scheme->begin(state, h);
    system->begin_step(state, stencil);
    Predictor(*system).predict(state, h);
    return newton->solve(state, stencil);
  }
  void finish(double h) {
    scheme->finish(state, h);
    accept(state);
  }
  void advance(double h, int steps) {
    for (int i = 0; i < steps; ++i) {
      if (!solve(h).converged()) throw std::runtime_error("a step did not converge");
      finish(h);
    }
  }

  parallel::Comm comm;
  Ledger ledger;
  model::Model model;
  std::unique_ptr<TimeScheme> scheme;
  std::unique_ptr<assembly::System> system;
  std::unique_ptr<solver::LinearSolver> linear;
  std::unique_ptr<solver::NewtonSolver> newton;
  model::State state;
  Stencil stencil;
};

/// A body of three different inertias that spins fast about a fixed point, d2 its axis.
inline void build_top(model::Model& model) {
  model::NodeSlots slots;
  slots << Vec3::Zero(), Mat3::Identity();
  model::Structure& structure = model.add_structure("top");
  structure.nodes = {model.nodes().add(slots)};
  SlotMatrix<4> mass = SlotMatrix<4>::Zero();
  mass(0, 0) = 15.0;
  mass(0, 2) = mass(2, 0) = 15.0;
  mass.diagonal().tail<3>() = Vec3(0.2, 15.1, 0.3);
  model.masses("Rigid bodies").add(0, mass);
  model.add_constraint(kit::pin(model, 0));
  model.add_initial_velocity({0, Vec3::Zero(), Vec3(1.0, 150.0, -4.6), Vec3::Zero()});
}

/// A free chain that turns and stretches.
inline void build_free_chain(model::Model& model) {
  kit::add_chain(model, 6);
  for (int node = 0; node <= 6; ++node) {
    model.add_initial_velocity(
        {node, Vec3(1.0, 0.1 * node * node, 0.0), Vec3(0.2, 0.1, 1.0), Vec3::Zero()});
  }
}

}  // namespace culm::analysis
