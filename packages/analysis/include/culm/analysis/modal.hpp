/// Natural frequencies and mode shapes.
#pragma once

#include <culm/analysis/analysis.hpp>
#include <culm/base/options.hpp>
#include <culm/base/schema.hpp>
#include <culm/solver/eigen_solver.hpp>

#include <optional>

namespace culm::analysis {

/// Which modes.
struct ModalSettings {
  int modes = 10;
  std::optional<double> near;  ///< frequency next to which modes are looked for [Hz]; the lowest
  std::string solver = "Automatic";  ///< one of solver::eigen_solver_names()
};

/// Small vibrations about the present state, which stays as it is. @source formulation 5.4
class Modal final : public Analysis {
 public:
  explicit Modal(ModalSettings settings) : settings_(std::move(settings)) {}

  static Schema schema();
  static std::unique_ptr<Analysis> make(const Options& options);

  void save(const Context&, Snapshot&) const override {}  // it makes no steps

 private:
  void start(Context&, model::State&) override {}
  void restore(Context&, const Snapshot&) override {}
  AnalysisReport advance(Context& context, model::State& state, Observer& observer) override;

  ModalSettings settings_;
};

}  // namespace culm::analysis
