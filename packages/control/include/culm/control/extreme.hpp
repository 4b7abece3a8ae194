#pragma once

#include <culm/control/block.hpp>
#include <culm/control/register_control.hpp>

namespace culm::control {

/// The least, or the greatest, of its inputs; the first of equal ones.
class Extreme final : public Block {
 public:
  enum class Which { least, greatest };
  Extreme(Which which, double scale) : which_(which), scale_(scale) {}

  std::vector<model::OwnUnknown> unknowns() const override {
    return {{"output", model::UnknownKind::algebraic, scale_}};
  }
  void evaluate(const Unknowns&, const Inputs& u, Values& values) const override {
    const Eigen::Index k = chosen(u);
    values.f[0] = u[k];
    values.by_input(0, k) = 1.0;
  }
  double start(const Inputs& u) const override { return u[chosen(u)]; }

 private:
  Eigen::Index chosen(const Inputs& u) const {
    Eigen::Index k = 0;
    which_ == Which::least ? u.minCoeff(&k) : u.maxCoeff(&k);
    return k;
  }

  Which which_;
  double scale_;
};

/// Least, Greatest
void register_extremes(SignalRegistry& registry);

}  // namespace culm::control
