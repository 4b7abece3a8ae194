#include "line.hpp"

namespace culm::load {

const model::Structure* select_line(const Options& options, model::BuildContext& context) {
  const model::Structure* structure = model::select_structure(options, context);
  if (structure != nullptr && structure->line_points.empty()) {
    context.issues.add(options.where("Structure"), "structure '" + structure->name +
                                                       "' is not a line: it has no length to "
                                                       "load");
    return nullptr;
  }
  return structure;
}

}  // namespace culm::load
