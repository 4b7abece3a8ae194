#pragma once

#include <culm/base/formula.hpp>

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

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
/// are always there.
class Scope {
 public:
  Scope();
  /// The scope of a list below, which sees the variables of `outer` as long as that lives.
  explicit Scope(const Scope* outer);
  Scope(const Scope&) = delete;
  Scope& operator=(const Scope&) = delete;
  ~Scope() = default;

  /// Adds a variable, or hides one of an outer list. Returns what is wrong with the name, if
  /// anything.
  std::string define(const std::string& name, double value);

  /// Evaluates a number or an expression.
  Evaluation evaluate(const std::string& text) const;

  /// A formula in which all variables stand as numbers, except its own, one or several with commas.
  std::string substitute(std::string_view formula, std::string_view own) const;

 private:
  /// What all scopes of a deck share.
  struct Arithmetic {
    Formula formula;
    int hints = 1000;  ///< so many mistakes get a hint, which costs a look at all variables
  };

  const double* find(const std::string& name) const;
  std::map<std::string, double> values_in(std::string_view text) const;
  std::vector<std::string> names() const;
  std::string explain(const std::string& text, const Formula::Mistake& mistake) const;

  const Scope* outer_ = nullptr;
  std::map<std::string, double> variables_;  ///< of this list
  std::shared_ptr<Arithmetic> arithmetic_;
};

}  // namespace culm::deck
