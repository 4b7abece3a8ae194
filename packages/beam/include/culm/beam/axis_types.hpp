/// The ways a deck can describe the axis of a beam: list `Curve`, by `Type`.
#pragma once

#include <culm/base/registry.hpp>
#include <culm/beam/axis.hpp>

namespace culm::beam {

/// Makers take the density of nodes. They throw InputError for impossible geometry.
using AxisRegistry = Registry<Axis, Density>;

/// Adds Line, Polyline, Arc, Arc Through Points, Helix, Spline and Nodes.
void register_axes(AxisRegistry& registry);

}  // namespace culm::beam
