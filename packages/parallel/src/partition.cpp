#include <culm/base/error.hpp>
#include <culm/parallel/partition.hpp>

#include <metis.h>

#include <algorithm>

namespace culm::parallel {

std::vector<int> partition(const Graph& graph, int ranks) {
  std::vector<int> owner(static_cast<std::size_t>(graph.size()), 0);
  if (ranks == 1 || graph.size() == 0) return owner;
  static_assert(sizeof(idx_t) == sizeof(int), "METIS with 32-bit indices");
  idx_t vertices = graph.size();
  idx_t balance = 1;
  idx_t parts = ranks;
  idx_t cut = 0;
  idx_t options[METIS_NOPTIONS];
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_SEED] = 1;
  // METIS takes its input as non-const but does not change it
  auto* begin = const_cast<idx_t*>(graph.begin.data());
  auto* neighbours = const_cast<idx_t*>(graph.neighbours.data());
  auto* weights = const_cast<idx_t*>(graph.weights.data());
  const int status =
      METIS_PartGraphRecursive(&vertices, &balance, begin, neighbours, weights, nullptr, nullptr,
                               &parts, nullptr, nullptr, options, &cut, owner.data());
  internal_check(status == METIS_OK, "METIS could not partition the graph");
  return owner;
}

}  // namespace culm::parallel
