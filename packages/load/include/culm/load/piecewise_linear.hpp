/// Functions given by points.
#pragma once

#include <string>
#include <vector>

namespace culm::load {

/// Linear between its points; beyond the outermost ones it goes on with the slope there.
class PiecewiseLinear {
 public:
  /// @pre mistake(arguments, values) is empty
  PiecewiseLinear(std::vector<double> arguments, std::vector<double> values);
  /// slope x
  static PiecewiseLinear proportional(double slope);
  /// What is wrong with such points; empty if nothing is.
  static std::string mistake(const std::vector<double>& arguments,
                             const std::vector<double>& values);

  double value(double x) const;
  double slope(double x) const;
  /// From 0 to x.
  double integral(double x) const { return mean(0.0, x).value * x; }

  struct Mean {
    double value = 0.0;
    double derivative = 0.0;  ///< of the value by the end of the interval
  };
  /// Mean over the interval from a to b, without any difference that could cancel.
  Mean mean(double a, double b) const;

 private:
  std::size_t segment(double x) const;
  double on_segment(std::size_t i, double x) const {
    return values_[i] + slopes_[i] * (x - arguments_[i]);
  }

  std::vector<double> arguments_, values_;
  std::vector<double> slopes_;  ///< one less
};

}  // namespace culm::load
