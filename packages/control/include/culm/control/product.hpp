#pragma once

#include <culm/control/block.hpp>
#include <culm/control/register_control.hpp>

#include <utility>

namespace culm::control {

/// y = g prod_k u_k^(p_k), held between limits: a power over a speed, a torque times a factor.
class Product final : public Block {
 public:
  /// @param gain  g  @param powers  p, of which those of signals that change sign are whole numbers
  Product(double gain, Inputs powers, const Limits& output, double scale)
      : gain_(gain), powers_(std::move(powers)), output_(output), scale_(scale) {}

  std::vector<model::OwnUnknown> unknowns() const override {
    return {{"output", model::UnknownKind::algebraic, scale_}};
  }
  void evaluate(const Unknowns&, const Inputs& u, Values& values) const override;
  double start(const Inputs& u) const override { return output_.hold(product(u)); }

 private:
  double product(const Inputs& u) const;

  double gain_;
  Inputs powers_;
  Limits output_;
  double scale_;
};

/// Product
void register_product(SignalRegistry& registry);

}  // namespace culm::control
