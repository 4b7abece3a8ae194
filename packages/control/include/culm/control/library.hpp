#pragma once

#include <culm/control/register_control.hpp>

namespace culm::control {

/// Library, Library Output
void register_library(SignalRegistry& registry);

}  // namespace culm::control
