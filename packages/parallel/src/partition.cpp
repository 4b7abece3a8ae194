#include <culm/base/error.hpp>
#include <culm/parallel/partition.hpp>

#include <metis.h>

#include <numeric>

namespace culm::parallel {
namespace {

// The cut of a surface between two ranks is an eighth to a quarter shorter if METIS tries several
// times; those of chains and trees are as short as they can be.
int tries(const Graph& graph) {
  constexpr int neighbours_on_surfaces = 8;
  const bool is_surface =
      graph.neighbours.size() > static_cast<std::size_t>(graph.size()) * neighbours_on_surfaces / 2;
  return is_surface ? 8 : 1;
}

// Numbers parts as the first vertices of each are: those of a chain follow each other then, and
// who numbers rows by vertices has them in one piece on each rank.
void number_by_first(std::vector<int>& owner, int parts) {
  std::vector<int> number(static_cast<std::size_t>(parts), -1);
  int next = 0;
  for (int& part : owner) {
    int& mine = number[static_cast<std::size_t>(part)];
    if (mine < 0) mine = next++;
    part = mine;
  }
}

}  // namespace

std::vector<int> partition(const Graph& graph, int ranks) {
  std::vector<int> owner(static_cast<std::size_t>(graph.size()), 0);
  if (ranks == 1) return owner;
  if (graph.size() <= ranks) {  // METIS wants a vertex for each part
    std::iota(owner.begin(), owner.end(), 0);
    return owner;
  }
  static_assert(sizeof(idx_t) == sizeof(int), "METIS with 32-bit indices");
  idx_t vertices = graph.size();
  idx_t balance = 1;
  idx_t parts = ranks;
  idx_t cut = 0;
  idx_t options[METIS_NOPTIONS];
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_SEED] = 1;
  options[METIS_OPTION_NCUTS] = tries(graph);
  // METIS takes its input as non-const but does not change it
  auto* begin = const_cast<idx_t*>(graph.begin.data());
  auto* neighbours = const_cast<idx_t*>(graph.neighbours.data());
  auto* weights = const_cast<idx_t*>(graph.weights.data());
  const int status =
      METIS_PartGraphRecursive(&vertices, &balance, begin, neighbours, weights, nullptr, nullptr,
                               &parts, nullptr, nullptr, options, &cut, owner.data());
  internal_check(status == METIS_OK, "METIS could not partition the graph");
  number_by_first(owner, ranks);
  return owner;
}

std::vector<int> dissect(const Graph& graph) {
  std::vector<int> place(static_cast<std::size_t>(graph.size()));
  std::iota(place.begin(), place.end(), 0);
  if (graph.neighbours.empty()) return place;  // any order does, and METIS wants an edge
  idx_t vertices = graph.size();
  idx_t options[METIS_NOPTIONS];
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_SEED] = 1;
  options[METIS_OPTION_NSEPS] = 2;  // one alone may cost a fifth more operations by bad luck
  auto* begin = const_cast<idx_t*>(graph.begin.data());
  auto* neighbours = const_cast<idx_t*>(graph.neighbours.data());
  auto* weights = const_cast<idx_t*>(graph.weights.data());
  std::vector<idx_t> order(place.size());
  const int status =
      METIS_NodeND(&vertices, begin, neighbours, weights, options, order.data(), place.data());
  internal_check(status == METIS_OK, "METIS could not order the graph");
  return place;
}

}  // namespace culm::parallel
