/// Loads of water on slender members.
#pragma once

#include <culm/flow/fluid_force.hpp>
#include <culm/model/amplitude.hpp>
#include <culm/model/memoryless_batch.hpp>
#include <culm/model/method_limits.hpp>
#include <culm/water/member.hpp>
#include <culm/water/sea.hpp>

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace culm::water {

/// Water on straight segments of members with circular sections: pressure of the undisturbed
/// water, drag and added mass after Morison in velocity and acceleration relative to the member, up
/// to the surface that cuts it. Points of a segment are linear between its ends, so forces come to
/// the slots by the transpose of the same map, and their work over a step is F . Dx. In statics
/// nothing moves, and the sea is as it is at time 0. @source fluids B7
class MorisonLoad final : public model::MemorylessBatch,
                          public model::LimitedRange,
                          public model::PartialTangent,  // without the gradient of the waves
                          public flow::FluidForce {
 public:
  static constexpr int max_nodes = 8;

  MorisonLoad(model::Effect effect, const model::NodeTable& nodes, model::Amplitude amplitude,
              std::shared_ptr<const Sea> sea, MorisonModel model)
      : MemorylessBatch(std::move(effect)),
        FluidForce(*sea),
        nodes_(nodes),
        amplitude_(std::move(amplitude)),
        sea_(std::move(sea)),
        model_(model) {}

  void add(Segment segment);
  /// What the load acts on: a member by a name of its own, and the part of its length.
  void cover(std::string member, double begin, double end) {
    member_ = std::move(member);
    begin_ = begin;
    end_ = end;
  }
  /// Whether another load acts on a part of the same.
  bool meets(const MorisonLoad& other) const;

  /// Where a dry face of this load and one of another meet in line and are as wide, there is none:
  /// no water presses on either, and what one would take back the other would give again. Like
  /// neighbours along one member they then lean on nothing that a tilt between them could change.
  /// Where both act on parts of one member that touch, both know that the other is there.
  void join(MorisonLoad& other);

  const Sea& sea() const { return *sea_; }
  /// Whether the member is carried by a node, among others.
  bool acts_on(int node) const;
  /// Whether any of it has drag across its axis.
  bool has_drag() const;
  /// One of those that carry the member.
  int first_node() const { return items_.front().nodes.front(); }

  int size() const override { return static_cast<int>(items_.size()); }
  std::vector<int> blocks(int item, const model::UnknownTable& unknowns) const override;
  bool has_tangent() const override { return true; }
  void place(model::Placement placement, model::Form form) override;
  Verdict assemble(const model::State& state, const Stencil& stencil, Want want,
                   model::Target& target) override;
  void accept(model::State& state) override;
  /// Velocities are those in the middle of the step, which other schemes do not know.
  bool needs_mean_velocity() const override { return true; }
  std::optional<Resultant> resultant() const override;
  double range_used() const override;
  std::string range_warning(double used) const override;
  std::size_t memory_size() const override { return 1 + 6 * items_.size(); }
  void save(model::Items items, std::span<double> numbers) const override;
  void restore(std::span<const double> numbers) override;
  model::StepWork step_work(const model::State& state, const Stencil& stencil) const override;

 private:
  /// What the slots of a node do for the ends of a segment.
  using Factors = Mat<4, 2>;
  struct Item {
    Segment segment;
    std::vector<int> nodes;        ///< of both ends, each once
    std::vector<Factors> factors;  ///< one per node
    double exposed = 0.0;          ///< length that waves reach in the reference [m]
    bool owned = false;            ///< whether this rank counts it in sums
    Resultant accepted, trial;
    /// How high the water stands above an end beyond which the member goes on upward [m].
    double swamped = 0.0, trial_swamped = 0.0;
  };
  struct Evaluation;
  /// A face to which no water comes, in the reference.
  struct DryFace {
    Face* face = nullptr;
    const WetSection* section = nullptr;
    Vec3 place, outward;
  };
  std::vector<DryFace> dry_faces();
  Mat<3, 2> reference_ends(const Item& item) const;

  template <class Number>
  Evaluation evaluate(const Item& item, const model::State& state, const Stencil& stencil,
                      Want want) const;
  template <class Space>
  Verdict assemble_item(std::size_t i, const model::State& state, const Stencil& stencil, Want want,
                        model::Target& target);

  const model::NodeTable& nodes_;
  model::Amplitude amplitude_;
  std::shared_ptr<const Sea> sea_;
  MorisonModel model_;
  std::string member_;
  double begin_ = 0.0, end_ = 1.0;
  std::vector<Item> items_;
  bool has_stepped_ = false;
};

}  // namespace culm::water
