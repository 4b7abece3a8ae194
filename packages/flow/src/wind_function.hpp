/// Winds that a function of time makes stronger and weaker.
#pragma once

#include <culm/model/amplitude.hpp>
#include <culm/model/build_context.hpp>

#include <optional>

namespace culm::flow {

/// Parameter "Function", by whose value velocities are multiplied.
inline Field wind_function_field() { return model::function_field("Constant"); }

/// The function that it names; nothing, and an issue, where it is none of time, such as a signal.
std::optional<model::Amplitude> find_wind_function(const Options& options,
                                                   model::BuildContext& context);

}  // namespace culm::flow
