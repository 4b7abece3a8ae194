#include <culm/model/one_director.hpp>

namespace culm::model {

void check_components(const Vec3& vector, const Where& where, std::span<const int> nodes,
                      BuildContext& context) {
  if (vector.tail<2>().isZero(0.0)) return;
  for (int node : nodes) {
    if (context.model.nodes().kind(node) != NodeKind::node6) continue;
    context.issues.add(where, "node '" + context.model.node_name(node) +
                                  "' of a shell has one director: only the first component may "
                                  "differ from zero");
    return;
  }
}

void check_components(const std::string& parameter, std::span<const int> nodes,
                      const Options& options, BuildContext& context) {
  check_components(vector(options, parameter), options.where(parameter), nodes, context);
}

}  // namespace culm::model
