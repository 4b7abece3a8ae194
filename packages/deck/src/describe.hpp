#pragma once

#include <culm/base/field.hpp>

#include <string>

namespace culm::deck {

/// Kind, size, range and unit of a field in words: "number > 0 kg", "numbers in m, 3 items",
/// "text: box, tube".
std::string describe(const Field& field);

/// The same with the default and the sentence of the field: "number > 0 kg, required. Mass."
std::string describe_fully(const Field& field);

}  // namespace culm::deck
