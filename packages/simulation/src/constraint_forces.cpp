#include "constraint_forces.hpp"

#include <algorithm>
#include <string>
#include <utility>

namespace culm::simulation {
namespace {

// Constraints of one name act together.
struct Group {
  std::string name;
  std::vector<int> nodes;
  std::vector<int> fixed;  // by supports that take unknowns away
};

void insert_new(const std::vector<int>& nodes, std::vector<int>& into) {
  for (const int node : nodes) {
    if (std::find(into.begin(), into.end(), node) == into.end()) into.push_back(node);
  }
}

std::vector<Group> groups_of(const model::Model& model) {
  std::vector<Group> groups;
  for (const model::Constraint& c : model.constraints()) {
    if (c.is_structural || c.link) continue;
    auto at = std::find_if(groups.begin(), groups.end(),
                           [&](const Group& group) { return group.name == c.name; });
    if (at == groups.end()) at = groups.insert(at, Group{c.name, {}, {}});
    insert_new(c.nodes, at->nodes);
    if (c.fix && !model.nodes().is_slave(c.fix->node)) insert_new({c.fix->node}, at->fixed);
  }
  return groups;
}

// What the unknowns that were taken away would carry, with the equations of the group.
Vec6 force_on(const Group& group, int node, const assembly::System& system,
              const model::State& state) {
  Vec6 force = system.reaction_of(group.name, node, state);
  if (std::find(group.fixed.begin(), group.fixed.end(), node) != group.fixed.end()) {
    force += system.reaction(node, state) - system.reaction_of("", node, state);
  }
  return force;
}

}  // namespace

std::vector<output::NamedArray> constraint_forces(const assembly::System& system,
                                                  const model::State& state) {
  std::vector<output::NamedArray> arrays;
  for (const Group& group : groups_of(system.model())) {
    output::NamedArray array{"constraint forces: " + group.name, 9, {}};
    for (const int node : group.nodes) {
      const Vec3 place = model::NodeTable::slots(state.next, node).col(0);
      const Vec6 force = force_on(group, node, system, state);
      array.values.insert(array.values.end(), place.begin(), place.end());
      array.values.insert(array.values.end(), force.begin(), force.end());
    }
    arrays.push_back(std::move(array));
  }
  return arrays;
}

}  // namespace culm::simulation
