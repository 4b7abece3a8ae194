#include "late_search.hpp"

#include <NOX_Solver_Generic.H>

#include <cmath>

namespace culm::solver {
namespace {

// Iterations with full steps; smooth problems need no more.
constexpr int patience = 6;

// A shorter step is not worth its evaluation.
constexpr double least_step = 1.0 / 16.0;

// 1 for forces, 1 over the length of the model for moments, 0 for constraints.
std::vector<double> weights_of(const assembly::System& system) {
  std::vector<double> weights;
  const model::Model& model = system.model();
  for (const assembly::Layout::LocalBlock& local : system.layout().local_blocks()) {
    if (!local.owned) continue;
    const model::Block block = model.unknowns().block(local.block);
    for (int i = 0; i < block.shape.width; ++i) {
      if (block.shape.position[static_cast<std::size_t>(i)] < 0) continue;
      const bool is_node = block.kind == model::BlockKind::node;
      weights.push_back(!is_node ? 0.0 : i < 3 ? 1.0 : 1.0 / model.length());
    }
  }
  return weights;
}

}  // namespace

LateSearch::LateSearch(std::shared_ptr<NewtonProblem> problem)
    : problem_(std::move(problem)), weights_(weights_of(problem_->system)) {}

double LateSearch::size(const NOX::Abstract::Vector& residual) const {
  const auto values = NewtonVector::cast(residual).get().values();
  double sum = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) sum += std::pow(weights_[i] * values[i], 2);
  return std::sqrt(problem_->system.comm().sum(sum));
}

bool LateSearch::compute(NOX::Abstract::Group& group, double& step,
                         const NOX::Abstract::Vector& direction,
                         const NOX::Solver::Generic& solver) {
  const NOX::Abstract::Group& from = solver.getPreviousSolutionGroup();
  const double before = size(from.getF());
  const bool is_late = problem_->iterations > patience;
  for (step = 1.0;; step *= 0.5) {
    group.computeX(from, direction, step);
    const bool is_sound = group.computeF() == NOX::Abstract::Group::Ok;
    if (step <= least_step || (is_sound && (!is_late || size(group.getF()) < before))) {
      return is_sound;
    }
    if (!is_late) return is_sound;
  }
}

}  // namespace culm::solver
