/// Arithmetic in texts.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace culm {

/// A formula over named numbers (muParser): + - * / ^, comparisons, && ||, c ? a : b, sqrt, sin, …
/// Nothing that muParser throws leaves this class, and a formula cannot assign.
class Formula {
 public:
  /// Longest name of a constant or variable.
  static constexpr std::size_t longest_name = 100;

  struct Mistake {
    std::string reason;
    std::string token;  ///< where the reading stopped; may be empty
    int position = -1;  ///< of the character, from 0; -1 if it is not known
  };
  struct Result {
    double value = 0.0;  ///< of the first formula; may be infinite or not a number
    int count = 0;       ///< of formulas, separated by commas
    std::optional<Mistake> mistake;
  };

  Formula();
  Formula(Formula&&) noexcept;
  Formula& operator=(Formula&&) noexcept;
  ~Formula();

  /// Names of functions, such as "sqrt".
  std::vector<std::string> functions() const;
  bool has_function(const std::string& name) const;

  /// The constants from now on, in place of those before.
  /// @pre names are made of letters, digits and '_' and have at most `longest_name` characters
  void set_constants(const std::map<std::string, double>& constants);
  /// A name whose value is read from a place that outlives this.
  void add_variable(const std::string& name, double& place);
  void set_text(const std::string& text);

  /// Whether the text, if it is sound, names a variable.
  bool uses(const std::string& variable) const;
  Result evaluate() const;

 private:
  struct Parser;
  std::unique_ptr<Parser> parser_;
  std::optional<Mistake> mistake_;  ///< of the text as it was set
};

}  // namespace culm
