/// Functions of time by formulas.
#pragma once

#include <memory>
#include <string>

namespace culm::model {

/// A formula in t (muParser): + - * / ^, comparisons, && ||, c ? a : b, sin, sqrt, …, pi and e.
/// Copies share the parser, whose only state is the time.
class TimeFormula {
 public:
  /// @pre mistake(text) is empty
  explicit TimeFormula(const std::string& text);

  /// At a time [s]; may be infinite or not a number.
  double value(double time) const;
  /// What is wrong with a text, and where in it; empty if nothing is.
  static std::string mistake(const std::string& text);

 private:
  struct Parser;
  std::shared_ptr<Parser> parser_;
};

}  // namespace culm::model
