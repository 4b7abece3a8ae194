#include "newton_group.hpp"

#include <cmath>

namespace culm::solver {

using assembly::values_of;

NewtonGroup::NewtonGroup(std::shared_ptr<NewtonProblem> problem)
    : problem_(std::move(problem)),
      x_(problem_->system.layout().row_map()),
      f_(problem_->system.layout().row_map()),
      newton_(problem_->system.layout().row_map()) {}

NewtonGroup::NewtonGroup(const NewtonGroup& other, NOX::CopyType type)
    : problem_(other.problem_),
      x_(other.x_, type),
      f_(other.f_, type),
      newton_(other.newton_, type) {
  if (type == NOX::DeepCopy) *this = other;
}

void NewtonGroup::start() {
  next_ = problem_->state->next;
  multipliers_ = problem_->state->multipliers;
  forget_results();
}

void NewtonGroup::finish() {
  problem_->state->next = next_;
  problem_->state->multipliers = multipliers_;
}

void NewtonGroup::swap_with_state() {
  problem_->state->next.swap(next_);
  problem_->state->multipliers.swap(multipliers_);
}

void NewtonGroup::forget_results() { has_residual_ = has_tangent_ = has_newton_ = false; }

NOX::Abstract::Group& NewtonGroup::operator=(const NewtonGroup& other) {
  if (this == &other) return *this;
  next_ = other.next_;
  multipliers_ = other.multipliers_;
  evaluation_ = other.evaluation_;
  x_ = other.x_;
  has_residual_ = other.has_residual_;
  has_newton_ = other.has_newton_;
  has_tangent_ = false;  // the system has one matrix, and it stays with the original
  if (has_residual_) f_ = other.f_;
  if (has_newton_) newton_ = other.newton_;
  return *this;
}

NOX::Abstract::Group& NewtonGroup::operator=(const NOX::Abstract::Group& other) {
  return *this = dynamic_cast<const NewtonGroup&>(other);
}

void NewtonGroup::setX(const NOX::Abstract::Vector& x) { x_ = NewtonVector::cast(x); }

void NewtonGroup::computeX(const NOX::Abstract::Group& from, const NOX::Abstract::Vector& direction,
                           double step) {
  const auto& origin = dynamic_cast<const NewtonGroup&>(from);
  const auto& increment = NewtonVector::cast(direction);
  next_ = origin.next_;
  multipliers_ = origin.multipliers_;
  x_.update(1.0, origin.x_, step, increment, 0.0);
  swap_with_state();
  NewtonProblem& p = *problem_;
  if (p.settings.extrapolate_stress) {
    p.system.extrapolate(*p.state, p.stencil, increment.get(), step);
  }
  p.system.move(*p.state, increment.get(), step);
  swap_with_state();
  forget_results();
}

// Residual and tangent in one pass: all but the last tangent of a step are used, and a separate
// pass for the residual costs a third of the joint one.
NOX::Abstract::Group::ReturnType NewtonGroup::computeF() {
  if (has_residual_) return Ok;
  swap_with_state();
  NewtonProblem& p = *problem_;
  evaluation_ = p.system.evaluate(*p.state, p.stencil, Want::residual_and_tangent);
  swap_with_state();
  f_.get().assign(p.system.residual());
  has_residual_ = has_tangent_ = evaluation_.verdict == Verdict::ok;
  return has_residual_ ? Ok : Failed;
}

NOX::Abstract::Group::ReturnType NewtonGroup::computeJacobian() {
  if (has_tangent_) return Ok;
  has_residual_ = false;
  return computeF();
}

NOX::Abstract::Group::ReturnType NewtonGroup::computeNewton(Teuchos::ParameterList&) {
  if (has_newton_) return Ok;
  NewtonProblem& p = *problem_;
  {
    const Ledger::Scope scope(p.ledger, p.factor_effect);
    p.singular = !p.linear.factor();
  }
  if (p.singular) return Failed;
  const Ledger::Scope scope(p.ledger, p.solve_effect);
  const double residual = p.linear.solve(f_.get(), newton_.get());
  p.not_finite = !std::isfinite(residual);
  p.singular = residual > 1e-8;
  if (p.singular) return Failed;
  newton_.get().scale(-1.0);
  p.largest_increment = newton_.get().normInf();
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
