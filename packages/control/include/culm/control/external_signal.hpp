#pragma once

#include <culm/control/register_control.hpp>

namespace culm::control {

/// External: what a controller in another program says.
void register_external_signal(SignalRegistry& registry);

}  // namespace culm::control
