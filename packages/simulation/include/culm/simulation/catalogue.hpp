/// Everything a deck can name.
#pragma once

#include <culm/analysis/register_analysis.hpp>
#include <culm/control/register_control.hpp>
#include <culm/coupling/register_coupling.hpp>
#include <culm/flow/fluid_context.hpp>
#include <culm/material/register_material.hpp>
#include <culm/model/build_context.hpp>
#include <culm/port/register_port.hpp>
#include <culm/simulation/quantity.hpp>
#include <culm/strip/register_strip.hpp>
#include <culm/structure/structure_context.hpp>

namespace culm::simulation {

/// The registries of all packages.
struct Catalogue {
  /// Filled with all types culm has.
  Catalogue();

  Registry<material::Section> sections;
  Registry<material::Material> materials;
  structure::StructureRegistry structures;
  model::BuilderRegistry masses;
  model::BuilderRegistry initial_conditions;
  Registry<model::Amplitude> functions;
  model::FieldRegistry fields;
  control::SignalRegistry signals;
  model::BuilderRegistry constraints;
  model::BuilderRegistry loads;
  flow::FlowRegistry flows;
  flow::FluidLoadRegistry fluid_loads;  ///< in the list of loads, too
  strip::AirfoilRegistry airfoils;
  strip::StripRegistry strips;  ///< in the list of loads, too
  port::PortRegistry ports;
  coupling::PartnerRegistry partners;
  analysis::AnalysisRegistry analyses;
  QuantityRegistry quantities;

  /// The schema of a whole deck.
  Schema deck_schema() const;
};

}  // namespace culm::simulation
