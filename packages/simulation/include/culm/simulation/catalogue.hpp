/// Everything a deck can name.
#pragma once

#include <culm/analysis/register_analysis.hpp>
#include <culm/beam/register_beam.hpp>
#include <culm/control/register_control.hpp>
#include <culm/coupling/register_coupling.hpp>
#include <culm/flow/fluid_context.hpp>
#include <culm/hybrid/tube.hpp>
#include <culm/material/register_material.hpp>
#include <culm/model/build_context.hpp>
#include <culm/port/register_port.hpp>
#include <culm/shell/shell_structure.hpp>
#include <culm/simulation/quantity.hpp>

namespace culm::simulation {

/// The registries of all packages.
struct Catalogue {
  /// Filled with all types culm has.
  Catalogue();

  Registry<material::Section> sections;
  Registry<material::Material> materials;
  beam::StructureRegistry structures;
  shell::ShellRegistry shells;  ///< structures, too
  hybrid::HybridRegistry hybrids;
  model::BuilderRegistry bodies;  ///< and these
  model::BuilderRegistry masses;
  model::BuilderRegistry initial_conditions;
  Registry<model::Amplitude> functions;
  model::FieldRegistry fields;
  control::SignalRegistry signals;
  model::BuilderRegistry constraints;
  model::BuilderRegistry loads;
  flow::FlowRegistry flows;
  flow::FluidLoadRegistry fluid_loads;  ///< in the list of loads, too
  port::PortRegistry ports;
  coupling::PartnerRegistry partners;
  analysis::AnalysisRegistry analyses;
  QuantityRegistry quantities;

  /// The schema of a whole deck.
  Schema deck_schema() const;
};

}  // namespace culm::simulation
