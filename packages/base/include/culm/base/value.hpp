#pragma once

// This header stays C++17: the sources that need Teuchos validators read it as such.

#include <string>
#include <variant>
#include <vector>

namespace culm {

/// What a parameter of the deck can hold.
using Value = std::variant<double, int, bool, std::string, std::vector<double>, std::vector<int>,
                           std::vector<std::string>>;

/// The kinds of Value, in the order of its alternatives.
enum class Kind { number, integer, flag, text, numbers, integers, texts };

inline Kind kind_of(const Value& value) { return static_cast<Kind>(value.index()); }

/// The kind in words: "number", "integer", "flag", "text", "numbers", "integers", "texts".
std::string to_string(Kind kind);

/// The value as a deck writes it: 0.5, true, Beam, {1, 2, 3}.
std::string to_string(const Value& value);

}  // namespace culm
