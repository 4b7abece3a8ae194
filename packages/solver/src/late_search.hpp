/// Shortens Newton steps that raise the residual once full ones have had their chance.
#pragma once

#include "newton_group.hpp"

#include <NOX_LineSearch_Generic.H>
#include <NOX_LineSearch_UserDefinedFactory.H>

#include <memory>
#include <vector>

namespace culm::solver {

/// Line search that leaves the first iterations of a step alone: full steps stretch directors there
/// and raise the residual by orders of magnitude on their way to the solution. An iteration that
/// still wanders after them is made to lower the residual. Moments count over the length of the
/// model; constraints do not, a full step fulfils them best.
class LateSearch final : public NOX::LineSearch::Generic {
 public:
  explicit LateSearch(std::shared_ptr<NewtonProblem> problem);

  bool compute(NOX::Abstract::Group& group, double& step, const NOX::Abstract::Vector& direction,
               const NOX::Solver::Generic& solver) override;

 private:
  double size(const NOX::Abstract::Vector& residual) const;

  std::shared_ptr<NewtonProblem> problem_;
  std::vector<double> weights_;  ///< of the owned rows
};

/// Hands it to NOX.
class LateSearchFactory final : public NOX::LineSearch::UserDefinedFactory {
 public:
  explicit LateSearchFactory(std::shared_ptr<NewtonProblem> problem)
      : problem_(std::move(problem)) {}
  Teuchos::RCP<NOX::LineSearch::Generic> buildLineSearch(const Teuchos::RCP<NOX::GlobalData>&,
                                                         Teuchos::ParameterList&) const override {
    return Teuchos::rcp(new LateSearch(problem_));
  }

 private:
  std::shared_ptr<NewtonProblem> problem_;
};

}  // namespace culm::solver
