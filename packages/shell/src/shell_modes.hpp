/// From the modes of a bilinear shell to the slots of its nodes.
#pragma once

#include <culm/shell/shell_forms.hpp>

#include <array>

namespace culm::shell {

/// Shares of modes in slots.
using ModesOfSlots = std::array<std::array<double, ShellForms::num_modes>, 8>;

constexpr ModesOfSlots modes_of_slots() {
  constexpr double xi[] = {-1.0, 1.0, 1.0, -1.0};
  constexpr double eta[] = {-1.0, -1.0, 1.0, 1.0};
  ModesOfSlots H{};
  for (std::size_t a = 0; a < 4; ++a) {
    H[2 * a] = {0.25 * xi[a], 0.25 * eta[a], 0.25 * xi[a] * eta[a], 0.0, 0.0, 0.0, 0.0};
    H[2 * a + 1] = {0.0, 0.0, 0.0, 0.25, 0.25 * xi[a], 0.25 * eta[a], 0.25 * xi[a] * eta[a]};
  }
  return H;
}

inline constexpr ModesOfSlots modes_by_slots = modes_of_slots();

/// ∂p_m/∂q_s: the share of slot (x or d, node) in a mode.
constexpr double share(int slot, int mode) {
  return modes_by_slots[static_cast<std::size_t>(slot)][static_cast<std::size_t>(mode)];
}

/// Rows of modes (three each), shape (21, n), to rows of slots, (24, n), by sums and differences:
/// the matrix of shares without its products.
template <class Modes, class Nodes>
void spread(const Modes& modes, Nodes&& slots) noexcept {
  const auto mode = [&](int m, int c) { return modes.row(3 * m + c); };
  for (int c = 0; c < 3; ++c) {
    const auto slot = [&](int node, int s) { return slots.row(6 * node + 3 * s + c); };
    slot(2, 0) = 0.25 * (mode(0, c) + mode(1, c));
    slot(1, 0) = 0.25 * (mode(0, c) - mode(1, c));
    slot(0, 0) = 0.25 * mode(2, c) - slot(2, 0);
    slot(3, 0) = -0.25 * mode(2, c) - slot(1, 0);
    slot(2, 0) += 0.25 * mode(2, c);
    slot(1, 0) -= 0.25 * mode(2, c);

    // with ± for the even (1, ξη) and the odd (ξ, η) part at nodes 2, 0 and 1, 3
    const auto even = 0.25 * (mode(3, c) + mode(6, c));
    const auto odd = 0.25 * (mode(4, c) + mode(5, c));
    slot(2, 1) = even + odd;
    slot(0, 1) = even - odd;
    const auto even_ = 0.25 * (mode(3, c) - mode(6, c));
    const auto odd_ = 0.25 * (mode(4, c) - mode(5, c));
    slot(1, 1) = even_ + odd_;
    slot(3, 1) = even_ - odd_;
  }
}

}  // namespace culm::shell
