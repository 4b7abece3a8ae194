/// Axis type that lists its nodes.
#pragma once

#include <culm/base/options.hpp>
#include <culm/base/schema.hpp>
#include <culm/beam/axis.hpp>

namespace culm::beam {

Schema nodes_schema();
Axis make_nodes(const Options& options, const Density& density);

}  // namespace culm::beam
