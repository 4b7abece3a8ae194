#include "newton_group.hpp"

#include <culm/base/error.hpp>

#include <algorithm>
#include <cmath>

namespace culm::solver {
namespace {

// With old factors an iteration is cheap, but its residual must fall at least so much.
constexpr double slow = 0.2;

// Of the stiffness, against motions that nothing resists: little beside what loads give them, and
// much beside rounding.
constexpr double held_share = 1e-8;

double relative_residual(const assembly::Evaluation& e) {
  const double force = e.force_scale > 0.0 ? e.force_residual / e.force_scale : 0.0;
  return std::max(force, e.constraint_violation);
}

// How far a linear system is solved where that is iterative: so far that Newton's method hardly
// notices, and no further than it needs. First solutions of 1e-2 save iterations, but lead thin
// plates astray, whose soft directions are the last to converge.
double forcing_term(double residual, double tolerance) {
  constexpr double finest = 1e-6;
  constexpr double roughest = 1e-2;
  constexpr double enough = 1e-3;  // of the tolerance; what lasts is judged by a hundredth of it
  const double needed = residual > 0.0 ? enough * tolerance / residual : roughest;
  return std::clamp(needed, finest, roughest);
}

}  // namespace

using assembly::Vector;

NewtonGroup::NewtonGroup(std::shared_ptr<NewtonProblem> problem)
    : problem_(std::move(problem)),
      x_(problem_->system.layout().rows()),
      f_(problem_->settings.backtrack
             ? Vector(problem_->system.layout().rows())
             : assembly::view_of(assembly::tpetra(problem_->system.residual()))),
      newton_(problem_->system.layout().rows()),
      shares_residual_(!problem_->settings.backtrack) {}

NewtonGroup::NewtonGroup(const NewtonGroup& other, NOX::CopyType type)
    : problem_(other.problem_),
      x_(other.x_, type),
      f_(other.f_, type),
      newton_(other.newton_, type) {
  if (type == NOX::DeepCopy) *this = other;
}

void NewtonGroup::start() {
  next_.swap(problem_->state->next);
  is_in_state_ = false;
  multipliers_ = problem_->state->multipliers;
  own_ = problem_->state->own;
  level_ = problem_->state->time;
  level_increment_ = 0.0;
  ++moves_;
  problem_->stress_waits = false;
  forget_results();
}

void NewtonGroup::finish() {
  if (!is_in_state_) swap_with_state();
}

void NewtonGroup::swap_with_state() {
  is_in_state_ = !is_in_state_;
  problem_->state->next.swap(next_);
  problem_->state->multipliers.swap(multipliers_);
  problem_->state->own.swap(own_);
  std::swap(problem_->state->time, level_);
}

void NewtonGroup::forget_results() { has_residual_ = has_tangent_ = has_newton_ = false; }

NOX::Abstract::Group& NewtonGroup::operator=(const NewtonGroup& other) {
  if (this == &other) return *this;
  forget_results();  // the system has one matrix, and it stays with the original
  start_of_ = problem_->settings.backtrack ? nullptr : &other;
  moves_ = other.moves_;
  if (start_of_ != nullptr) return *this;
  next_ = other.next_;
  multipliers_ = other.multipliers_;
  own_ = other.own_;
  level_ = other.level_;
  level_increment_ = other.level_increment_;
  evaluation_ = other.evaluation_;
  has_residual_ = other.has_residual_;
  has_newton_ = other.has_newton_;
  if (has_residual_) f_ = other.f_;
  if (has_newton_) newton_ = other.newton_;
  return *this;
}

NOX::Abstract::Group& NewtonGroup::operator=(const NOX::Abstract::Group& other) {
  return *this = dynamic_cast<const NewtonGroup&>(other);
}

void NewtonGroup::setX(const NOX::Abstract::Vector&) {}

void NewtonGroup::computeX(const NOX::Abstract::Group& from, const NOX::Abstract::Vector& direction,
                           double step) {
  const auto& copy = dynamic_cast<const NewtonGroup&>(from);
  const bool is_here = copy.start_of_ == this && copy.moves_ == moves_;
  internal_check(copy.start_of_ == nullptr || is_here,
                 "a step went on from a point that was not kept");
  const NewtonGroup& origin = is_here ? *this : copy;
  ++moves_;
  const auto& increment = NewtonVector::cast(direction);
  next_ = origin.next_;
  multipliers_ = origin.multipliers_;
  own_ = origin.own_;
  level_ = origin.level_ + step * origin.level_increment_;
  swap_with_state();
  NewtonProblem& p = *problem_;
  if (p.settings.extrapolate_stress) {
    // where a step of a motion is about to end, no tangent follows that would know it
    p.stress_waits = p.stencil.inertia != 0.0 && tangent_can_wait();
    if (!p.stress_waits) {
      p.system.extrapolate(*p.state, p.stencil, increment.get(), step);
    } else if (p.waiting) {
      p.waiting->from = p.state->next;
      p.waiting->increment = &increment.get();
      p.waiting->step = step;
    } else {
      p.waiting.emplace(p.state->next, &increment.get(), step);
    }
  }
  p.system.move(*p.state, increment.get(), step);
  if (p.condition != nullptr) p.system.change_level(*p.state, p.stencil);
  swap_with_state();
  forget_results();
}

// Whether the factors at hand are missing or bring the residual down too slowly.
bool NewtonGroup::needs_tangent() const {
  const NewtonProblem& p = *problem_;
  if (p.settings.refresh == Refresh::every_iteration || !p.has_factors) return true;
  if (p.stencil.inertia != p.factored_inertia) return true;
  return p.last_residual > 0.0 && relative_residual(evaluation_) > slow * p.last_residual;
}

// Modified Newton uses few tangents, and the last one of a step is of no use: most steps end after
// as many iterations as the step before.
bool NewtonGroup::tangent_can_wait() const {
  const NewtonProblem& p = *problem_;
  if (p.settings.refresh == Refresh::on_slow_convergence && p.has_factors) return true;
  return p.iterations > 0 && p.iterations == p.expected_iterations;
}

// Residual and tangent in one pass where both will be used: a separate pass for the residual costs
// a third of the joint one.
NOX::Abstract::Group::ReturnType NewtonGroup::computeF() {
  if (has_residual_) return Ok;
  swap_with_state();
  NewtonProblem& p = *problem_;
  const bool without_tangent = !tangent_wanted_ && tangent_can_wait();
  if (!without_tangent) extrapolate_late();
  evaluation_ = p.system.evaluate(*p.state, p.stencil,
                                  without_tangent ? Want::residual : Want::residual_and_tangent);
  if (p.condition != nullptr && evaluation_.verdict == Verdict::ok) {
    evaluation_.constraint_violation =
        std::max(evaluation_.constraint_violation, p.condition->violation(*p.state));
  }
  swap_with_state();
  if (!shares_residual_) f_.get() = p.system.residual();
  has_residual_ = evaluation_.verdict == Verdict::ok;
  has_tangent_ = has_residual_ && !without_tangent;
  return has_residual_ ? Ok : Failed;
}

// The stress that tangents at this point belong to, if it was left out.
void NewtonGroup::extrapolate_late() {
  NewtonProblem& p = *problem_;
  if (!p.stress_waits) return;
  p.state->next.swap(p.waiting->from);
  p.system.extrapolate(*p.state, p.stencil, *p.waiting->increment, p.waiting->step);
  p.state->next.swap(p.waiting->from);
  p.stress_waits = false;
}

NOX::Abstract::Group::ReturnType NewtonGroup::computeJacobian() {
  if (has_tangent_ || !needs_tangent()) return Ok;
  has_residual_ = false;
  tangent_wanted_ = true;
  const ReturnType result = computeF();
  tangent_wanted_ = false;
  return result;
}

assembly::RoundingCheck NewtonGroup::check_rounding(double limit, double most) const {
  const NewtonProblem& p = *problem_;
  return assembly::check_rounding(p.system, {p.state->prev, next_, multipliers_, own_}, limit,
                                  evaluation_.force_scale, most);
}

bool NewtonGroup::solve_linear() {
  NewtonProblem& p = *problem_;
  p.direction_is_fresh = has_tangent_;
  if (has_tangent_) {
    const Ledger::Scope scope(p.ledger, p.factor_effect);
    if (p.holds_free && p.iterations == 0) p.system.stiffen(held_share);
    const bool serves_once = p.settings.refresh == Refresh::every_iteration;
    p.singular = !(serves_once ? p.linear.factor_for(f_.get()) : p.linear.factor());
    ++p.factorisations;
    p.has_factors = !p.singular;
    p.factored_inertia = p.stencil.inertia;
    if (p.singular) return false;
    const bool is_start = p.last_residual == 0.0;
    if (is_start && p.stencil.inertia == 0.0) p.first_determinant = p.linear.determinant();
  }
  return solve_factored() && (!p.holds_free || !has_tangent_ || shorten_free_motion());
}

// The motion that a solution means turns directors so far, at most [rad].
double NewtonGroup::largest_turn() {
  NewtonProblem& p = *problem_;
  swap_with_state();
  const model::Coordinates& motion = p.system.linear_motion(*p.state, newton_.get(), 1.0);
  double largest = 0.0;
  for (const assembly::Layout::LocalBlock& local : p.system.layout().local_blocks()) {
    const model::Block block = p.system.model().unknowns().block(local.block);
    if (block.kind != model::BlockKind::node) continue;
    const auto slots = model::NodeTable::slots(motion, block.owner);
    largest = std::max(largest, slots.rightCols<3>().colwise().norm().maxCoeff());
  }
  swap_with_state();
  return p.system.comm().max(largest);
}

// A load moves what is free by as much as little stiffness lets it, which may be many turns. With
// as much stiffness as keeps an iteration short, it moves the way it is pushed, to where it hangs.
bool NewtonGroup::shorten_free_motion() {
  constexpr double farthest = 0.5;  // [rad]
  constexpr int most = 8;
  NewtonProblem& p = *problem_;
  double share = held_share;
  for (int i = 0; i < most; ++i) {
    const double turn = largest_turn();
    if (!(turn > farthest)) break;
    const double wanted = share * std::min(1.2 * turn / farthest, 1e4);
    p.system.stiffen(wanted - share);
    share = wanted;
    p.singular = !p.linear.factor();
    ++p.factorisations;
    if (p.singular || !solve_factored()) return false;
  }
  return true;
}

bool NewtonGroup::solve_factored() {
  NewtonProblem& p = *problem_;
  const Ledger::Scope scope(p.ledger, p.solve_effect);
  const double goal = forcing_term(relative_residual(evaluation_), p.settings.force_tolerance);
  const LinearResidual residual = p.linear.solve_roughly(f_.get(), newton_.get(), goal);
  p.not_finite = !std::isfinite(residual.size);
  // old factors solve another system; Newton's own residual tells whether they serve
  p.singular = has_tangent_ && !residual.is_sound();
  return !p.singular;
}

bool NewtonGroup::solve_level() {
  NewtonProblem& p = *problem_;
  Vector& gradient = *p.level_gradient;
  Vector& flexibility = *p.level_flexibility;
  swap_with_state();
  p.system.level_gradient(*p.state, p.stencil, p.condition->level_difference(), gradient);
  {
    const Ledger::Scope scope(p.ledger, p.solve_effect);
    p.linear.solve(gradient, flexibility);
  }
  flexibility.scale(-1.0);
  level_increment_ = p.condition->level_increment(*p.state, newton_.get(), flexibility);
  swap_with_state();
  if (!std::isfinite(level_increment_)) return false;
  newton_.get().update(level_increment_, flexibility);
  return true;
}

NOX::Abstract::Group::ReturnType NewtonGroup::computeNewton(Teuchos::ParameterList&) {
  if (has_newton_) return Ok;
  if (!solve_linear()) return Failed;
  NewtonProblem& p = *problem_;
  p.last_residual = relative_residual(evaluation_);
  ++p.iterations;
  newton_.get().scale(-1.0);
  if (p.condition != nullptr && !solve_level()) return Failed;
  p.largest_increment = newton_.get().largest();
  has_newton_ = std::isfinite(p.largest_increment);
  p.not_finite = !has_newton_;
  return has_newton_ ? Ok : Failed;
}

Teuchos::RCP<const NOX::Abstract::Vector> NewtonGroup::getXPtr() const {
  return Teuchos::rcpFromRef(x_);
}
Teuchos::RCP<const NOX::Abstract::Vector> NewtonGroup::getFPtr() const {
  return Teuchos::rcpFromRef(f_);
}
Teuchos::RCP<const NOX::Abstract::Vector> NewtonGroup::getGradientPtr() const {
  return Teuchos::rcpFromRef(f_);
}
Teuchos::RCP<const NOX::Abstract::Vector> NewtonGroup::getNewtonPtr() const {
  return Teuchos::rcpFromRef(newton_);
}
Teuchos::RCP<NOX::Abstract::Group> NewtonGroup::clone(NOX::CopyType type) const {
  return Teuchos::rcp(new NewtonGroup(*this, type));
}

}  // namespace culm::solver
