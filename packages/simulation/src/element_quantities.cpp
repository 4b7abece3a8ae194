#include <culm/model/layer_source.hpp>
#include <culm/simulation/quantity.hpp>

#include <utility>

namespace culm::simulation {
namespace {

class StressResultants final : public Quantity {
 public:
  /// @param cells       of which the mean is shown
  /// @param per_length  whether they are per length, as those of shells
  StressResultants(std::vector<model::Cell> cells, bool per_length)
      : cells_(std::move(cells)), per_length_(per_length) {}

  std::vector<output::HistoryColumn> columns() const override {
    std::vector<output::HistoryColumn> columns;
    for (const std::string& name : cells_.front().source->resultant_names()) {
      const std::string unit = name.front() == 'M' ? "N m" : "N";
      columns.push_back({name, per_length_ ? unit + "/m" : unit});
    }
    return columns;
  }
  void evaluate(const assembly::System&, const model::State& state,
                std::vector<double>& numbers) const override {
    const std::size_t first = numbers.size();
    for (const model::Cell& cell : cells_) {
      std::vector<double> one;
      cell.source->resultants(cell.item, state.next, one);
      numbers.resize(first + one.size(), 0.0);
      for (std::size_t i = 0; i < one.size(); ++i) {
        numbers[first + i] += one[i] / static_cast<double>(cells_.size());
      }
    }
  }

 private:
  std::vector<model::Cell> cells_;
  bool per_length_;
};

// Stress or strain at a height of a layer of an element of a shell.
class LayerQuantity final : public Quantity {
 public:
  enum class Kind { stress, strain };

  LayerQuantity(Kind kind, std::shared_ptr<const model::LayerSource> source, std::vector<int> cells,
                int layer, int height)
      : kind_(kind),
        source_(std::move(source)),
        cells_(std::move(cells)),
        place_(static_cast<std::size_t>(layer) * model::layer_heights.size() +
               static_cast<std::size_t>(height)) {}

  std::vector<output::HistoryColumn> columns() const override {
    std::vector<output::HistoryColumn> columns;
    for (const char* component : {"11", "22", "33", "23", "13", "12"}) {
      columns.push_back(kind_ == Kind::stress
                            ? output::HistoryColumn{std::string("S") + component, "N/m^2"}
                            : output::HistoryColumn{std::string("E") + component, "1"});
    }
    return columns;
  }
  void evaluate(const assembly::System&, const model::State& state,
                std::vector<double>& numbers) const override {
    Vec6 shown = Vec6::Zero();
    for (int cell : cells_) {
      const model::LayerState layer = source_->states(cell, state.next)[place_];
      shown += kind_ == Kind::stress ? layer.stress : layer.strain;
    }
    shown /= static_cast<double>(cells_.size());
    numbers.insert(numbers.end(), shown.begin(), shown.end());
  }

 private:
  Kind kind_;
  std::shared_ptr<const model::LayerSource> source_;
  std::vector<int> cells_;
  std::size_t place_;
};

Field element_field() {
  return integer("Element", "Number of the element in the structure, from 0.").at_least(0);
}

// The structure, and the issue if it lacks the element.
const model::Structure* select_element(const Options& options, model::BuildContext& context) {
  const model::Structure* structure = model::select_structure(options, context);
  if (structure == nullptr) return nullptr;
  if (static_cast<std::size_t>(options.integer("Element")) < structure->numbered_cells()) {
    return structure;
  }
  context.issues.add(options.where("Element"),
                     "structure '" + structure->name + "' has elements 0 to " +
                         std::to_string(structure->numbered_cells() - 1) + ", got " +
                         std::to_string(options.integer("Element")));
  return nullptr;
}

std::unique_ptr<Quantity> make_stress_resultants(const Options& options,
                                                 model::BuildContext& context) {
  const model::Structure* structure = select_element(options, context);
  if (structure == nullptr) return nullptr;
  std::vector<model::Cell> cells;
  for (int cell : structure->cells_of(options.integer("Element"))) {
    cells.push_back(structure->cells[static_cast<std::size_t>(cell)]);
  }
  if (cells.front().source == nullptr) {
    context.issues.add(options.where("Structure"),
                       "structure '" + structure->name + "' is rigid and has no stress resultants");
    return nullptr;
  }
  return std::make_unique<StressResultants>(std::move(cells), structure->layers != nullptr);
}

std::unique_ptr<Quantity> make_layer_quantity(LayerQuantity::Kind kind, const Options& options,
                                              model::BuildContext& context) {
  const model::Structure* structure = select_element(options, context);
  if (structure == nullptr) return nullptr;
  if (structure->layers == nullptr) {
    context.issues.add(options.where("Structure"),
                       "structure '" + structure->name +
                           (structure->faces.empty() ? "' is no shell" : "' is rigid") +
                           " and has no layers");
    return nullptr;
  }
  const int layer = options.integer("Layer");
  if (layer >= structure->layers->layers()) {
    context.issues.add(options.where("Layer"), "structure '" + structure->name +
                                                   "' has layers 0 to " +
                                                   std::to_string(structure->layers->layers() - 1) +
                                                   ", got " + std::to_string(layer));
    return nullptr;
  }
  const std::string& height = options.text("Height");
  const int at = height == "Bottom" ? 0 : height == "Middle" ? 1 : 2;
  return std::make_unique<LayerQuantity>(
      kind, structure->layers, structure->cells_of(options.integer("Element")), layer, at);
}

void register_layer_quantity(QuantityRegistry& registry, const char* type, const char* doc,
                             LayerQuantity::Kind kind) {
  registry.add(
      type,
      Schema(type, doc)
          .add(model::structure_field())
          .add(element_field())
          .add(integer("Layer", "Number of the layer, the bottom one 0.").at_least(0).optional(0))
          .add(choice("Height", {"Bottom", "Middle", "Top"}, "Where within the layer.")
                   .optional("Middle")),
      [kind](const Options& options, model::BuildContext& context) {
        return make_layer_quantity(kind, options, context);
      });
}

class StrainEnergy final : public Quantity {
 public:
  std::vector<output::HistoryColumn> columns() const override { return {{"", "J"}}; }
  void evaluate(const assembly::System& system, const model::State& state,
                std::vector<double>& numbers) const override {
    numbers.push_back(system.strain_energy(state.next));
  }
};

class Energy final : public Quantity {
 public:
  std::vector<output::HistoryColumn> columns() const override {
    return {{"kinetic", "J"}, {"strain", "J"}, {"potential", "J"}, {"total", "J"}};
  }
  void evaluate(const assembly::System& system, const model::State& state,
                std::vector<double>& numbers) const override {
    const model::Momentum momentum = system.momentum(state.next, state.velocity);
    const assembly::Energies e = system.energies(state.next, momentum);
    numbers.insert(numbers.end(), {e.kinetic, e.strain, e.potential, e.total()});
  }
};

}  // namespace

void register_element_quantities(QuantityRegistry& registry) {
  registry.add(
      "Stress Resultants",
      Schema("Stress Resultants",
             "Stress resultants of an element in its directors, mean over its points; of a shell "
             "membrane forces N, moments M and shear forces Q per length in its local axes.")
          .add(model::structure_field())
          .add(element_field()),
      make_stress_resultants);
  register_layer_quantity(registry, "Layer Stress",
                          "Second Piola-Kirchhoff stress in a layer of a shell, at the centre of "
                          "an element, in the axes of the layer.",
                          LayerQuantity::Kind::stress);
  register_layer_quantity(registry, "Layer Strain",
                          "Green-Lagrange strain in a layer of a shell, at the centre of an "
                          "element, in the axes of the layer, shears in full.",
                          LayerQuantity::Kind::strain);
  registry.add("Strain Energy", Schema("Strain Energy", "Strain energy of the whole model."),
               [](const Options&, model::BuildContext&) -> std::unique_ptr<Quantity> {
                 return std::make_unique<StrainEnergy>();
               });
  registry.add(
      "Energy",
      Schema("Energy", "Kinetic, strain and potential energy of the whole model and their sum."),
      [](const Options&, model::BuildContext&) -> std::unique_ptr<Quantity> {
        return std::make_unique<Energy>();
      });
}

}  // namespace culm::simulation
