/// Inertia forces in a frame that turns.
#pragma once

#include <culm/model/amplitude.hpp>
#include <culm/model/booked.hpp>
#include <culm/model/memoryless_batch.hpp>
#include <culm/model/projection.hpp>
#include <culm/model/steady_rotation.hpp>

#include <string>
#include <vector>

namespace culm::load {

/// What masses feel in a frame that turns with a(t) omega about an axis. The acceleration of every
/// slot, a position relative to a point of the axis, is
///   a = omega x (omega x q) + 2 omega x v + omega' x q,
/// so with the constant mass M between slots f_s = -sum_t M_st a_t, exactly for any shape and
/// rotation. Velocities v and the rate omega' are differences over a step: zero in statics.
/// @source formulation 1.2
class RotatingFrame final : public model::MemorylessBatch,
                            public model::SteadyRotation,
                            public model::Booked {
 public:
  static constexpr int max_nodes = 4;

  /// How the frame turns in a step: of vectors the matrices of their cross products with omega, and
  /// with its rate.
  struct Turning {
    Mat3 turn;
    Mat3 rate;
    Mat3 by_place() const { return turn * turn + rate; }
  };

  /// @param axis unit vector @param speed at amplitude 1 [rad/s] @param point of the axis [m]
  RotatingFrame(model::Effect effect, const model::NodeTable& nodes, model::Amplitude amplitude,
                const Vec3& axis, double speed, const Vec3& point)
      : MemorylessBatch(std::move(effect)),
        nodes_(nodes),
        amplitude_(std::move(amplitude)),
        axis_(axis),
        speed_(speed),
        point_(point) {}

  /// Turns no more than these nodes; all if this is not called.
  void turn_only(const std::vector<int>& nodes);

  /// @param mass between the slots of the nodes, four per node [kg, kg m, kg m^2]
  void add(std::span<const int> nodes, const Eigen::MatrixXd& mass);

  int size() const override { return static_cast<int>(items_.size()); }
  std::vector<int> blocks(int item, const model::UnknownTable& unknowns) const override;
  bool has_tangent() const override { return true; }
  Verdict assemble(const model::State& state, const Stencil& stencil, Want want,
                   model::Target& target) override;
  model::StepWork step_work(const model::State& state, const Stencil& stencil) const override;

  const Vec3& axis() const override { return axis_; }
  const Vec3& point() const override { return point_; }
  double speed(const model::State& state, const Stencil& stencil) const override;
  bool turns(int node) const override {
    return turning_.empty() || turning_[static_cast<std::size_t>(node)];
  }

 private:
  struct Item {
    std::vector<int> nodes;
    Eigen::MatrixXd mass;
  };

  template <class Space>
  Verdict assemble_item(std::size_t i, const model::State& state, const Stencil& stencil,
                        const Turning& turning, bool tangent, model::Target& target) const;
  Turning turning_in(const model::State& state, const Stencil& stencil) const;

  const model::NodeTable& nodes_;
  model::Amplitude amplitude_;
  Vec3 axis_;
  double speed_;
  Vec3 point_;
  std::vector<bool> turning_;  ///< by node; empty if all turn
  std::vector<Item> items_;
};

}  // namespace culm::load
