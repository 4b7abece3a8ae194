#include "model_builder.hpp"

#include <culm/model/booked.hpp>

#include "silent_quantity.hpp"

#include <algorithm>
#include <map>
#include <unordered_set>
#include <utility>
#include <variant>

namespace culm::simulation {
namespace {

// Everything of a list by name; mistakes that a maker throws are collected with all others.
template <class Product>
std::map<std::string, Product> make_all(const Registry<Product>& registry, const Options& list,
                                        InputIssues& issues) {
  std::map<std::string, Product> products;
  for (const Options& entry : list.entries()) {
    try {
      products.emplace(entry.name(), registry.make(entry.text("Type"), entry));
    } catch (const InputError& error) {
      for (const InputIssue& issue : error.issues()) issues.add(issue);
    }
  }
  return products;
}

template <class Context>
void build_one(const Registry<void, Context&>& registry, const Options& entry, Context& context,
               InputIssues& issues) {
  try {
    registry.make(entry.text("Type"), entry, context);
  } catch (const InputError& error) {
    for (const InputIssue& issue : error.issues()) issues.add(issue);
  }
}

void build_all(const model::BuilderRegistry& registry, const Options& list,
               model::BuildContext& context, const Inactive& inactive = {}) {
  for (const Options& entry : list.entries()) {
    if (!inactive.contains(entry.name())) build_one(registry, entry, context, context.issues);
  }
}

std::map<std::string, flow::SharedFlow> make_flows(const flow::FlowRegistry& registry,
                                                   const Options& list,
                                                   model::BuildContext& context) {
  std::map<std::string, flow::SharedFlow> flows;
  for (const Options& entry : list.entries()) {
    try {
      if (auto made = registry.make(entry.text("Type"), entry, context)) {
        flows.emplace(entry.name(), std::move(made));
      }
    } catch (const InputError& error) {
      for (const InputIssue& issue : error.issues()) context.issues.add(issue);
    }
  }
  return flows;
}

// Under the account that the deck names.
void book(const Options& entry, model::BuildContext& context) {
  const std::string& account = entry.text("Account");
  if (account.empty() || account == "others") {
    context.issues.add(entry.where("Account"),
                       "must be a name of its own; 'others' is all that has no account");
    return;
  }
  bool works = false;
  for (const auto& batch : context.model.loads()) {
    auto* booked = dynamic_cast<model::Booked*>(batch.get());
    if (booked == nullptr || batch->effect().name != entry.name()) continue;
    booked->book_under(account);
    works = true;
  }
  if (!works && context.issues.empty()) {
    context.issues.add(entry.where("Account"), "loads of type '" + entry.text("Type") +
                                                   "' do no work that could be booked");
  }
}

// Loads of all kinds stand in one list, in any order.
void build_loads(const Catalogue& catalogue, const Options& list, const Inactive& inactive,
                 strip::StripContext& strips) {
  flow::FluidContext& fluids = strips.fluids;
  for (const Options& entry : list.entries()) {
    if (inactive.contains(entry.name())) continue;
    const std::string& type = entry.text("Type");
    if (catalogue.fluid_loads.contains(type)) {
      build_one(catalogue.fluid_loads, entry, fluids, fluids.build.issues);
    } else if (catalogue.strips.contains(type)) {
      build_one(catalogue.strips, entry, strips, fluids.build.issues);
    } else {
      build_one(catalogue.loads, entry, fluids.build, fluids.build.issues);
    }
  }
  fluids.finish();
  for (const Options& entry : list.entries()) {
    if (entry.has("Account") && !inactive.contains(entry.name())) book(entry, fluids.build);
  }
}

void build_structures(const structure::StructureRegistry& registry, const Options& list,
                      structure::StructureContext& context) {
  for (const Options& entry : list.entries()) {
    if (entry.name().find('@') != std::string::npos) {
      context.issues.add(entry.where(),
                         "the name of a structure must not contain '@', which stands before its "
                         "points");
      continue;
    }
    build_one(registry, entry, context, context.issues);
  }
}

// Some structures bring others with them, so what is looked at are those that were built.
void refuse_equal_names(const Options& list, const model::BuildContext& context) {
  std::map<std::string, int> counts;
  for (const model::Structure& structure : context.model.structures()) ++counts[structure.name];
  for (const Options& entry : list.entries()) {
    if (counts[entry.name()] < 2) continue;
    context.issues.add(entry.where(), "another structure brings one of this name with it");
  }
}

// A set must not stand for what has its name already: a structure, its nodes or its edges.
bool is_free(const Options& entry, const model::BuildContext& context) {
  const std::string structure = entry.name().substr(0, entry.name().find('@'));
  if (context.model.find_structure(structure) == nullptr) return true;
  context.issues.add(entry.where(), structure == entry.name()
                                        ? "there is a structure of this name"
                                        : "names that begin with '" +
                                              entry.name().substr(0, structure.size() + 1) +
                                              "' stand for parts of the structure '" + structure +
                                              "'");
  return false;
}

// Entries may overlap, as edges do at their corner: each node is there once, where it comes first.
void add_node_sets(const Options& list, model::BuildContext& context) {
  for (const Options& entry : list.entries()) {
    if (!is_free(entry, context)) continue;
    std::vector<int> nodes;
    std::unordered_set<int> known;
    for (const std::string& name : entry.texts("Nodes")) {
      for (const int node : model::find_nodes(name, entry.where("Nodes"), context)) {
        if (known.insert(node).second) nodes.push_back(node);
      }
    }
    context.model.add_node_set(entry.name(), std::move(nodes));
  }
}

void build_signals(const control::SignalRegistry& registry, const Options& list,
                   model::Model& model, std::map<std::string, model::Amplitude>& functions,
                   InputIssues& issues) {
  control::ControlContext context(model, functions, issues);
  for (const Options& entry : list.entries()) build_one(registry, entry, context, issues);
  context.finish();
}

std::vector<int> read_elements(const Options& options) {
  if (options.has("Elements")) return options.integers("Elements");
  std::vector<int> elements;
  const std::vector<int>& range = options.integers("Range");
  for (int element = range[0]; element <= range[1]; ++element) elements.push_back(element);
  return elements;
}

// Whether a structure of so many elements has those of a set, at least one; before a range is
// written out, which may be a long one.
bool has_elements(const Options& options, int count) {
  const auto is_inside = [count](int element) { return element < count; };
  if (options.has("Range")) {
    const std::vector<int>& range = options.integers("Range");
    return range[0] <= range[1] && is_inside(range[1]);
  }
  const std::vector<int>& elements = options.integers("Elements");
  return std::all_of(elements.begin(), elements.end(), is_inside);
}

void add_element_sets(const Options& list, model::BuildContext& context) {
  for (const Options& entry : list.entries()) {
    const model::Structure* structure = model::select_structure(entry, context);
    if (structure == nullptr) continue;
    if (!is_free(entry, context)) continue;
    const auto count = static_cast<int>(structure->numbered_cells());
    if (!has_elements(entry, count)) {
      context.issues.add(
          entry.where(entry.has("Range") ? "Range" : "Elements"),
          "structure '" + structure->name + "' has elements 0 to " + std::to_string(count - 1));
      continue;
    }
    context.model.add_element_set(entry.name(), *structure, read_elements(entry));
  }
}

// Whether what a quantity shows is of a load or constraint among these. Nodes, structures and
// signals may be called like one.
bool is_of_any(const Options& entry, const Inactive& names) {
  const auto& parameters = entry.parameters();
  return std::any_of(parameters.begin(), parameters.end(), [&](const auto& parameter) {
    if (parameter.name != "Load" && parameter.name != "Constraint") return false;
    const auto* text = parameter.value ? std::get_if<std::string>(&*parameter.value) : nullptr;
    return text != nullptr && names.contains(*text);
  });
}

std::vector<WatchedQuantity> make_quantities(const Catalogue& catalogue, const Options& list,
                                             const Inactive& inactive,
                                             model::BuildContext& context) {
  std::vector<WatchedQuantity> watched;
  for (const Options& entry : list.entries()) {
    if (is_of_any(entry, inactive)) {
      watched.push_back({entry.name(), std::make_unique<SilentQuantity>()});
      continue;
    }
    auto quantity = catalogue.quantities.make(entry.text("Type"), entry, context);
    if (quantity) watched.push_back({entry.name(), std::move(quantity)});
  }
  return watched;
}

std::vector<std::unique_ptr<port::Port>> make_ports(const Catalogue& catalogue, const Options& list,
                                                    model::BuildContext& context) {
  std::vector<std::unique_ptr<port::Port>> ports;
  for (const Options& entry : list.entries()) {
    auto places = catalogue.ports.make(entry.text("Type"), entry, context);
    if (places.empty()) continue;
    ports.push_back(port::add_port(entry.name(), std::move(places), context.model));
  }
  return ports;
}

model::SizeDemands demands_of(const Options& deck) {
  model::SizeDemands demands;
  for (const Options& analysis : deck.list("Analyses").entries()) {
    for (const Options::Parameter& parameter : analysis.parameters()) {
      if (parameter.name != "Modes") continue;
      demands.modes = std::max(demands.modes, analysis.integer(parameter.name));
    }
  }
  // eigenproblems are solved with factors
  const std::string& solver = deck.list("Solver").text("Linear Solver");
  demands.has_multipliers = deck.list("Solver").text("Form") == "Multipliers";
  demands.may_iterate = demands.modes == 0 && (solver == "Automatic" || solver == "Iterative");
  const Options& layers = deck.list("Output").list("Shell");
  demands.layer_arrays = (layers.flag("Stresses") ? 1 : 0) + (layers.flag("Strains") ? 1 : 0);
  if (layers.has("Layers")) {
    demands.shown_layers = static_cast<double>(layers.integers("Layers").size());
  }
  return demands;
}

}  // namespace

BuiltWith build_model(const Catalogue& catalogue, const Options& deck,
                      const Imperfections& imperfections, const Setting& setting, const Log& log,
                      double memory, model::Processes processes, model::Model& model) {
  InputIssues issues;
  model::SizeDemands demands = demands_of(deck);
  demands.processes = processes;
  model::SizeBudget budget(memory, demands);
  const auto sections = make_all(catalogue.sections, deck.list("Sections"), issues);
  const auto materials = make_all(catalogue.materials, deck.list("Materials"), issues);
  auto functions = make_all(catalogue.functions, deck.list("Functions"), issues);
  if (setting.is_path) functions.emplace("Ramp", model::Amplitude::level());
  const int refinement = deck.integer("Refinement");
  const model::Imperfection imperfection = imperfections.sum(setting.inactive);
  structure::StructureContext structures{model, sections,   materials,     issues,
                                         log,   refinement, &imperfection, &budget};
  model::BuildContext context{model, functions, issues,
                              make_all(catalogue.fields, deck.list("Fields"), issues)};
  build_structures(catalogue.structures, deck.list("Structures"), structures);
  refuse_equal_names(deck.list("Structures"), context);
  // what follows refers to structures; without them every reference would be a mistake
  issues.throw_if_any();
  add_node_sets(deck.list("Node Sets"), context);
  add_element_sets(deck.list("Element Sets"), context);
  build_all(catalogue.masses, deck.list("Masses"), context);
  build_signals(catalogue.signals, deck.list("Signals"), model, functions, issues);
  build_all(catalogue.constraints, deck.list("Constraints"), context, setting.inactive);
  flow::FluidContext fluids(context, make_flows(catalogue.flows, deck.list("Flows"), context),
                            memory / processes.here);  // each has what fluids need
  strip::StripContext strips(fluids, make_all(catalogue.airfoils, deck.list("Airfoils"), issues));
  // an airfoil whose file is wrong is no unknown one
  issues.throw_if_any();
  build_loads(catalogue, deck.list("Loads"), setting.inactive, strips);
  auto ports = make_ports(catalogue, deck.list("Ports"), context);
  build_all(catalogue.initial_conditions, deck.list("Initial Conditions"), context);
  // nor is a load that could not be made
  issues.throw_if_any();
  auto watched =
      make_quantities(catalogue, deck.list("Output").list("History"), setting.inactive, context);
  issues.throw_if_any();
  const bool null_space = deck.list("Solver").text("Form") == "Null Space";
  for (const std::string& note :
       model.freeze(null_space ? model::Form::null_space : model::Form::multipliers)) {
    log.info("note: " + note);
  }
  const Options& history = deck.list("Output").list("History");
  for (std::size_t i = 0; i < watched.size(); ++i) {
    const std::string objection = watched[i].quantity->objection(model);
    if (!objection.empty()) issues.add(history.entries()[i].where("Node"), objection);
  }
  issues.throw_if_any();
  return {std::move(watched), std::move(ports), budget.taken()};
}

}  // namespace culm::simulation
