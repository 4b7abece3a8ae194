/// A model in motion without deck: what the tests of time stepping share.
#pragma once

#include <culm/analysis/dynamics.hpp>

#include <culm_kit/chain_model.hpp>

#include <functional>
#include <memory>
#include <sstream>
#include <stdexcept>

namespace culm::analysis {

/// A model with velocities, and the stepper of its motion, begun, with steps of any length.
class Motion {
 public:
  explicit Motion(const std::function<void(model::Model&)>& build,
                  std::unique_ptr<TimeScheme> scheme = std::make_unique<ConservingScheme>(),
                  solver::NewtonSettings newton = {})
      : error_constant(scheme->error_constant()) {
    build(model);
    model.freeze(model::Form::null_space);
    system = std::make_unique<assembly::System>(model, comm, ledger);
    linear = solver::make_rooted_klu2(system->matrix(), comm);
    state = model.initial_state();
    context = std::make_unique<Context>(Context{*system, *linear, ledger, log, findings});
    newton.force_tolerance = 1e-12;
    DynamicsSettings settings;
    settings.steps = {1e9, 1.0, 0.0, {}};
    settings.newton = newton;
    stepper = std::make_unique<Dynamics>(std::move(settings), std::move(scheme), *context, state);
    stepper->fit();
    stepper->begin();
  }

  /// Attempts a step of length h [s].
  const StepReport& attempt(double h) { return stepper->attempt(state.time_prev + h); }
  /// Makes steps of length h [s].
  void advance(double h, int steps = 1) {
    for (int i = 0; i < steps; ++i) {
      if (!attempt(h).accepted) throw std::runtime_error("a step did not converge");
      stepper->accept();
    }
  }

  parallel::Comm comm;
  Ledger ledger;
  std::ostringstream said;
  Log log{said, LogLevel::info};
  Findings findings{log};
  model::Model model;
  double error_constant;
  std::unique_ptr<assembly::System> system;
  std::unique_ptr<solver::LinearSolver> linear;
  model::State state;
  std::unique_ptr<Context> context;
  std::unique_ptr<Dynamics> stepper;
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
