/// Natural frequencies and mode shapes.
#pragma once

#include <culm/analysis/find_modes.hpp>
#include <culm/base/options.hpp>
#include <culm/base/schema.hpp>

namespace culm::analysis {

/// What a deck says about which modes: Modes, Near, Solver.
Schema& add_mode_fields(Schema& schema);
ModalSettings read_mode_settings(const Options& options);
/// And what counts: Damping, Rotor.
Schema& add_modal_fields(Schema& schema);
ModalSettings read_modal_settings(const Options& options);

/// Small vibrations about the present state, which stays as it is. @source formulation 5.4
class Modal final : public Inspection {
 public:
  explicit Modal(ModalSettings settings) : settings_(std::move(settings)) {}

  static Schema schema();
  static std::unique_ptr<Inspection> make(const Options& options);

  AnalysisReport inspect(Context& context, model::State& state) override;

 private:
  ModalSettings settings_;
};

}  // namespace culm::analysis
