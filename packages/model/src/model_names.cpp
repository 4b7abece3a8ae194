// What the names of a deck mean in a model.
#include <culm/model/model.hpp>

#include <algorithm>
#include <charconv>

namespace culm::model {

const Structure* Model::find_structure(std::string_view name) const {
  const auto found = structure_by_name_.find(name);
  return found == structure_by_name_.end() ? nullptr : found->second;
}

void Model::add_element_set(std::string name, const Structure& structure,
                            const std::vector<int>& elements) {
  std::vector<LinePoint>& points = element_sets_[std::move(name)];
  if (structure.line_points.empty()) return;
  // all elements of a structure are of one kind, hence have as many points
  const std::size_t per_element = structure.line_points.size() / structure.cells.size();
  for (int element : elements) {
    for (int cell : structure.cells_of(element)) {
      const auto some =
          structure.line_points.copy(per_element * static_cast<std::size_t>(cell), per_element);
      points.insert(points.end(), some.begin(), some.end());
    }
  }
}

std::vector<LinePoint> Model::line_points(std::string_view name) const {
  if (const auto set = element_sets_.find(std::string(name)); set != element_sets_.end()) {
    return set->second;
  }
  const auto slash = name.find('/');
  const Structure* structure = find_structure(name.substr(0, slash));
  if (structure == nullptr) return {};
  if (slash == std::string_view::npos) return structure->line_points.copy();
  const auto edge = structure->edges.find(std::string(name.substr(slash + 1)));
  return edge == structure->edges.end() ? std::vector<LinePoint>{} : edge->second;
}

std::vector<Face> Model::faces(std::string_view name) const {
  const auto slash = name.find('/');
  const Structure* structure = find_structure(name.substr(0, slash));
  if (structure == nullptr) return {};
  if (slash == std::string_view::npos) return structure->faces;
  const auto part = structure->parts.find(std::string(name.substr(slash + 1)));
  std::vector<Face> faces;
  if (part == structure->parts.end()) return faces;
  for (int cell : part->second) faces.push_back(structure->faces[static_cast<std::size_t>(cell)]);
  return faces;
}

std::vector<int> Model::select_nodes(std::string_view name) const {
  if (const auto set = node_sets_.find(std::string(name)); set != node_sets_.end()) {
    return set->second;
  }
  const auto slash = name.find('/');
  const Structure* structure = find_structure(name.substr(0, slash));
  if (structure == nullptr) return {};
  if (slash == std::string_view::npos) return structure->nodes;
  const std::string_view rest = name.substr(slash + 1);
  if (const auto set = structure->sets.find(std::string(rest)); set != structure->sets.end()) {
    return set->second;
  }
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), number);
  if (error != std::errc() || end != rest.data() + rest.size()) return {};
  const std::vector<int>& numbered = structure->numbered_nodes();
  if (number >= numbered.size()) return {};
  return {numbered[number]};
}

std::vector<std::string> Model::selectable_names() const {
  std::vector<std::string> names;
  for (const auto& [set, nodes] : node_sets_) names.push_back(set);
  for (const Structure& structure : structures_) {
    names.push_back(structure.name);
    for (const auto& [set, nodes] : structure.sets) names.push_back(structure.name + "/" + set);
  }
  return names;
}

std::string Model::node_name(int node) const {
  for (const Structure& structure : structures_) {
    const auto& numbered = structure.numbered_nodes();
    const auto named = std::find(numbered.begin(), numbered.end(), node);
    if (named != numbered.end()) {
      return structure.name + "/" + std::to_string(named - numbered.begin());
    }
    const auto at = std::find(structure.nodes.begin(), structure.nodes.end(), node);
    if (at != structure.nodes.end()) {
      return structure.name + ", node " + std::to_string(at - structure.nodes.begin()) +
             " of the refined mesh";
    }
  }
  return "node " + std::to_string(node);
}

const Structure* Model::structure_of(int node) const {
  for (const Structure& structure : structures_) {
    if (std::find(structure.nodes.begin(), structure.nodes.end(), node) != structure.nodes.end()) {
      return &structure;
    }
  }
  return nullptr;
}

}  // namespace culm::model
