/// How soil resists what moves through it: curves p-y, t-z and Q-z.
#pragma once

#include <culm/load/piecewise_linear.hpp>

#include <memory>
#include <vector>

namespace culm::soil {

/// Resistance by displacement, at one place, with a potential.
class Curve {
 public:
  virtual ~Curve() = default;
  /// [N/m], or [N] of a tip
  virtual double force(double displacement) const = 0;
  virtual double slope(double displacement) const = 0;
  /// Integral of the force from zero.
  virtual double energy(double displacement) const = 0;
  /// Displacements, rising from above zero, between which lines are close to the curve, which is
  /// nearly constant beyond the last one; none of a line without end.
  virtual std::vector<double> knots() const = 0;

  /// Mean of the force over a way from `from` to `to`, and its derivative by `to`.
  struct Mean {
    double value = 0.0;
    double derivative = 0.0;
  };
  Mean mean(double from, double to) const;

 protected:
  /// Of the energies at two displacements, with all its digits where both are small.
  virtual double energy_between(double from, double to) const { return energy(to) - energy(from); }
};
using SharedCurve = std::shared_ptr<const Curve>;

/// Linear between points, constant beyond the last one; odd, or nothing for negative displacements.
class TableCurve final : public Curve {
 public:
  enum class Sides { both, positive };
  /// @pre displacements rise from 0, forces begin with 0, as many, two or more
  TableCurve(std::vector<double> displacements, std::vector<double> forces, Sides sides);

  double force(double displacement) const override { return table_.value(displacement); }
  double slope(double displacement) const override { return table_.slope(displacement); }
  double energy(double displacement) const override { return table_.integral(displacement); }
  std::vector<double> knots() const override { return knots_; }

 private:
  double energy_between(double from, double to) const override;

  load::PiecewiseLinear table_;
  std::vector<double> knots_;
  double first_ = 0.0;  // up to which displacement it is a line from zero
};

/// force = stiffness times displacement
class LinearCurve final : public Curve {
 public:
  explicit LinearCurve(double stiffness) : stiffness_(stiffness) {}
  double force(double y) const override { return stiffness_ * y; }
  double slope(double) const override { return stiffness_; }
  double energy(double y) const override { return 0.5 * stiffness_ * y * y; }
  std::vector<double> knots() const override { return {}; }

 private:
  double energy_between(double from, double to) const override {
    return 0.5 * stiffness_ * (to + from) * (to - from);
  }

  double stiffness_;
};

}  // namespace culm::soil
