#include "taut_beams.hpp"

#include <culm/beam/element_batches.hpp>

#include <Eigen/Eigenvalues>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace culm::simulation {
namespace {

// Of turns at the nodes that are the Legendre polynomial whose roots are the points of quadrature:
// their bending, 1/2 EI int theta'^2, over what tension gains, 1/2 T int sum_a N_a theta_a^2.
constexpr double limits[] = {4.0, 24.0, 64.1};
// A little beyond it an element is held by its neighbours.
constexpr double alone = 1.2;

struct Taut {
  std::size_t cell = 0;
  int order = 0;
  double tension = 0.0;  // [N]
  double limit = 0.0;    // [N]

  double excess() const { return tension / limit; }
};

template <int Order>
std::optional<Taut> taut(const model::Cell& cell, double length, const model::Coordinates& q) {
  using Batch = model::ElementBatch<beam::DirectorBeam<Order>>;
  const auto* batch = dynamic_cast<const Batch*>(cell.source);
  if (batch == nullptr) return {};
  Eigen::Matrix2d bending = Eigen::Matrix2d::Zero();  // times the length
  for (int p = 0; p < Order; ++p) {
    bending += batch->element(cell.item).stiffness(p).template block<2, 2>(3, 3);
  }
  const double EI =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(bending).eigenvalues()[0] / length;
  std::vector<double> resultants;
  cell.source->resultants(cell.item, q, resultants);
  return Taut{0, Order, resultants[2], limits[Order - 1] * EI / (length * length)};
}

// The tautest element of this rank in a line beyond its limit, if any.
std::optional<Taut> tautest(const model::Structure& structure, const model::Coordinates& q) {
  if (structure.line_points.empty() || structure.cells.empty()) return {};
  const std::size_t per_element = structure.line_points.size() / structure.cells.size();
  std::optional<Taut> worst;
  for (std::size_t i = 0; i < structure.cells.size(); ++i) {
    const model::Cell& cell = structure.cells[i];
    if (cell.source == nullptr || !cell.source->owns(cell.item)) continue;
    double length = 0.0;
    for (std::size_t p = 0; p < per_element; ++p) {
      length += structure.line_points.length(per_element * i + p);
    }
    std::optional<Taut> found = taut<1>(cell, length, q);
    if (!found) found = taut<2>(cell, length, q);
    if (!found) found = taut<3>(cell, length, q);
    if (!found || !(found->tension > alone * found->limit)) continue;
    found->cell = i;
    if (!worst || found->excess() > worst->excess()) worst = found;
  }
  return worst;
}

// That of all ranks, on all of them; the first of several that are equal.
std::optional<Taut> tautest(const parallel::Comm& comm, const std::optional<Taut>& here) {
  const double most = comm.max(here ? here->excess() : 0.0);
  if (most == 0.0) return {};
  const int none = std::numeric_limits<int>::max();
  const bool is_one = here && here->excess() == most;
  const int cell = -comm.max(is_one ? -static_cast<int>(here->cell) : -none);
  const bool is_it = is_one && static_cast<int>(here->cell) == cell;
  double numbers[3] = {};
  if (is_it) {
    numbers[0] = here->order;
    numbers[1] = here->tension;
    numbers[2] = here->limit;
  }
  comm.max(numbers);
  return Taut{static_cast<std::size_t>(cell), static_cast<int>(numbers[0]), numbers[1], numbers[2]};
}

// The number that the deck has for a cell.
std::size_t number_of(std::size_t cell, const model::Structure& structure) {
  const auto& all = structure.deck.cells;
  for (std::size_t number = 0; number < all.size(); ++number) {
    if (std::ranges::find(all[number], static_cast<int>(cell)) != all[number].end()) return number;
  }
  return cell;
}

}  // namespace

std::vector<std::string> taut_beams(const assembly::System& system, const model::Coordinates& q) {
  std::vector<std::string> sentences;
  for (const model::Structure& structure : system.model().structures()) {
    const std::optional<Taut> worst = tautest(system.comm(), tautest(structure, q));
    if (!worst) continue;
    sentences.push_back(fmt::format(
        "element {} of '{}', of order {}, carries a tension of {:.3g} N, but as long as it is its "
        "bending stiffness keeps its nodes from turning to and fro up to {:.3g} N only: kinks may "
        "grow in it; take {:.2g} times as many 'Elements', or more bending stiffness",
        number_of(worst->cell, structure), structure.name, worst->order, worst->tension,
        worst->limit, std::ceil(10.0 * std::sqrt(worst->tension / worst->limit)) / 10.0));
  }
  return sentences;
}

}  // namespace culm::simulation
