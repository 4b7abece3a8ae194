#include <culm/math/rotation.hpp>
#include <culm/simulation/quantity.hpp>

#include <functional>
#include <string>
#include <utility>

namespace culm::simulation {
namespace {

using model::NodeTable;
using output::HistoryColumn;

// A quantity that is a function of one node.
class NodeQuantity final : public Quantity {
 public:
  using Evaluate =
      std::function<void(const assembly::System&, const model::State&, int, std::vector<double>&)>;

  NodeQuantity(int node, std::vector<HistoryColumn> columns, Evaluate evaluate)
      : node_(node), columns_(std::move(columns)), evaluate_(std::move(evaluate)) {}

  std::vector<HistoryColumn> columns() const override { return columns_; }
  void evaluate(const assembly::System& system, const model::State& state,
                std::vector<double>& numbers) const override {
    evaluate_(system, state, node_, numbers);
  }

 private:
  int node_;
  std::vector<HistoryColumn> columns_;
  Evaluate evaluate_;
};

void append(const Vec3& v, std::vector<double>& numbers) {
  numbers.insert(numbers.end(), v.data(), v.data() + 3);
}

void position(const assembly::System&, const model::State& state, int node,
              std::vector<double>& numbers) {
  append(NodeTable::slots(state.next, node).col(0), numbers);
}

void displacement(const assembly::System& system, const model::State& state, int node,
                  std::vector<double>& numbers) {
  const auto& reference = system.model().nodes().reference();
  append(NodeTable::slots(state.next, node).col(0) - NodeTable::slots(reference, node).col(0),
         numbers);
}

void rotation(const assembly::System& system, const model::State& state, int node,
              std::vector<double>& numbers) {
  const auto& reference = system.model().nodes().reference();
  const Mat3 D = NodeTable::slots(state.next, node).rightCols<3>();
  const Mat3 D0 = NodeTable::slots(reference, node).rightCols<3>();
  append(log_rotation(D * D0.transpose()), numbers);
}

void reaction(const assembly::System& system, const model::State& state, int node,
              std::vector<double>& numbers) {
  const Vec6 r = system.reaction(node, state);
  numbers.insert(numbers.end(), r.data(), r.data() + 6);
}

void add(QuantityRegistry& registry, const std::string& type, const std::string& doc,
         std::vector<HistoryColumn> columns, NodeQuantity::Evaluate evaluate) {
  registry.add(
      type, Schema(type, doc).add(model::node_field("Node", "The node, such as 'structure/last'.")),
      [columns = std::move(columns), evaluate = std::move(evaluate)](
          const Options& options, model::BuildContext& context) -> std::unique_ptr<Quantity> {
        const std::vector<int> nodes = model::select_nodes(options, "Node", context);
        if (nodes.empty()) return nullptr;
        if (nodes.size() > 1) {
          context.issues.add(options.where("Node"), "names " + std::to_string(nodes.size()) +
                                                        " nodes, but one is watched");
          return nullptr;
        }
        return std::make_unique<NodeQuantity>(nodes.front(), columns, evaluate);
      });
}

}  // namespace

void register_node_quantities(QuantityRegistry& registry) {
  add(registry, "Position", "Position of a node.", {{"x", "m"}, {"y", "m"}, {"z", "m"}}, position);
  add(registry, "Displacement", "Displacement of a node from the reference.",
      {{"ux", "m"}, {"uy", "m"}, {"uz", "m"}}, displacement);
  add(registry, "Rotation", "Rotation vector of the directors of a node from the reference.",
      {{"rx", "rad"}, {"ry", "rad"}, {"rz", "rad"}}, rotation);
  add(registry, "Reaction",
      "Force, and moment about the node, by which supports and joints act on the structure there.",
      {{"Fx", "N"}, {"Fy", "N"}, {"Fz", "N"}, {"Mx", "N m"}, {"My", "N m"}, {"Mz", "N m"}},
      reaction);
}

}  // namespace culm::simulation
