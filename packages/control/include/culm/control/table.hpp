#pragma once

#include <culm/control/block.hpp>
#include <culm/control/register_control.hpp>
#include <culm/load/piecewise_linear.hpp>

#include <utility>

namespace culm::control {

/// y = F(u), linear between points and constant beyond the outermost ones.
class Table final : public Block {
 public:
  /// @param range  from the first to the last point of the function
  Table(load::PiecewiseLinear function, const Limits& range, double scale)
      : function_(std::move(function)), range_(range), scale_(scale) {}

  std::vector<model::OwnUnknown> unknowns() const override {
    return {{"output", model::UnknownKind::algebraic, scale_}};
  }
  void evaluate(const Unknowns&, const Inputs& u, Values& values) const override {
    values.f[0] = start(u);
    values.by_input(0, 0) = range_.slope(u[0]) * function_.slope(u[0]);
  }
  double start(const Inputs& u) const override { return function_.value(range_.hold(u[0])); }

 private:
  load::PiecewiseLinear function_;
  Limits range_;
  double scale_;
};

/// Table
void register_table(SignalRegistry& registry);

}  // namespace culm::control
