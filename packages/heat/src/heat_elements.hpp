/// Elements of structures that a temperature acts on.
#pragma once

#include <culm/heat/heat_batch.hpp>
#include <culm/model/build_context.hpp>
#include <culm/structure/plastic_batch.hpp>

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace culm::heat {

/// Temperatures as the deck describes them.
struct Temperatures {
  Temperature everywhere;
  model::SharedField field;  ///< of what is added by place: value and gradient; none if null
  model::Amplitude amplitude;

  /// In the reference.
  Temperature at(const Vec3& place) const {
    Temperature here = everywhere;
    if (field == nullptr) return here;
    const Vec3 more = field->value(place, 0.0);
    here.value += more[0];
    here.gradient += more.tail<2>();
    return here;
  }
};

/// What a load of the deck asks for, and where mistakes go.
struct HeatRequest {
  const Options& options;
  model::BuildContext& context;
  const model::Structure& structure;
  Temperatures temperatures;
};

/// Heats the structure if its elements are those of a family; a mistake is an issue.
/// @return whether they are
bool heat_beams(const HeatRequest& request);
bool heat_shells(const HeatRequest& request);

/// The place of a point with the shape functions N of the first nodes, in the reference.
template <class Shapes>
Vec3 place_of(std::span<const int> nodes, const Shapes& N, const model::Model& model) {
  Vec3 place = Vec3::Zero();
  for (Eigen::Index a = 0; a < N.size(); ++a) {
    place += N[a] *
             model::NodeTable::slots(model.nodes().reference(), nodes[static_cast<std::size_t>(a)])
                 .col(0);
  }
  return place;
}

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

/// Adds the batch that heats the cells of a structure of elements E: heat(cell, temperature) of
/// each.
template <class E, class Heat>
void add_heat(const HeatRequest& request, model::ElementBatch<E>& elements, Heat heat) {
  model::Model& model = request.context.model;
  const TemperatureAt here = [temperatures = request.temperatures](const Vec3& place) {
    return temperatures.at(place);
  };
  auto batch =
      std::make_unique<HeatBatch<E>>(model::Effect("Temperature", request.options.name()),
                                     model.nodes(), request.temperatures.amplitude, elements, here);
  for (const model::Cell& cell : request.structure.cells) batch->add(heat(cell, here));
  for (const auto& one : model.element_batches()) {
    const auto* other = dynamic_cast<const HeatBatch<E>*>(one.get());
    if (other == nullptr || &other->elements() != &elements) continue;
    const TemperatureAt both = [&](const Vec3& place) {
      const Temperature mine = here(place), its = other->temperature()(place);
      return Temperature{mine.value + its.value, mine.gradient + its.gradient};
    };
    // energies are quadratic: what that of the sum has more than both
    std::vector<double> energies;
    for (const model::Cell& cell : request.structure.cells) {
      const HeatedElement<E>* its = other->find(cell.item);
      energies.push_back(its == nullptr ? 0.0
                                        : heat(cell, both).energy - batch->find(cell.item)->energy -
                                              its->energy);
    }
    batch->add_between(*other, std::move(energies));
  }
  elements.show_with(*batch);
  model.add_element_batch(std::move(batch));
}

}  // namespace culm::heat
