#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace culm::deck {

/// The text in quotes for a message, cut if it is long.
std::string quoted(std::string_view text);

/// A number as the whole text, such as "-1.5e3"; empty for anything else, including NaN, infinity
/// and what double precision cannot hold.
std::optional<double> literal_number(std::string_view text);

/// The value of an expression, or what is wrong with it: "must be …".
struct Evaluation {
  double value = 0.0;
  std::string mistake;  ///< empty if there is none
};

/// The variables that are visible in a list, and the arithmetic over them (by muParser). pi and e
/// are always there. A copy starts as the scope of a list below.
class Scope {
 public:
  Scope();
  Scope(const Scope& outer);
  Scope& operator=(const Scope&) = delete;
  ~Scope();

  /// Adds a variable, or hides one of an outer list. Returns what is wrong with the name, if
  /// anything.
  std::string define(const std::string& name, double value);

  /// Evaluates a number or an expression.
  Evaluation evaluate(const std::string& text) const;

  /// A formula in which all variables stand as numbers, except its own.
  std::string substitute(std::string_view formula, std::string_view own) const;

 private:
  struct Parser;
  Parser& parser() const;
  std::string explain(const std::string& text, const std::string& token, int position,
                      const std::string& reason) const;

  std::map<std::string, double> variables_;
  mutable std::unique_ptr<Parser> parser_;  ///< made when the first expression is met
};

}  // namespace culm::deck
