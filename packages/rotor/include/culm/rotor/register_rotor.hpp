#pragma once

#include <culm/strip/register_strip.hpp>

namespace culm::rotor {

/// Type of this package in the deck's list "Loads": Rotor.
void register_rotors(strip::StripRegistry& registry);

}  // namespace culm::rotor
