#pragma once

#include <culm/base/field.hpp>

#include "raw_list.hpp"
#include "scope.hpp"

#include <optional>
#include <string>
#include <vector>

namespace culm::deck {

/// A value in SI units, or what is wrong with it; neither if that is among the issues already.
struct Conversion {
  std::optional<Value> value;
  std::vector<std::string> mistakes;
};

/// Turns a parameter as written into a value of its field and checks it against the field's rules.
Conversion convert(const RawParameter& raw, const Field& field, const Scope& scope);

/// The value of a variable in SI units; mistakes as above.
Conversion convert_variable(const RawParameter& raw, const Scope& scope);

/// The `type=` of a kind: double, int, bool, string, Array(double), Array(int), Array(string).
std::string type_name(Kind kind);

}  // namespace culm::deck
