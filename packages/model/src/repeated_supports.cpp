#include "repeated_supports.hpp"

#include <culm/base/text.hpp>

#include <algorithm>
#include <bitset>
#include <map>
#include <utility>

namespace culm::model {
namespace {

constexpr std::size_t most_nodes = 6;  // in a note

// The entry of the deck that a support belongs to: one on many nodes adds theirs to its name.
std::string entry_of(const Model& model, const Constraint& support) {
  const std::string at = " at " + model.node_name(support.nodes.front());
  const bool has_node = support.name.ends_with(at);
  const std::string name = support.name.substr(0, support.name.size() - (has_node ? at.size() : 0));
  return support.type + " '" + name + "'";
}

std::string directions(std::bitset<6> held, bool is_shell) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < 6; ++i) {
    const std::string axis = {"xyz"[i % 3]};
    if (held[i]) names.push_back(i < 3 ? axis : (is_shell ? "director " : "rotation ") + axis);
  }
  return join(names, ", ");
}

std::string nodes_text(const std::vector<std::string>& names) {
  const auto shown = std::min(names.size(), most_nodes);
  const std::string text =
      join({names.begin(), names.begin() + static_cast<std::ptrdiff_t>(shown)}, ", ");
  return shown < names.size() ? text + ", … " + std::to_string(names.size()) + " nodes" : text;
}

void add_once(const std::string& name, std::vector<std::string>& names) {
  if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
}

// What some supports hold together: nodes by the same directions are told in one note.
struct Repetition {
  std::vector<std::string> entries;
  std::string directions;
  bool operator==(const Repetition&) const = default;
};

}  // namespace

std::vector<std::string> notes_on_repeated_supports(
    const Model& model, const std::vector<const Constraint*>& supports) {
  const NodeTable& nodes = model.nodes();
  std::map<int, std::vector<const Constraint*>> by_node;  // whose unknowns they take away
  for (const Constraint* support : supports) {
    by_node[nodes.master(support->fix->node)].push_back(support);
  }
  std::vector<std::pair<Repetition, std::vector<std::string>>> found;  // with the nodes' names
  for (const auto& [node, holders] : by_node) {
    std::bitset<6> once, more;
    for (const Constraint* holder : holders) {
      more |= once & holder->fix->unknowns;
      once |= holder->fix->unknowns;
    }
    if (more.none()) continue;
    Repetition repetition{{}, directions(more, nodes.kind(node) == NodeKind::node6)};
    std::vector<std::string> names;
    for (const Constraint* holder : holders) {
      if ((holder->fix->unknowns & more).none()) continue;
      add_once(entry_of(model, *holder), repetition.entries);
      add_once("'" + model.node_name(holder->fix->node) + "'", names);
    }
    // the same support on a node and on one that follows it is one support
    if (repetition.entries.size() < 2) continue;
    auto same = std::find_if(found.begin(), found.end(),
                             [&](const auto& one) { return one.first == repetition; });
    if (same == found.end()) same = found.insert(found.end(), {repetition, {}});
    same->second.insert(same->second.end(), names.begin(), names.end());
  }
  std::vector<std::string> notes;
  for (const auto& [repetition, names] : found) {
    std::vector<std::string> entries = repetition.entries;
    const std::string last = entries.back();
    entries.pop_back();
    notes.push_back(join(entries, ", ") + " and " + last + " hold motions of " + nodes_text(names) +
                    " more than once: " + repetition.directions +
                    "; the reactions of these constraints are not unique");
  }
  return notes;
}

}  // namespace culm::model
