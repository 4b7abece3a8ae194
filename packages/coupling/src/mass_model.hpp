/// What partners share that are nothing but inertia.
#pragma once

#include <culm/coupling/point_partner.hpp>

namespace culm::coupling {

/// Masses that move with the points: f = -M Dv / h with v_next = 2 Dx / h - v, as culm's own scheme
/// has it, so that their kinetic energy is the work that they take.
class MassModel : public PointModel {
 public:
  void begin(const Eigen::VectorXd&, const Eigen::VectorXd& velocity) override {
    velocity_ = taken(velocity);
    start_ = kinetic();
  }
  void accept(const Eigen::VectorXd& moved, double h) override {
    velocity_ = 2.0 / h * taken(moved) - velocity_;
  }
  Books books() const override { return {kinetic() - start_, 0.0}; }
  Eigen::VectorXd memory() const override {
    Eigen::VectorXd all(velocity_.size() + 1);
    all << start_, velocity_;
    return all;
  }
  void restore(const Eigen::VectorXd& memory) override {
    start_ = memory[0];
    velocity_ = memory.tail(memory.size() - 1);
  }

 protected:
  /// M v.
  virtual Eigen::VectorXd momentum(const Eigen::VectorXd& velocity) const = 0;
  /// The part of motions that has inertia.
  virtual Eigen::VectorXd taken(const Eigen::VectorXd& motion) const { return motion; }
  const Eigen::VectorXd& velocity() const { return velocity_; }

 private:
  double kinetic() const { return 0.5 * velocity_.dot(momentum(velocity_)); }

  Eigen::VectorXd velocity_;
  double start_ = 0.0;
};

}  // namespace culm::coupling
