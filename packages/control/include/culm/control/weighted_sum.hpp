#pragma once

#include <culm/control/block.hpp>
#include <culm/control/register_control.hpp>

#include <utility>

namespace culm::control {

/// y = offset + sum_k g_k u_k, held between limits.
class WeightedSum final : public Block {
 public:
  WeightedSum(double offset, Inputs gains, const Limits& output, double scale)
      : offset_(offset), gains_(std::move(gains)), output_(output), scale_(scale) {}

  std::vector<model::OwnUnknown> unknowns() const override {
    return {{"output", model::UnknownKind::algebraic, scale_}};
  }
  void evaluate(const Unknowns&, const Inputs& u, Values& values) const override {
    const double sum = offset_ + gains_.dot(u);
    values.f[0] = output_.hold(sum);
    values.by_input.row(0) = output_.slope(sum) * gains_.transpose();
  }
  double start(const Inputs& u) const override { return output_.hold(offset_ + gains_.dot(u)); }

 private:
  double offset_;
  Inputs gains_;
  Limits output_;
  double scale_;
};

/// Sum
void register_weighted_sum(SignalRegistry& registry);

}  // namespace culm::control
