/// Velocities of many nodes held against each other, four nodes at a time.
#pragma once

#include <culm/mechanics/pack.hpp>

#include <array>
#include <cstddef>

namespace culm::analysis {

/// Steps before this one whose mean velocities may be known.
inline constexpr std::size_t max_past = 4;

/// Six numbers of each of some nodes.
struct VelocityRows {
  const double* start = nullptr;               ///< at the start of a step
  const double* mean = nullptr;                ///< of the step
  std::array<const double*, max_past> past{};  ///< of steps before it, the last one first
  std::size_t num_past = 0;
};

/// Share of each step before in a guess.
using GuessWeights = std::array<double, max_past>;

/// The six numbers of four nodes.
using NodeRow = Packs<3>;

/// Largest sizes of the mean less a guess, which is the velocity at the start or the sum of what
/// 1, 2, … steps before have in it.
using GuessErrors = std::array<NodeRow, max_past + 1>;

/// Sums of products of how the velocity changed: from the step before to the start, from there to
/// the mean, and of both.
struct VelocityChanges {
  NodeRow before;
  NodeRow after;
  NodeRow both;
};

/// @param weights  of guesses from 1, 2, … steps
void compare_guesses(const VelocityRows& rows, std::size_t num_nodes,
                     const std::array<GuessWeights, max_past>& weights, GuessErrors& errors);

/// @pre one step before is known
void add_changes(const VelocityRows& rows, std::size_t num_nodes, VelocityChanges& changes);

}  // namespace culm::analysis
