#include <culm/simulation/quantity.hpp>

#include <utility>

namespace culm::simulation {
namespace {

class StressResultants final : public Quantity {
 public:
  explicit StressResultants(model::Cell cell) : cell_(std::move(cell)) {}

  std::vector<output::HistoryColumn> columns() const override {
    std::vector<output::HistoryColumn> columns;
    for (const std::string& name : cell_.source->resultant_names()) {
      columns.push_back({name, name.front() == 'M' ? "N m" : "N"});
    }
    return columns;
  }
  void evaluate(const assembly::System&, const model::State& state,
                std::vector<double>& numbers) const override {
    cell_.source->resultants(cell_.item, state.next, numbers);
  }

 private:
  model::Cell cell_;
};

std::unique_ptr<Quantity> make_stress_resultants(const Options& options,
                                                 model::BuildContext& context) {
  const model::Structure* structure = model::select_structure(options, context);
  if (structure == nullptr) return nullptr;
  const auto element = static_cast<std::size_t>(options.integer("Element"));
  if (element >= structure->cells.size()) {
    context.issues.add(options.where("Element"), "structure '" + structure->name +
                                                     "' has elements 0 to " +
                                                     std::to_string(structure->cells.size() - 1) +
                                                     ", got " + std::to_string(element));
    return nullptr;
  }
  if (structure->cells[element].source == nullptr) {
    context.issues.add(options.where("Structure"),
                       "structure '" + structure->name + "' is rigid and has no stress resultants");
    return nullptr;
  }
  return std::make_unique<StressResultants>(structure->cells[element]);
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
             "Stress resultants of an element in its directors, mean over its points.")
          .add(model::structure_field())
          .add(integer("Element", "Number of the element in the structure, from 0.").at_least(0)),
      make_stress_resultants);
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
