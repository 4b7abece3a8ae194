#include <culm/base/nearest.hpp>
#include <culm/model/build_context.hpp>

#include <algorithm>
#include <utility>

namespace culm::model {
namespace {

// Names a number that is too large by itself: the nearest name would not help.
std::string unknown_node(const std::string& name, const Model& model) {
  const auto slash = name.find('/');
  const Structure* structure = model.find_structure(name.substr(0, slash));
  const std::string rest = slash == std::string::npos ? "" : name.substr(slash + 1);
  const bool number = !rest.empty() && rest.find_first_not_of("0123456789") == std::string::npos;
  if (structure != nullptr && number) {
    return "no node '" + name + "': '" + structure->name + "' has " +
           std::to_string(structure->nodes.size()) + " nodes, numbered from 0";
  }
  return "unknown node '" + name + "'" + did_you_mean(name, model.selectable_names());
}

}  // namespace

Field node_field(std::string name, std::string doc) {
  return text(std::move(name), std::move(doc));
}

std::vector<int> select_nodes(const Options& options, const std::string& parameter,
                              BuildContext& context) {
  return find_nodes(options.text(parameter), options.where(parameter), context);
}

std::vector<int> find_nodes(const std::string& name, const Where& where, BuildContext& context) {
  std::vector<int> nodes = context.model.select_nodes(name);
  if (nodes.empty()) context.issues.add(where, unknown_node(name, context.model));
  return nodes;
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

Field function_field(std::string fallback) {
  return text("Function",
              "Function of time, from the list Functions; 'Ramp' is time held between 0 and 1, "
              "'Constant' is 1.")
      .optional(std::move(fallback));
}

std::optional<Amplitude> find_function(const Options& options, BuildContext& context) {
  const std::string& name = options.text("Function");
  if (const auto found = context.functions.find(name); found != context.functions.end()) {
    return found->second;
  }
  if (name == "Ramp") return Amplitude::ramp();
  if (name == "Constant") return Amplitude::constant();
  std::vector<std::string> names = {"Ramp", "Constant"};
  for (const auto& [known, function] : context.functions) names.push_back(known);
  context.issues.add(options.where("Function"),
                     "unknown function '" + name + "'" + did_you_mean(name, names));
  return {};
}

}  // namespace culm::model
