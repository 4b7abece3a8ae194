/// The types of loads by strips in a deck.
#pragma once

#include <culm/flow/fluid_context.hpp>
#include <culm/strip/strip_load.hpp>

#include <map>
#include <string>
#include <utility>

namespace culm::strip {

/// Where builders of strips add to, and what is there already.
class StripContext {
 public:
  StripContext(flow::FluidContext& context, std::map<std::string, SharedAirfoil> all_airfoils)
      : fluids(context), airfoils(std::move(all_airfoils)) {}

  flow::FluidContext& fluids;
  const std::map<std::string, SharedAirfoil> airfoils;  ///< list "Airfoils"
  std::map<std::string, StripLoad*> strips = {};        ///< by name, of the model
};

/// Types of the deck's list "Loads" that need airfoils: Strip.
using StripRegistry = Registry<void, StripContext&>;

void register_strips(StripRegistry& registry);

}  // namespace culm::strip
