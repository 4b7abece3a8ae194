/// Material points by name.
#pragma once

#include <culm/model/build_context.hpp>

#include <optional>
#include <string>

namespace culm::model {

/// The point of a name that stands at `where`: a node, or a point of a line at a fraction of its
/// length, as 'beam@0.35'; nothing, and an issue, if there is no such point or more than one.
/// @see select_point, for parameters that hold one name
std::optional<Marker> find_point(const std::string& name, const Where& where,
                                 BuildContext& context);

}  // namespace culm::model
