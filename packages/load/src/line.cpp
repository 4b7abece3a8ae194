#include "line.hpp"

namespace culm::load {

Field line_field() {
  return text("Structure", "Name of the structure, or of the element set, that it acts on.");
}

std::vector<model::LinePoint> line_points(const Options& options, model::BuildContext& context) {
  const std::string& name = options.text("Structure");
  std::vector<model::LinePoint> points = context.model.line_points(name);
  // select_structure reports a name that is neither a set nor a structure
  if (points.empty() && model::select_structure(options, context) != nullptr) {
    context.issues.add(options.where("Structure"), "structure '" + name +
                                                       "' is not a line: it has no length to "
                                                       "load");
  }
  return points;
}

}  // namespace culm::load
