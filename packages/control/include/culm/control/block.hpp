/// Blocks of controls: equations of signals.
#pragma once

#include <culm/model/own_unknowns.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <limits>
#include <vector>

namespace culm::control {

/// Up to two unknowns that follow up to eight inputs. An unknown x_i with a rate obeys
/// dx_i/dt = f_i(x, u), an algebraic one x_i = f_i(x, u), u the inputs. The first unknown is the
/// output.
class Block {
 public:
  static constexpr int max_unknowns = 2;
  static constexpr int max_inputs = 8;
  using Unknowns = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, max_unknowns, 1>;
  using Inputs = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, max_inputs, 1>;

  /// f and its derivatives, zero when they are handed to a block.
  struct Values {
    Unknowns f;
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, max_unknowns,
                  max_unknowns>
        by_unknown;
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, max_unknowns, max_inputs>
        by_input;
  };

  virtual ~Block() = default;
  virtual std::vector<model::OwnUnknown> unknowns() const = 0;
  virtual void evaluate(const Unknowns& x, const Inputs& u, Values& values) const = 0;
  /// The unknown that is told how to start, and its value where it is not, with the inputs of the
  /// start.
  virtual int state() const { return 0; }
  virtual double start(const Inputs& u) const = 0;
  /// Size of its fastest rate of decay or oscillation that always acts [1/s]; 0 without one.
  virtual double fastest() const { return 0.0; }
};

/// What a value is held between.
struct Limits {
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();

  static Limits symmetric(double size) { return {-size, size}; }
  double hold(double value) const { return std::clamp(value, lower, upper); }
  /// Derivative of hold.
  double slope(double value) const { return value > lower && value < upper ? 1.0 : 0.0; }
};

}  // namespace culm::control
