/// The matrices of the linearised equations, for other programs.
#pragma once

#include <culm/analysis/linearisation.hpp>
#include <culm/base/options.hpp>
#include <culm/base/schema.hpp>

namespace culm::analysis {

/// Writes what linearise() finds about the present state: stiffness, mass, damping, constraint
/// Jacobian H and the basis P by which coordinates follow from unknowns. The equations are
/// M y'' + C y' + K y + H^T mu = 0, H y = 0, dq = P y.
class Matrices final : public Inspection {
 public:
  static Schema schema();
  static std::unique_ptr<Inspection> make(const Options& options);

  AnalysisReport inspect(Context& context, model::State& state) override;
};

}  // namespace culm::analysis
