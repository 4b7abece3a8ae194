/// What a history can watch.
#pragma once

#include <culm/assembly/system.hpp>
#include <culm/base/registry.hpp>
#include <culm/model/build_context.hpp>
#include <culm/output/picture_mesh.hpp>

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace culm::simulation {

/// Some numbers of the state of a step.
class Quantity {
 public:
  virtual ~Quantity() = default;
  /// One per number, named below the name that the deck gives the quantity.
  virtual std::vector<output::HistoryColumn> columns() const = 0;
  /// Nodes whose coordinates and velocities it reads; none: it may read everything.
  virtual std::optional<std::vector<int>> nodes() const { return {}; }
  /// Appends the numbers. Called on all ranks, with what it reads up to date on all of them.
  virtual void evaluate(const assembly::System& system, const model::State& state,
                        std::vector<double>& numbers) const = 0;
  /// What it remembers of earlier states, such as turns that were counted; always as many numbers.
  virtual std::vector<double> memory() const { return {}; }
  /// Takes it back.
  virtual void restore(std::span<const double> /*memory*/) {}
  /// Whether its numbers are wrong where it cannot take it back, as of turns that nobody counted.
  virtual bool relies_on_memory() const { return false; }
  /// What is doubtful about the numbers given last, to follow the name of the quantity; empty if
  /// nothing is.
  virtual std::string doubt() const { return {}; }
  /// Why a model whose unknowns are known does not have it; empty if it does.
  virtual std::string objection(const model::Model&) const { return {}; }
};

/// A quantity under the name that the deck gives it.
struct WatchedQuantity {
  std::string name;
  std::unique_ptr<Quantity> quantity;
};

/// The columns of all, each with the name of its quantity.
std::vector<output::HistoryColumn> columns_of(const std::vector<WatchedQuantity>& watched);
/// The nodes that all of them read, each once and rising; none: everything.
std::optional<std::vector<int>> nodes_of(const std::vector<WatchedQuantity>& watched);
/// The numbers of all, of a state where what they read is up to date on all ranks.
std::vector<double> evaluate(const std::vector<WatchedQuantity>& watched,
                             const assembly::System& system, const model::State& state);

/// What is doubtful about the numbers given last, a sentence for each quantity concerned.
std::vector<std::string> doubts_of(const std::vector<WatchedQuantity>& watched);

/// Makers report mistakes as issues and may then return nothing.
using QuantityRegistry = Registry<std::unique_ptr<Quantity>, model::BuildContext&>;

/// Position, Displacement, Rotation, Velocity, Angular Velocity and Reaction of a node.
void register_node_quantities(QuantityRegistry& registry);
/// The value of a signal.
void register_signal_quantity(QuantityRegistry& registry);
/// Springs, dampers, drives and angles of joints.
void register_link_quantities(QuantityRegistry& registry);
/// Stress resultants of an element, energies and momenta.
void register_element_quantities(QuantityRegistry& registry);
/// Force and moment in a section of a beam.
void register_section_loads(QuantityRegistry& registry);
/// Of two points, or of a point and a beam.
void register_distance_quantity(QuantityRegistry& registry);

}  // namespace culm::simulation
