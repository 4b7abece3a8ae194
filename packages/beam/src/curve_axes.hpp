/// Axis types that are smooth curves.
#pragma once

#include <culm/base/options.hpp>
#include <culm/base/schema.hpp>
#include <culm/beam/axis.hpp>

namespace culm::beam {

Schema line_schema();
Axis make_line(const Options& options, const Density& density);

Schema polyline_schema();
Axis make_polyline(const Options& options, const Density& density);

Schema arc_schema();
Axis make_arc(const Options& options, const Density& density);

Schema arc_through_points_schema();
Axis make_arc_through_points(const Options& options, const Density& density);

Schema helix_schema();
Axis make_helix(const Options& options, const Density& density);

Schema spline_schema();
Axis make_spline(const Options& options, const Density& density);

}  // namespace culm::beam
