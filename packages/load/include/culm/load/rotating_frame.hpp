/// Inertia forces in a frame that turns steadily.
#pragma once

#include <culm/model/amplitude.hpp>
#include <culm/model/memoryless_batch.hpp>
#include <culm/model/projection.hpp>

#include <string>
#include <vector>

namespace culm::load {

/// What masses feel in a frame that turns with a(t) omega about an axis. The acceleration of every
/// slot, a position relative to a point of the axis, is omega x (omega x q) + 2 omega x v, so with
/// the constant mass M between slots
///   f_s = -sum_t M_st (omega x (omega x q_t) + 2 omega x v_t),
/// exactly for any shape and rotation. Velocities are (q_next - q_prev) / step: zero in statics.
/// The speed is taken as steady: there is no term with its rate. @source formulation 1.2
class RotatingFrame final : public model::MemorylessBatch {
 public:
  static constexpr int max_nodes = 4;

  /// @param omega [rad/s] @param point of the axis [m]
  RotatingFrame(std::string effect, const model::NodeTable& nodes, model::Amplitude amplitude,
                const Vec3& omega, const Vec3& point)
      : MemorylessBatch(std::move(effect)),
        nodes_(nodes),
        amplitude_(std::move(amplitude)),
        omega_(omega),
        point_(point) {}

  /// @param mass between the slots of the nodes, four per node [kg, kg m, kg m^2]
  void add(std::span<const int> nodes, const Eigen::MatrixXd& mass);

  int size() const override { return static_cast<int>(items_.size()); }
  std::vector<int> blocks(int item, const model::UnknownTable& unknowns) const override;
  bool has_tangent() const override { return true; }
  Verdict assemble(const model::State& state, const Stencil& stencil, Want want,
                   model::Target& target) override;
  model::StepWork step_work(const model::State& state, const Stencil& stencil) const override;

 private:
  struct Item {
    std::vector<int> nodes;
    Eigen::MatrixXd mass;
  };

  template <class Space>
  Verdict assemble_item(std::size_t i, const model::State& state, const Stencil& stencil,
                        bool tangent, model::Target& target) const;

  const model::NodeTable& nodes_;
  model::Amplitude amplitude_;
  Vec3 omega_;
  Vec3 point_;
  std::vector<Item> items_;
};

}  // namespace culm::load
