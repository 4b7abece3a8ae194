#include <culm/analysis/newton_options.hpp>

namespace culm::analysis {

Schema newton_schema() {
  const solver::NewtonSettings defaults;
  return Schema("Newton", "How the nonlinear equations of a step are solved.")
      .add(number("Force Tolerance", "1",
                  "Largest force residual over the largest force of any element, load or joint.")
               .positive()
               .optional(defaults.force_tolerance))
      .add(number("Constraint Tolerance", "1",
                  "Largest constraint violation; lengths are divided by the size of the model.")
               .positive()
               .optional(defaults.constraint_tolerance))
      .add(integer("Maximum Iterations", "Iterations after which a step is given up.")
               .at_least(1)
               .optional(defaults.max_iterations))
      .add(flag("Stress Extrapolation",
                "Predict the stress in the geometric stiffness (mixed-integration-point Newton): "
                "fewer iterations, larger steps, same solution.")
               .optional(defaults.extrapolate_stress))
      .add(choice("Refresh", {"Every Iteration", "On Slow Convergence"},
                  "When the tangent is assembled and factored; between, old factors serve "
                  "(modified Newton): more iterations, each of them cheaper.")
               .optional("Every Iteration"))
      .add(choice("Line Search", {"Full Step", "Backtrack"},
                  "Whether steps that increase the residual are shortened.")
               .optional("Full Step"));
}

solver::NewtonSettings newton_settings(const Options& options) {
  solver::NewtonSettings settings;
  settings.force_tolerance = options.number("Force Tolerance");
  settings.constraint_tolerance = options.number("Constraint Tolerance");
  settings.max_iterations = options.integer("Maximum Iterations");
  settings.extrapolate_stress = options.flag("Stress Extrapolation");
  if (options.text("Refresh") == "On Slow Convergence") {
    settings.refresh = solver::Refresh::on_slow_convergence;
  }
  settings.backtrack = options.text("Line Search") == "Backtrack";
  return settings;
}

}  // namespace culm::analysis
