/// Moments on nodes.
#pragma once

#include <culm/load/axes.hpp>
#include <culm/model/amplitude.hpp>
#include <culm/model/booked.hpp>
#include <culm/model/memoryless_batch.hpp>
#include <culm/model/node_table.hpp>

#include <string>
#include <vector>

namespace culm::load {

/// Moments a(t) m on nodes, fixed in space or following the directors, m = M_k d_k,theta.
///
/// The null-space form adds m to the rotational residual itself. The multiplier form spreads it on
/// the directors so that sum_i d_i x f_i = m also where d_theta are shorter than one,
///   f_d_i = (Ac^-1 m) x d_i      Ac = sum_i ( |d_i|^2 1 - d_i d_i^T ),
/// hence both have the same solutions. On a shell node it is a couple on its director,
///   f_d = m x d / (d . d)
/// in both forms; the part of m along d is not carried. @source formulation 3.1, 3.2
class MomentLoad final : public model::MemorylessBatch, public model::Booked {
 public:
  MomentLoad(model::Effect effect, const model::NodeTable& nodes, model::Amplitude amplitude,
             Axes axes)
      : MemorylessBatch(std::move(effect)),
        nodes_(nodes),
        amplitude_(std::move(amplitude)),
        axes_(axes) {}

  /// @param components  of the moment [N m]; in space where the node is one of a shell
  void add_moment(int node, const Vec3& components) { items_.push_back({{node}, components}); }

  /// Changes one of them, by its place in the order of adding.
  void set_moment(int item, const Vec3& components) {
    items_[static_cast<std::size_t>(item)].components = components;
  }

  /// The largest share of a moment that its node does not carry in the reference, and that node:
  /// the part along the director of a shell. Nothing where all is carried.
  struct Lost {
    double share = 0.0;
    int node = -1;
  };
  Lost lost() const;

  int size() const override { return static_cast<int>(items_.size()); }
  std::vector<int> blocks(int item, const model::UnknownTable& unknowns) const override;
  /// A moment fixed in space has no stiffness on triads in the null-space form.
  bool has_tangent() const override;
  Verdict assemble(const model::State& state, const Stencil& stencil, Want want,
                   model::Target& target) override;
  /// Work m . tau over the Cayley rotation vector of the step. @source formulation 3.1
  model::StepWork step_work(const model::State& state, const Stencil& stencil) const override;

 private:
  struct Item {
    std::vector<int> nodes;  ///< one
    Vec3 components = Vec3::Zero();
  };
  /// The directors of an item, and its moment there.
  struct Motion {
    Mat3 mid, next;
    Vec3 components;  ///< times the amplitude
    Vec3 unit;        ///< in space, at amplitude 1
    Vec3 moment;      ///< in space
  };

  Motion motion(const Item& item, const model::State& state, double theta, double factor) const;
  Verdict assemble_reduced(std::size_t i, const Motion& motion, double theta, bool tangent,
                           model::Target& target) const;

  bool on_shell(const Item& item) const {
    return nodes_.kind(item.nodes.front()) == NodeKind::node6;
  }
  bool follows(const Item& item) const { return axes_ == Axes::directors && !on_shell(item); }
  template <class Space>
  Verdict assemble_couple(std::size_t i, const model::State& state, const Stencil& stencil,
                          double factor, bool tangent, model::Target& target) const;

  const model::NodeTable& nodes_;
  model::Amplitude amplitude_;
  Axes axes_;
  std::vector<Item> items_;
};

}  // namespace culm::load
