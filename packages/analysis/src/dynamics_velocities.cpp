// Velocities that constraints allow: at the start, behind corners of prescribed motions, and what
// is missing at the end.
#include <culm/analysis/dynamics.hpp>
#include <culm/base/error.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace culm::analysis {
namespace {

// Of all places and directors [m/s]; collective.
double find_fastest(const assembly::System& system, const model::Coordinates& velocity) {
  double fastest = 0.0;
  const double length = system.model().length();
  const int nodes = static_cast<int>(velocity.size() / 12);
  for (int node = 0; node < nodes; ++node) {
    const auto slots = model::NodeTable::slots(velocity, node);
    for (int s = 0; s < 4; ++s) {
      fastest = std::max(fastest, assembly::speed_of(s, slots.col(s), length));
    }
  }
  return system.comm().max(fastest);
}

assembly::System::Solve mass_solver(Context& context, const model::State& state) {
  return [&](const assembly::Vector& b, assembly::Vector& x) {
    if (!context.linear.factor_for(b) || !context.linear.solve(b, x).is_sound()) {
      PostMortem::refuse_massless(context, state);
    }
  };
}

// What velocities did not fit: the equation that was violated most, or the support that holds the
// node where they changed most.
const model::Constraint* find_cause(const model::Model& model, const assembly::VelocityFit& fit) {
  const model::Constraint* cause = nullptr;
  if (fit.equation >= 0) cause = &model.equations()[static_cast<std::size_t>(fit.equation)];
  for (const model::Constraint& c : model.constraints()) {
    if (cause != nullptr || c.velocity_rows.empty()) continue;
    if (model.nodes().master(c.nodes.front()) == fit.node) cause = &c;
  }
  for (const model::Constraint& c : model.constraints()) {
    if (cause == nullptr && c.fix && model.nodes().master(c.fix->node) == fit.node) cause = &c;
    if (c.link && c.link->slave == fit.node) cause = &c;
  }
  return cause;
}

// How much velocities changed, of a place or of an angle.
std::string describe_change(const model::Model& model, const assembly::VelocityFit& fit) {
  if (!fit.is_turn) return fmt::format("{:.3g} m/s", fit.change);
  return fmt::format("{:.3g} rad/s", fit.change / model.length());
}

// Where velocities changed most, and what they did not fit.
std::string describe_place(const model::Model& model, const assembly::VelocityFit& fit) {
  if (fit.node < 0) return {};
  std::string text = fmt::format(" at '{}'", model.node_name(fit.node));
  const model::Constraint* cause = find_cause(model, fit);
  if (cause != nullptr && !cause->name.empty())
    text += fmt::format(", by {} '{}'", cause->type, cause->name);
  return text;
}

// The deck may displace bodies out of their joints.
void close_joints(Context& context, model::State& state) {
  const double change = context.system.project_position(state, mass_solver(context, state));
  if (std::isinf(change)) {
    throw NumericalError(
        "No position fits the constraints near the initial displacements.\n"
        "Try: displace the bodies of a closed loop so that its joints nearly meet.");
  }
  if (change > 1e-9 * context.system.model().length()) {
    context.log.info(fmt::format(
        "note: initial displacements were made to fit the constraints; largest change {:.3g}",
        change));
  }
}

// Rates of directors at the end of a step are not quite rigid, those that fit are. What is struck
// takes the rigid ones, or the rest would ring and grow; what is not struck, and what has momenta
// to keep, takes the difference.
void add_jumps(model::Coordinates& velocity, const model::Coordinates& rigid,
               const model::Coordinates& fitted, bool keeps_momenta, const parallel::Comm& comm) {
  constexpr double struck = 1e-3;  // of the largest jump
  const int nodes = static_cast<int>(velocity.size() / 12);
  const auto jump = [&](int node) -> model::NodeSlots {
    return model::NodeTable::slots(fitted, node) - model::NodeTable::slots(rigid, node);
  };
  double largest = 0.0;
  for (int node = 0; node < nodes; ++node) largest = std::max(largest, jump(node).norm());
  largest = comm.max(largest);
  for (int node = 0; node < nodes; ++node) {
    auto slots = model::NodeTable::slots(velocity, node);
    if (!keeps_momenta && jump(node).norm() > struck * largest) {
      slots = model::NodeTable::slots(fitted, node);
    } else {
      slots += jump(node);
    }
  }
}

void no_change(const assembly::Vector&, assembly::Vector& x) { x.fill(0.0); }

// Leaves nothing of a solution but what it says of the forces of constraints.
void keep_multipliers(const assembly::System& system, assembly::Vector& solution) {
  const model::Model& model = system.model();
  const auto u = solution.values();
  for (const assembly::Layout::LocalBlock& local : system.layout().local_blocks()) {
    const model::Block block = model.unknowns().block(local.block);
    if (!local.owned || block.kind == model::BlockKind::multipliers) continue;
    for (int i = 0; i < block.shape.width; ++i) {
      const int at = block.shape.position[static_cast<std::size_t>(i)];
      if (at < 0) continue;
      const bool is_force = block.kind == model::BlockKind::own &&
                            model.own_blocks()[static_cast<std::size_t>(block.owner)]
                                    .unknowns[static_cast<std::size_t>(i)]
                                    .kind == model::UnknownKind::multiplier;
      if (!is_force) u[static_cast<std::size_t>(local.first_column + at)] = 0.0;
    }
  }
}

}  // namespace

// Motion that constraints do not allow would never decay, so it is removed.
void Dynamics::fit_motion() {
  model::State& state = this->state();
  if (state.at_rest && system().model().has_initial_displacements()) {
    close_joints(context(), state);
  }
  state.acceleration_offset.assign(state.velocity.size(), 0.0);
  // what a motion ends with fulfils the constraints to the second order of its step only
  const double tolerance = state.at_rest ? 1e-9 : 1e-4;
  // the deck's velocities belong to the first motion; a later analysis goes on with what it finds
  if (state.at_rest) system().model().add_initial_velocities(state.next, state.velocity);
  state.at_rest = false;
  model::Coordinates fitted;
  const assembly::VelocityFit fit =
      system().project_velocity(state, probe(), mass_solver(context(), state), fitted);
  state.velocity.swap(fitted);
  const double fastest = find_fastest(system(), state.velocity);
  // speeds of drives are differences, of which rounding takes its share
  const double notable = std::max(tolerance * fastest, smallest_speed());
  if (fit.change > notable) {
    const model::Model& model = system().model();
    context().findings.warn("initial velocities",
                            "initial velocities were made to fit the constraints; largest change " +
                                describe_change(model, fit) + describe_place(model, fit),
                            state.time);
  }
}

// Speeds of drives are differences over a short time, but not so short that rounding of the time
// shows.
double Dynamics::probe() const {
  const double step = settings_.steps.step;
  return std::min(0.5 * step, std::max(1e-4 * step, 2e-10 * std::abs(state().time)));
}

// Below it nothing comes far in a step [m/s].
double Dynamics::smallest_speed() const {
  return 1e-9 * system().model().length() / settings_.steps.step;
}

std::optional<assembly::VelocityFit> Dynamics::find_fitting(model::Coordinates& fitted,
                                                            assembly::Vector& solution) {
  solver::LinearSolver& linear = context().linear;
  bool sound = true;
  const assembly::VelocityFit fit = system().project_velocity(
      state(), probe(),
      [&](const assembly::Vector& b, assembly::Vector& x) {
        sound = linear.factor_for(b) && linear.solve(b, x).is_sound();
        if (!sound) x.fill(0.0);
        solution = x;
      },
      fitted);
  return sound ? std::optional(fit) : std::nullopt;
}

// A step mirrors velocities about its mean ones. Where the speed of a prescribed motion jumps they
// would stay on one side in one step and on the other in the next, for ever. So the drive strikes
// where the step behind the jump begins: velocities become those that constraints allow, all that
// is tied follows by its inertia, and momenta are kept. Reactions show the blow over that step.
void Dynamics::strike() {
  model::State& state = this->state();
  state.time =
      state.time_prev + DrivenCorners::same_time * settings_.steps.step;  // on the far side
  model::Coordinates fitted;
  assembly::Vector solution(system().layout().rows());
  if (!find_fitting(fitted, solution)) return;
  model::Coordinates rigid;
  system().project_velocity(state, probe(), no_change, rigid);
  const double kinetic = system().momentum(state.next, state.velocity).kinetic_energy;
  const model::Coordinates before = state.velocity;
  add_jumps(state.velocity, rigid, fitted, certificate_.is_free(), system().comm());
  keep_multipliers(system(), solution);
  blow_ = Blow{before, std::move(solution), 0.0};
  blow_->work = system().momentum(state.next, state.velocity).kinetic_energy - kinetic;
  // old factors would be those of the mass
  if (settings_.newton.refresh == solver::Refresh::on_slow_convergence) {
    make_newton(settings_.newton);
  }
}

// Multipliers show it until the attempt is accepted, and then again. What supports without
// equations take is the inertia of the jump, too, which another look at the step finds; where
// nothing is held, nothing must look there again.
void Dynamics::show_blow(double step) {
  model::State& state = this->state();
  system().move(state, blow_->multipliers, 1.0 / step);
  if (certificate_.is_free()) return;
  const model::Coordinates offset = state.acceleration_offset;
  const auto with_jump = [step](double without, double after, double before) {
    return without + (after - before) / step;
  };
  model::combine(state.acceleration_offset, with_jump, state.velocity, blow_->velocity);
  system().evaluate(state, stencil_, Want::residual);
  state.acceleration_offset = offset;
}

void Dynamics::take_blow_back() {
  if (blow_) state().velocity = std::move(blow_->velocity);
  blow_.reset();
}

// The state keeps its velocity: its own energy would change.
void Dynamics::measure_hidden_constraints() {
  if (is_behind_corner_) return;  // which the next motion makes fit
  model::Coordinates fitted;
  assembly::Vector solution(system().layout().rows());
  const std::optional<assembly::VelocityFit> found = find_fitting(fitted, solution);
  if (!found) return;
  const assembly::VelocityFit& fit = *found;
  const double fastest = find_fastest(system(), fitted);
  const double usual = certificate_.largest_mean_speed();
  certificate_.finish(fit.change, std::max(fastest, usual));
  constexpr double notable = 0.1;          // of the velocities there
  constexpr double notable_of_all = 0.01;  // of those before: what came to rest has none
  const model::Constraint* cause = find_cause(system().model(), fit);
  const bool is_driven = cause != nullptr && (cause->is_driven() || !cause->velocity_rows.empty());
  if (!is_driven || fit.change <= std::max(notable * fastest, notable_of_all * usual) ||
      fit.change <= smallest_speed()) {
    return;
  }
  context().findings.warn(
      "alternating velocities",
      fmt::format(
          "constraints do not allow {} of the velocities at the end{}: behind a corner of a "
          "prescribed motion that a formula hides or no step sees, "
          "velocities, "
          "kinetic energies and reactions alternate from step to step about their means; take a "
          "table, or a function without corners",
          describe_change(system().model(), fit), describe_place(system().model(), fit)),
      state().time);
}

}  // namespace culm::analysis
