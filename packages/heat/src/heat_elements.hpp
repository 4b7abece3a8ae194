/// Elements of structures that a temperature acts on.
#pragma once

#include <culm/heat/heat_batch.hpp>
#include <culm/model/build_context.hpp>
#include <culm/structure/plastic_batch.hpp>

#include <memory>
#include <string>
#include <vector>

namespace culm::heat {

/// A temperature as the deck describes it, at amplitude 1.
struct Temperature {
  double value = 0.0;            ///< above the stress-free state, on the axis or surface [K]
  std::vector<double> gradient;  ///< by xi1 and xi2 of a beam, by zeta of a shell [K/m]
  model::Amplitude amplitude;
};

/// What a load of the deck asks for, and where mistakes go.
struct HeatRequest {
  const Options& options;
  model::BuildContext& context;
  const model::Structure& structure;
  Temperature temperature;
};

/// Heats the structure if its elements are those of a family; a mistake is an issue.
/// @return whether they are
bool heat_beams(const HeatRequest& request);
bool heat_shells(const HeatRequest& request);

/// Whether 'Gradient' has none or `size` values; an issue if not.
bool has_gradients(std::size_t size, const std::string& kind, const HeatRequest& request);

/// The batch of elements E of a model that is the source of a cell, or null.
template <class E>
model::ElementBatch<E>* batch_of(const model::Cell& cell, const model::Model& model) {
  for (const auto& batch : model.element_batches()) {
    auto* elements = dynamic_cast<model::ElementBatch<E>*>(batch.get());
    if (elements != nullptr && cell.source == elements) return elements;
  }
  return nullptr;
}

/// Adds the batch that heats the cells of a structure of elements E: heat(batch, item) of each.
template <class E, class Heat>
void add_heat(const HeatRequest& request, model::ElementBatch<E>& elements, Heat heat) {
  model::Model& model = request.context.model;
  auto batch =
      std::make_unique<HeatBatch<E>>(model::Effect("Temperature", request.options.name()),
                                     model.nodes(), request.temperature.amplitude, elements);
  for (const model::Cell& cell : request.structure.cells) batch->add(heat(cell.item));
  elements.show_with(*batch);
  model.add_element_batch(std::move(batch));
}

}  // namespace culm::heat
