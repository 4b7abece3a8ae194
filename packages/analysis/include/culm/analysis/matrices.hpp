/// The matrices of the linearised equations, for other programs.
#pragma once

#include <culm/analysis/linearisation.hpp>
#include <culm/base/options.hpp>
#include <culm/base/schema.hpp>

namespace culm::analysis {

/// Writes what linearise() finds about the present state: stiffness, mass, damping, constraint
/// Jacobian H and the basis P by which coordinates follow from unknowns. The equations are
/// M y'' + C y' + K y + H^T mu = 0, H y = 0, dq = P y.
class Matrices final : public Analysis {
 public:
  static Schema schema();
  static std::unique_ptr<Analysis> make(const Options& options);

  void save(const Context&, Snapshot&) const override {}  // it makes no steps

 private:
  void start(Context&, model::State&) override {}
  void restore(Context&, const Snapshot&) override {}
  AnalysisReport advance(Context& context, model::State& state, Observer& observer) override;
};

}  // namespace culm::analysis
