#include <culm/model/layer_source.hpp>
#include <culm/parallel/owned_numbers.hpp>
#include <culm/simulation/quantity.hpp>

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace culm::simulation {
namespace {

// Mean over the cells that an element of the deck was divided into. Collective.
std::vector<double> mean_resultants(const std::vector<model::Cell>& cells,
                                    const assembly::System& system, const model::Coordinates& q) {
  const auto cell_of = [&](int i) -> const model::Cell& {
    return cells[static_cast<std::size_t>(i)];
  };
  const std::size_t width = cells.front().source->resultant_names().size();
  const std::vector<double> all = parallel::share_owned(
      system.comm(), cells.size(), width,
      [&](int i) { return cell_of(i).source->owns(cell_of(i).item); },
      [&](int i, std::vector<double>& numbers) {
        cell_of(i).source->resultants(cell_of(i).item, q, numbers);
      });
  std::vector<double> mean(width, 0.0);
  for (std::size_t i = 0; i < all.size(); ++i) {
    mean[i % width] += all[i] / static_cast<double>(cells.size());
  }
  return mean;
}

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
  std::optional<std::vector<int>> nodes() const override { return std::vector<int>(); }
  void evaluate(const assembly::System& system, const model::State& state,
                std::vector<double>& numbers) const override {
    const std::vector<double> mean = mean_resultants(cells_, system, state.next);
    numbers.insert(numbers.end(), mean.begin(), mean.end());
  }

 private:
  std::vector<model::Cell> cells_;
  bool per_length_;
};

// Stresses at a point of a cross-section, linear in its six resultants.
class SectionStress final : public Quantity {
 public:
  struct Component {
    const char* name;
    Vec6 factors;  // of N1, N2, N3, M1, M2, M3 [1/m^2, 1/m^3]
  };
  SectionStress(std::vector<model::Cell> cells, std::vector<Component> components)
      : cells_(std::move(cells)), components_(std::move(components)) {}

  std::vector<output::HistoryColumn> columns() const override {
    std::vector<output::HistoryColumn> columns;
    for (const Component& component : components_) columns.push_back({component.name, "N/m^2"});
    return columns;
  }
  std::optional<std::vector<int>> nodes() const override { return std::vector<int>(); }
  void evaluate(const assembly::System& system, const model::State& state,
                std::vector<double>& numbers) const override {
    const Vec6 resultants(mean_resultants(cells_, system, state.next).data());
    for (const Component& component : components_) {
      numbers.push_back(component.factors.dot(resultants));
    }
  }

 private:
  std::vector<model::Cell> cells_;
  std::vector<Component> components_;
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
  std::optional<std::vector<int>> nodes() const override { return std::vector<int>(); }
  void evaluate(const assembly::System& system, const model::State& state,
                std::vector<double>& numbers) const override {
    const auto cell_of = [&](int i) { return cells_[static_cast<std::size_t>(i)]; };
    const std::vector<double> all = parallel::share_owned(
        system.comm(), cells_.size(), 6, [&](int i) { return source_->owns(cell_of(i)); },
        [&](int i, std::vector<double>& values) {
          const model::LayerState layer = source_->states(cell_of(i), state.next)[place_];
          const Vec6& one = kind_ == Kind::stress ? layer.stress : layer.strain;
          values.insert(values.end(), one.begin(), one.end());
        });
    Vec6 shown = Vec6::Zero();
    for (std::size_t i = 0; i < all.size(); i += 6) shown += Vec6(all.data() + i);
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

// The cells of an element that has stress resultants; none, and an issue, if it has not.
std::vector<model::Cell> select_cells(const model::Structure& structure, const Options& options,
                                      model::BuildContext& context) {
  std::vector<model::Cell> cells;
  for (int cell : structure.cells_of(options.integer("Element"))) {
    cells.push_back(structure.cells[static_cast<std::size_t>(cell)]);
  }
  if (cells.front().source != nullptr) return cells;
  context.issues.add(options.where("Structure"),
                     "structure '" + structure.name + "' is rigid and has no stress resultants");
  return {};
}

std::unique_ptr<Quantity> make_stress_resultants(const Options& options,
                                                 model::BuildContext& context) {
  const model::Structure* structure = select_element(options, context);
  if (structure == nullptr) return nullptr;
  std::vector<model::Cell> cells = select_cells(*structure, options, context);
  if (cells.empty()) return nullptr;
  return std::make_unique<StressResultants>(std::move(cells), structure->layers != nullptr);
}

// S33 = N3 / A + K1 xi2 - K2 xi1 with (M1, M2) = (I1, -I12; -I12, I2) (K1, K2)
Vec6 bending_factors(const Options& options) {
  const double I1 = options.number("I1");
  const double I2 = options.number("I2");
  const double I12 = options.number("I12");
  const double xi1 = options.numbers("Position")[0];
  const double xi2 = options.numbers("Position")[1];
  const double D = I1 * I2 - I12 * I12;
  Vec6 factors;
  factors << 0.0, 0.0, 1.0 / options.number("Area"), (I2 * xi2 - I12 * xi1) / D,
      (I12 * xi2 - I1 * xi1) / D, 0.0;
  return factors;
}

std::unique_ptr<Quantity> make_section_stress(const Options& options,
                                              model::BuildContext& context) {
  const model::Structure* structure = select_element(options, context);
  if (structure == nullptr) return nullptr;
  std::vector<model::Cell> cells = select_cells(*structure, options, context);
  if (cells.empty()) return nullptr;
  if (cells.front().source->resultant_names().size() != 6) {
    context.issues.add(options.where("Structure"),
                       "structure '" + structure->name +
                           "' does not have the six stress resultants of a beam of 'Fidelity' Full "
                           "or Linear, with torsion");
    return nullptr;
  }
  std::vector<SectionStress::Component> components;
  if (options.has("Position")) components.push_back({"S33", bending_factors(options)});
  for (const auto& [parameter, name] :
       {std::pair{"Normal", "S33"}, {"Shear 1", "S13"}, {"Shear 2", "S23"}}) {
    if (!options.has(parameter)) continue;
    components.push_back({name, Vec6(options.numbers(parameter).data())});
  }
  return std::make_unique<SectionStress>(std::move(cells), std::move(components));
}

void check_section_stress(const Options& options, InputIssues& issues) {
  const bool is_shape = options.has("Position");
  for (const char* needed : {"Area", "I1", "I2"}) {
    if (options.has(needed) == is_shape) continue;
    issues.add(options.where(), std::string("'Position' and '") + needed + "' need each other");
    return;
  }
  if (is_shape && options.has("Normal")) {
    issues.add(options.where("Normal"), "the normal stress is given by 'Position' already");
  } else if (is_shape) {
    const double largest = std::sqrt(options.number("I1") * options.number("I2"));
    if (std::abs(options.number("I12")) >= largest) {
      issues.add(options.where("I12"),
                 fmt::format("must lie between -{0:g} and {0:g} m^4, the root "
                             "of 'I1' times 'I2', got {1:g}",
                             largest, options.number("I12")));
    }
  } else if (!options.has("Normal") && !options.has("Shear 1") && !options.has("Shear 2")) {
    issues.add(options.where(), "needs 'Position', 'Normal', 'Shear 1' or 'Shear 2'");
  }
}

Field factors_field(const char* name, const char* stress) {
  return numbers(name, "",
                 std::string(stress) + " by N1, N2, N3, M1, M2, M3: six factors, 1/m^2 and 1/m^3.")
      .size(6)
      .optional();
}

Schema section_stress_schema() {
  return Schema("Section Stress",
                "Stresses at a point of the cross-section of a beam, from the stress resultants of "
                "an element, mean over its points.")
      .add(model::structure_field())
      .add(element_field())
      .add(numbers("Position", "m",
                   "Place of the point along d1 and d2, for the normal stress by area and second "
                   "moments of a section whose centroid lies on the axis.")
               .size(2)
               .optional())
      .add(number("Area", "m^2", "Area of the section.").positive().optional())
      .add(number("I1", "m^4", "Integral of xi2^2, bending about d1.").positive().optional())
      .add(number("I2", "m^4", "Integral of xi1^2, bending about d2.").positive().optional())
      .add(number("I12", "m^4", "Integral of xi1 xi2.").optional(0.0))
      .add(factors_field("Normal", "Or the normal stress S33 of any section"))
      .add(factors_field("Shear 1", "Shear stress S13 along d1"))
      .add(factors_field("Shear 2", "Shear stress S23 along d2"))
      .check(check_section_stress);
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
  std::optional<std::vector<int>> nodes() const override { return std::vector<int>(); }
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
  std::optional<std::vector<int>> nodes() const override { return std::vector<int>(); }
  void evaluate(const assembly::System& system, const model::State& state,
                std::vector<double>& numbers) const override {
    const double kinetic = system.kinetic_energy(state.velocity);
    const assembly::Energies e = system.energies(state.next, kinetic);
    numbers.insert(numbers.end(), {e.kinetic, e.strain, e.potential, e.total()});
  }
};

class Momenta final : public Quantity {
 public:
  std::vector<output::HistoryColumn> columns() const override {
    return {{"lx", "N s"},   {"ly", "N s"},   {"lz", "N s"},
            {"Lx", "N m s"}, {"Ly", "N m s"}, {"Lz", "N m s"}};
  }
  std::optional<std::vector<int>> nodes() const override { return std::vector<int>(); }
  void evaluate(const assembly::System& system, const model::State& state,
                std::vector<double>& numbers) const override {
    const model::Momentum momentum = system.momentum(state.next, state.velocity);
    for (const Vec3& one : {momentum.linear, momentum.angular}) {
      numbers.insert(numbers.end(), one.begin(), one.end());
    }
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
  registry.add("Section Stress", section_stress_schema(), make_section_stress);
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
  registry.add("Momentum",
               Schema("Momentum",
                      "Linear momentum of the whole model, and angular momentum about the origin."),
               [](const Options&, model::BuildContext&) -> std::unique_ptr<Quantity> {
                 return std::make_unique<Momenta>();
               });
  registry.add(
      "Energy",
      Schema("Energy", "Kinetic, strain and potential energy of the whole model and their sum."),
      [](const Options&, model::BuildContext&) -> std::unique_ptr<Quantity> {
        return std::make_unique<Energy>();
      });
}

}  // namespace culm::simulation
