/// Lines that loads per length can act on.
#pragma once

#include <culm/model/build_context.hpp>

#include <vector>

namespace culm::load {

/// Parameter "Structure" of a load per length.
Field line_field();
/// The points of the structure or element set that parameter "Structure" names; none, and an issue,
/// if there is none or it is not a line.
std::vector<model::LinePoint> line_points(const Options& options, model::BuildContext& context);

}  // namespace culm::load
