/// The layers of the elements of one structure, for results.
#pragma once

#include <culm/model/element_batch.hpp>
#include <culm/model/layer_source.hpp>
#include <culm/model/shear_source.hpp>
#include <culm/shell/shell_results.hpp>

#include <memory>
#include <utility>
#include <vector>

namespace culm::shell {

/// Elements of type E of one layup, one per cell.
template <class E>
class ShellLayers final : public model::LayerSource, public model::ShearSource {
 public:
  /// @param items     of the batch, which must outlive this, one or more
  /// @param left_out  see ShearSource
  ShellLayers(const model::ElementBatch<E>& batch, std::vector<int> items,
              std::shared_ptr<const material::Layup> layup, const Vec<2>& left_out)
      : batch_(batch), items_(std::move(items)), layup_(std::move(layup)), left_out_(left_out) {}

  std::vector<Layer> shear_layers() const override {
    std::vector<Layer> layers;
    for (const material::Layer& layer : layup_->layers) {
      layers.push_back({layer.thickness, layer.angle});
    }
    return layers;
  }
  Vec<2> left_out() const override { return left_out_; }

  int layers() const override { return static_cast<int>(layup_->layers.size()); }

  bool owns(int cell) const override { return batch_.owns(items_[static_cast<std::size_t>(cell)]); }

  std::vector<LayerState> states(int cell, const model::Coordinates& q) const override {
    const int item = items_[static_cast<std::size_t>(cell)];
    const E& element = batch_.element(item);
    const auto& nodes = batch_.nodes(item);
    constexpr int K = slots_of(E::node_kind);
    Slots<E::num_slots> slots;
    for (int a = 0; a < E::num_nodes; ++a) {
      const model::NodeSlots node = model::NodeTable::slots(q, nodes[static_cast<std::size_t>(a)]);
      slots.template middleCols<K>(K * a) = node.leftCols<K>();
    }
    typename E::Strain y;
    element.strain(0, slots, y);
    if constexpr (ElementWithInternals<E>) {
      typename E::Internals internals = E::Internals::Zero();
      Response<E::num_strains> response;
      element.respond(0, y, y, internals, Stencil::statics(), internals, response);
      return collect([&](int layer, double height) {
        return element.layer_state(layer, height, y, internals);
      });
    } else {
      std::vector<LayerState> states =
          collect([&](int layer, double height) { return element.layer_state(layer, height, y); });
      for (const auto* more : batch_.added_stresses()) more->add_layer_states(item, states);
      return states;
    }
  }

 private:
  template <class At>
  std::vector<LayerState> collect(At&& at) const {
    std::vector<LayerState> states;
    for (int layer = 0; layer < layers(); ++layer) {
      for (const double height : {-1.0, 0.0, 1.0}) states.push_back(at(layer, height));
    }
    return states;
  }

  const model::ElementBatch<E>& batch_;
  std::vector<int> items_;
  std::shared_ptr<const material::Layup> layup_;
  Vec<2> left_out_;
};

}  // namespace culm::shell
