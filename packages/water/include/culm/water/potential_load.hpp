/// Loads of potential flow on a large body.
#pragma once

#include <culm/flow/fluid_force.hpp>
#include <culm/load/small_motion.hpp>
#include <culm/model/amplitude.hpp>
#include <culm/model/memoryless_batch.hpp>
#include <culm/model/method_limits.hpp>
#include <culm/water/radiation_fit.hpp>
#include <culm/water/sea.hpp>

#include <array>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace culm::water {

/// A body in the water by linear potential flow.
struct FloatingBody {
  PotentialBody flow;
  RadiationModel radiation;
  Vec6 rest = Vec6::Zero();  ///< force and moment of still water in the reference [N, N m]
};

/// Buoyancy, restoring forces, waves and what the body radiates, linear in its motion from the
/// reference: displacement of its node and rotation theta = 1/2 sum D_i x d_i, both linear in the
/// directors, so that added mass at infinite frequency and restoring forces keep energy exactly.
/// The states of radiation follow by the midpoint rule, which takes energy as their model does.
/// In statics nothing moves, and the sea is as it is at time 0.
class PotentialLoad final : public model::MemorylessBatch,
                            public model::LimitedRange,
                            public model::LeftOutOfModes,
                            public flow::FluidForce {
 public:
  PotentialLoad(model::Effect effect, const model::NodeTable& nodes, model::Amplitude amplitude,
                std::shared_ptr<const Sea> sea, int node, FloatingBody body);

  /// Of the body.
  int node() const { return motion_.node(); }
  const Sea& sea() const { return *sea_; }

  int size() const override { return 1; }
  std::vector<int> blocks(int item, const model::UnknownTable& unknowns) const override;
  bool has_tangent() const override { return true; }
  Verdict assemble(const model::State& state, const Stencil& stencil, Want want,
                   model::Target& target) override;
  void accept(model::State& state) override;
  /// Velocities are those in the middle of the step, which other schemes do not know.
  bool needs_mean_velocity() const override { return true; }
  std::optional<Resultant> resultant() const override;
  /// Motions beyond a tenth of a radian leave the linear theory.
  double range_used() const override;
  std::string range_warning(double used) const override;
  std::string left_out_of_modes() const override;
  std::size_t memory_size() const override { return 8 + 12 * body_.radiation.terms.size(); }
  void save(model::Items items, std::span<double> numbers) const override;
  void restore(std::span<const double> numbers) override;
  model::StepWork step_work(const model::State& state, const Stencil& stencil) const override;

 private:
  using States = std::vector<Eigen::Matrix<std::complex<double>, 6, 1>>;  // one per pole
  struct Evaluation {
    Vec6 force = Vec6::Zero();       // and moment about the node
    Mat6 derivative = Mat6::Zero();  // by the motion at the end of the step
  };

  Vec6 waves(double time) const;
  Evaluation evaluate(const model::State& state, const Stencil& stencil, Want want,
                      States& trial) const;
  template <class Space>
  Verdict assemble_item(std::size_t i, const model::State& state, const Stencil& stencil, Want want,
                        model::Target& target);

  struct WaveForce {
    std::complex<double> force[6];  // of exp(i omega t)
    double frequency = 0.0;
  };

  const model::NodeTable& nodes_;
  model::Amplitude amplitude_;
  std::shared_ptr<const Sea> sea_;
  load::SmallMotion motion_;
  FloatingBody body_;
  std::vector<WaveForce> waves_;
  States accepted_, trial_;
  Resultant accepted_force_, trial_force_;
  double largest_turn_ = 0.0;
  bool has_stepped_ = false;
};

}  // namespace culm::water
