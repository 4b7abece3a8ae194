/// The equations of one step as NOX wants them.
#pragma once

#include <culm/assembly/rounding.hpp>
#include <culm/solver/linear_solver.hpp>
#include <culm/solver/newton_solver.hpp>

#include "newton_vector.hpp"

#include <NOX_Abstract_Group.H>

#include <memory>
#include <optional>

namespace culm::solver {

/// An extrapolation of the stress that no tangent has asked for yet.
struct WaitingStress {
  model::Coordinates from;
  const assembly::Vector* increment;  ///< of NOX, which has no other before it asks for a tangent
  double step;
};

/// What all groups of one solver share. The state's `next` and `multipliers` are lent to the group
/// that is being evaluated; between evaluations the groups keep them.
struct NewtonProblem {
  assembly::System& system;
  LinearSolver& linear;
  NewtonSettings settings;
  Ledger& ledger;
  Ledger::Id factor_effect;
  Ledger::Id solve_effect;
  model::State* state = nullptr;
  Stencil stencil;
  LevelCondition* condition = nullptr;                     ///< none: the level is given
  std::optional<assembly::Vector> level_gradient = {};     ///< dR/dlevel; made with a condition
  std::optional<assembly::Vector> level_flexibility = {};  ///< likewise
  Determinant first_determinant = {};  ///< of the first tangent of a static step
  bool has_factors = false;       ///< the linear solver holds factors of a tangent of this analysis
  double factored_inertia = 0.0;  ///< Stencil::inertia of that tangent
  long factorisations = 0;        ///< so far
  double last_residual = 0.0;     ///< relative one of the iteration before; 0 before the first
  int iterations = 0;             ///< of this step, so far
  int expected_iterations = 0;    ///< those of the step before; 0 before the first
  bool direction_is_fresh = false;  ///< the last Newton direction is that of a new tangent
  bool holds_free = false;  ///< motions that nothing resists are held a little where a step begins
  bool tangent_is_whole = true;  ///< no load says that it leaves out something (`LeftOutOfModes`)
  bool creeps = false;           ///< residuals fall by a constant factor at last (`PartialTangent`)
  bool singular = false;         ///< the last factorisation failed
  bool not_finite = false;       ///< the last solution is infinite or not a number
  double largest_increment = 0.0;
  bool stress_waits = false;                  ///< tangents do not yet know the last increment
  std::optional<WaitingStress> waiting = {};  ///< made when it is first wanted
};

/// A trial point. Rotations are updated multiplicatively in computeX, and X stays zero: NOX only
/// asks of which shape it is. So setX does not move the point.
class NewtonGroup final : public NOX::Abstract::Group {
 public:
  explicit NewtonGroup(std::shared_ptr<NewtonProblem> problem);
  NewtonGroup(const NewtonGroup& other, NOX::CopyType type);
  NewtonGroup(const NewtonGroup&) = delete;

  /// Takes the start of a step from the problem's state, which has no coordinates at its end until
  /// finish().
  void start();
  /// Gives the trial point to the problem's state, also where something was thrown meanwhile.
  void finish();
  const assembly::Evaluation& evaluation() const { return evaluation_; }
  /// Whether rounding can hold force rows above a limit at this point, which was evaluated last.
  assembly::RoundingCheck check_rounding(double limit, double most) const;

  NOX::Abstract::Group& operator=(const NewtonGroup& other);
  NOX::Abstract::Group& operator=(const NOX::Abstract::Group& other) override;
  void setX(const NOX::Abstract::Vector& x) override;
  void computeX(const NOX::Abstract::Group& from, const NOX::Abstract::Vector& direction,
                double step) override;
  ReturnType computeF() override;
  ReturnType computeJacobian() override;
  ReturnType computeNewton(Teuchos::ParameterList& parameters) override;
  bool isF() const override { return has_residual_; }
  bool isJacobian() const override { return has_tangent_; }
  bool isNewton() const override { return has_newton_; }
  const NOX::Abstract::Vector& getX() const override { return x_; }
  const NOX::Abstract::Vector& getF() const override { return f_; }
  double getNormF() const override { return f_.norm(NOX::Abstract::Vector::TwoNorm); }
  const NOX::Abstract::Vector& getGradient() const override { return f_; }
  const NOX::Abstract::Vector& getNewton() const override { return newton_; }
  Teuchos::RCP<const NOX::Abstract::Vector> getXPtr() const override;
  Teuchos::RCP<const NOX::Abstract::Vector> getFPtr() const override;
  Teuchos::RCP<const NOX::Abstract::Vector> getGradientPtr() const override;
  Teuchos::RCP<const NOX::Abstract::Vector> getNewtonPtr() const override;
  Teuchos::RCP<NOX::Abstract::Group> clone(NOX::CopyType type) const override;

 private:
  void swap_with_state();
  void forget_results();
  bool needs_tangent() const;
  /// Whether the tangent at this point will hardly be asked for.
  bool tangent_can_wait() const;
  void extrapolate_late();
  /// Solves with new or old factors. @return false if the result is of no use
  bool solve_linear();
  bool solve_factored();
  double largest_turn();
  bool shorten_free_motion();
  /// Adds the share of the level to the Newton direction. @return false if there is none
  bool solve_level();

  std::shared_ptr<NewtonProblem> problem_;
  model::Coordinates next_;
  std::vector<double> multipliers_;
  std::vector<double> own_;
  double level_ = 0.0;
  double level_increment_ = 0.0;  ///< belongs to newton_
  assembly::Evaluation evaluation_;
  /// With full steps nobody asks the point before for anything, so that a copy only says of which
  /// point it is the start, and how often that one had moved; the step moves it.
  const NewtonGroup* start_of_ = nullptr;
  long moves_ = 0;
  NewtonVector x_;
  NewtonVector f_;  ///< with full steps the residual of the system, else a copy
  NewtonVector newton_;
  bool shares_residual_ = false;
  bool is_in_state_ = false;  ///< the trial point stands in the problem's state
  bool has_residual_ = false;
  bool has_tangent_ = false;
  bool tangent_wanted_ = false;
  bool has_newton_ = false;
};

}  // namespace culm::solver
