/// Seas among the flows of a deck.
#pragma once

#include <culm/flow/fluid_context.hpp>
#include <culm/water/sea.hpp>

#include <memory>

namespace culm::water {

/// The sea that the parameter 'Flow' names; null, and an issue, if it is none.
std::shared_ptr<const Sea> find_sea(const Options& options, flow::FluidContext& context);

}  // namespace culm::water
