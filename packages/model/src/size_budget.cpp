#include <culm/base/error.hpp>
#include <culm/model/size_budget.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace culm::model {
namespace {

// Measured on runs of squares and strips of 1000 to 40 000 elements, and of beams [B].
constexpr double shell_element = 13e3;
constexpr double beam_node = 4.7e3;
// of that, what every process has: places, numbers, meshes and what belongs to files
constexpr double shell_element_whole = 3.5e3;
constexpr double beam_node_whole = 0.45e3;
constexpr double beam_node_factors = 1.5e3;
// with twelve unknowns and six multipliers: what comes on top
constexpr double beam_node_multipliers = 9e3;
constexpr double beam_node_multipliers_factors = 5.7e3;
constexpr double shell_element_grids = 7.1e3;  // of the iterative solver
constexpr double layer_array = 1040.0;         // of one layer in one element
constexpr double shell_eigenproblem = 7.5e3;
constexpr double beam_eigenproblem = 1.5e3;
constexpr double mode_of_node = 290.0;

// Nested dissection of a square of n nodes leaves 31/4 n log2 n blocks in L and U together, less a
// multiple of n; a strip is like squares of its width. The constants are those of predict_fill().
// @source A. George, Nested dissection of a regular finite element mesh, 1973
double surface_factors(double elements, double narrow) {
  constexpr double block = 36.0 * sizeof(double);
  if (elements == 0.0) return 0.0;
  const double nodes = (narrow + 1.0) * (elements / narrow + 1.0);
  const double square = std::min(3.3 * (narrow + 1.0) * (narrow + 1.0), nodes);
  return nodes * block * std::max(10.0, 7.75 * std::log2(square) - 40.0);
}

std::string bytes_text(double bytes) {
  if (bytes < 1e9) return fmt::format("{:.3g} MB", bytes / 1e6);
  if (bytes < 1e12) return fmt::format("{:.3g} GB", bytes / 1e9);
  return fmt::format("{:.3g} TB", bytes / 1e12);
}

}  // namespace

MemoryNeed& MemoryNeed::operator+=(const MemoryNeed& other) {
  elements += other.elements;
  factors += other.factors;
  layers += other.layers;
  modes += other.modes;
  return *this;
}

std::string MemoryNeed::text() const {
  std::string parts;
  for (const auto& [name, bytes] : {std::pair{"elements", elements}, std::pair{"factors", factors},
                                    std::pair{"layers", layers}, std::pair{"modes", modes}}) {
    if (bytes == 0.0) continue;
    parts += fmt::format("{}{} {}", parts.empty() ? "" : ", ", name, bytes_text(bytes));
  }
  return fmt::format("{} ({})", bytes_text(total()), parts.empty() ? "nothing" : parts);
}

// On a machine, of what each process has whole and what all have in parts.
double SizeBudget::on_machine(double whole, double parts) const {
  return demands_.processes.here * (whole + parts / demands_.processes.all);
}

void SizeBudget::take_beam(double elements, double nodes, const Where& where) {
  MemoryNeed need{nodes * on_machine(beam_node_whole, beam_node - beam_node_whole),
                  nodes * on_machine(0.0, beam_node_factors)};
  if (demands_.has_multipliers) {
    need.elements += nodes * on_machine(0.0, beam_node_multipliers);
    need.factors += nodes * on_machine(0.0, beam_node_multipliers_factors);
  }
  if (demands_.modes > 0) {
    need.modes = nodes * on_machine(mode_of_node * demands_.modes, beam_eigenproblem);
  }
  take(elements, need, where);
}

void SizeBudget::take_shell(double elements, double layers, double narrow, const Where& where) {
  double factors = surface_factors(elements, narrow);
  if (demands_.may_iterate) factors = std::min(factors, elements * shell_element_grids);
  MemoryNeed need{elements * on_machine(shell_element_whole, shell_element - shell_element_whole),
                  on_machine(0.0, factors)};
  const double shown = std::min(layers, demands_.shown_layers);
  need.layers = elements * shown * demands_.layer_arrays * layer_array;
  if (demands_.modes > 0) {
    need.modes = elements * on_machine(mode_of_node * demands_.modes, shell_eigenproblem);
  }
  take(elements, need, where);
}

void SizeBudget::take(double elements, const MemoryNeed& need, const Where& where) {
  taken_ += need;
  refuse_above(allowed_, taken_,
               fmt::format("asks for {:.0f} elements, with which the model", elements), where);
}

void refuse_above(double allowed, const MemoryNeed& need, const std::string& what,
                  const Where& where) {
  if (need.total() <= allowed) return;
  throw InputError(
      where, fmt::format("{} needs about {} of memory and {} are allowed: take fewer elements, or "
                         "allow more with --max-memory",
                         what, need.text(), bytes_text(allowed)));
}

}  // namespace culm::model
