#include <culm/base/nearest.hpp>
#include <culm/model/build_context.hpp>
#include <culm/model/find_point.hpp>

#include <algorithm>
#include <charconv>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace culm::model {
namespace {

// Where a number is too large, or several names are given, the nearest name would not help.
std::string unknown_node(const std::string& name, const Model& model) {
  if (name.starts_with('{')) {
    return "must be one name, got '" + name + "'; an entry of 'Node Sets' joins several";
  }
  const auto slash = name.find('/');
  const Structure* structure = model.find_structure(name.substr(0, slash));
  const std::string rest = slash == std::string::npos ? "" : name.substr(slash + 1);
  const bool number = !rest.empty() && rest.find_first_not_of("0123456789") == std::string::npos;
  if (structure != nullptr && number) {
    return "no node '" + name + "': '" + structure->name + "' has " +
           std::to_string(structure->numbered_nodes().size()) + " nodes, numbered from 0";
  }
  return "unknown node '" + name + "'" + did_you_mean(name, model.selectable_names());
}

// Nodes of walls that meet at a fold, each with those that it is joined to at its place.
std::map<int, std::vector<int>> nodes_at_folds(const Model& model) {
  std::map<int, std::vector<int>> joined;
  for (const Constraint& c : model.constraints()) {
    const bool is_fold =
        c.is_structural && c.nodes.size() == 2 && std::ranges::all_of(c.nodes, [&](int node) {
          return model.nodes().kind(node) == NodeKind::node6;
        });
    if (!is_fold) continue;
    joined[c.nodes[0]].push_back(c.nodes[1]);
    joined[c.nodes[1]].push_back(c.nodes[0]);
  }
  return joined;
}

// Of the nodes of a list at one place of a fold the first remains.
void keep_one_at_folds(const Model& model, std::vector<int>& nodes) {
  if (nodes.size() < 2) return;
  auto joined = nodes_at_folds(model);
  std::set<int> taken;  // all nodes at the places of those that remain
  std::erase_if(nodes, [&](int node) {
    if (taken.contains(node)) return true;
    std::vector<int> place{node};
    while (!place.empty()) {
      const int next = place.back();
      place.pop_back();
      const auto found = joined.find(next);
      if (found == joined.end() || !taken.insert(next).second) continue;
      place.insert(place.end(), found->second.begin(), found->second.end());
    }
    return false;
  });
}

}  // namespace

Field node_field(std::string name, std::string doc) {
  return text(std::move(name), std::move(doc));
}

std::vector<int> select_nodes(const Options& options, const std::string& parameter,
                              BuildContext& context) {
  return find_nodes(options.text(parameter), options.where(parameter), context);
}

std::vector<int> select_loaded_nodes(const Options& options, const std::string& parameter,
                                     BuildContext& context) {
  std::vector<int> nodes = select_nodes(options, parameter, context);
  const auto& structures = context.model.structures();
  const bool is_refined = std::any_of(structures.begin(), structures.end(),
                                      [](const Structure& s) { return !s.deck.nodes.empty(); });
  std::erase_if(nodes, [&](int node) {
    const Structure* structure = is_refined ? context.model.structure_of(node) : nullptr;
    if (structure == nullptr) return false;
    const std::vector<int>& numbered = structure->numbered_nodes();
    return std::find(numbered.begin(), numbered.end(), node) == numbered.end();
  });
  keep_one_at_folds(context.model, nodes);
  return nodes;
}

std::vector<int> find_nodes(const std::string& name, const Where& where, BuildContext& context) {
  std::vector<int> nodes = context.model.select_nodes(name);
  if (nodes.empty()) context.issues.add(where, unknown_node(name, context.model));
  return nodes;
}

Field point_field(std::string name, std::string doc) {
  return text(std::move(name), std::move(doc) +
                                   " A node, or a point of a line at a fraction of its length, as "
                                   "'beam@0.35'.");
}

std::optional<Marker> select_point(const Options& options, const std::string& parameter,
                                   BuildContext& context) {
  return find_point(options.text(parameter), options.where(parameter), context);
}

std::optional<Marker> find_point(const std::string& name, const Where& where,
                                 BuildContext& context) {
  const auto at = name.find('@');
  if (at == std::string::npos) {
    const std::vector<int> nodes = find_nodes(name, where, context);
    if (nodes.size() == 1) return marker_at(nodes.front());
    if (nodes.size() > 1) {
      context.issues.add(where, "must name one node, got " + std::to_string(nodes.size()));
    }
    return {};
  }
  const Structure* structure = context.model.find_structure(name.substr(0, at));
  double fraction = -1.0;
  const auto [end, error] =
      std::from_chars(name.data() + at + 1, name.data() + name.size(), fraction);
  const bool is_number = error == std::errc() && end == name.data() + name.size();
  std::optional<Marker> marker;
  if (structure == nullptr) {
    std::vector<std::string> names;
    for (const Structure& one : context.model.structures()) names.push_back(one.name);
    context.issues.add(
        where, "unknown structure in '" + name + "'" + did_you_mean(name.substr(0, at), names));
  } else if (!is_number || !(fraction >= 0.0 && fraction <= 1.0)) {
    context.issues.add(where, "needs a fraction between 0 and 1 behind '@', got '" + name + "'");
  } else if (marker = marker_at_fraction(*structure, fraction); !marker) {
    context.issues.add(where, "structure '" + structure->name + "' is no line, got '" + name + "'");
  }
  return marker;
}

Field structure_field() { return text("Structure", "Name of the structure it acts on."); }

const Structure* select_structure(const Options& options, BuildContext& context) {
  const std::string& name = options.text("Structure");
  const Structure* structure = context.model.find_structure(name);
  if (structure == nullptr) {
    std::vector<std::string> names;
    for (const Structure& one : context.model.structures()) names.push_back(one.name);
    context.issues.add(options.where("Structure"),
                       "unknown structure '" + name + "'" + did_you_mean(name, names));
  }
  return structure;
}

Field vector_field(std::string name, std::string unit, std::string doc) {
  return numbers(std::move(name), std::move(unit), std::move(doc)).size(3);
}

Vec3 vector(const Options& options, const std::string& parameter) {
  return Eigen::Map<const Vec3>(options.numbers(parameter).data());
}

Field function_field(std::string fallback, std::string name) {
  return text(
             std::move(name),
             "Function of time, from the list Functions; 'Ramp' is time held between 0 and 1, in a "
             "Path the level; 'Constant' is 1.")
      .optional(std::move(fallback));
}

std::optional<Amplitude> find_function(const Options& options, BuildContext& context,
                                       const std::string& parameter, Follows follows) {
  return find_function(options.text(parameter), options.where(parameter), context, follows);
}

std::optional<Amplitude> find_function(const std::string& name, const Where& where,
                                       BuildContext& context, Follows follows) {
  if (const auto found = context.functions.find(name); found != context.functions.end()) {
    if (found->second.signal() != nullptr) {
      if (follows == Follows::signals) return found->second;
      context.issues.add(where,
                         "'" + name +
                             "' is a signal, which this cannot follow; allowed: functions of "
                             "time");
      return {};
    }
    context.model.add_function(name, found->second);
    return found->second;
  }
  if (name == "Ramp") return Amplitude::ramp();
  if (name == "Constant") return Amplitude::constant();
  std::vector<std::string> names = {"Ramp", "Constant"};
  for (const auto& [known, function] : context.functions) {
    if (function.signal() == nullptr || follows == Follows::signals) names.push_back(known);
  }
  context.issues.add(where, "unknown function '" + name + "'" + did_you_mean(name, names));
  return {};
}

SharedField find_field(const Options& options, BuildContext& context) {
  const std::string& name = options.text("Field");
  if (const auto found = context.fields.find(name); found != context.fields.end()) {
    return found->second;
  }
  std::vector<std::string> names;
  for (const auto& [known, field] : context.fields) names.push_back(known);
  context.issues.add(options.where("Field"),
                     "unknown field '" + name + "'" + did_you_mean(name, names));
  return nullptr;
}

}  // namespace culm::model
