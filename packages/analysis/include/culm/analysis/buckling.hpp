/// Loads at which a structure buckles, from one eigenproblem.
#pragma once

#include <culm/analysis/linearisation.hpp>
#include <culm/base/options.hpp>
#include <culm/base/schema.hpp>

#include <optional>

namespace culm::analysis {

/// How buckling is looked for.
struct BucklingSettings {
  int modes = 5;
  /// Level whose loads, less the present ones, are the reference load: 1, or 0 where that is
  /// reached.
  std::optional<double> reference_level;
  Where where;                       ///< of the level in the deck
  std::string solver = "Automatic";  ///< one of solver::buckling_solver_names()
};

/// Linear buckling about the present state, which stays as it is: (K + mu DK) phi = 0, where DK is
/// what the stresses, reactions and loads of one linear step under the reference load add to the
/// tangent. @source formulation 5.5
class Buckling final : public Inspection {
 public:
  explicit Buckling(BucklingSettings settings) : settings_(std::move(settings)) {}

  static Schema schema();
  static std::unique_ptr<Inspection> make(const Options& options);

  void begin(Context& context, model::State& state) override;
  AnalysisReport inspect(Context& context, model::State& state) override;

 private:
  double reference_level(const model::State& state) const;

  BucklingSettings settings_;
  std::optional<assembly::Vector> step_;  ///< the linear one
};

}  // namespace culm::analysis
