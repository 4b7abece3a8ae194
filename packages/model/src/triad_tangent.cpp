#include <culm/math/vector_units.hpp>
#include <culm/model/triad_tangent.hpp>

namespace culm::model {
namespace {

// [a]: where it is added in a block of rows of this length
[[gnu::always_inline]] inline void add_skew(double x, double y, double z, double* block, int row) {
  block[1] -= z;
  block[2] += y;
  block[row] += z;
  block[row + 2] -= x;
  block[2 * row] -= y;
  block[2 * row + 1] += x;
}

}  // namespace

// Columns of a block first: v_s = sum_t A_st arm_t of the column's node, for all slots s at once.
// Then rows: dx by dtheta is -[v_0]; dtheta by dtheta is -sum_s [arm_s][v_s], and
// -[arm][v] = (arm . v) 1 - v arm^T; dtheta by dx is [sum_s A_s0 arm_s], with sums as in v.
template <int N>
CULM_FOR_EACH_VECTOR_UNIT void add_triad_tangent(const SlotMatrix<4 * N>& scalars,
                                                 const Slots<4 * N>& slot_force,
                                                 const std::array<Arms<4>, N>& arms_theta,
                                                 const std::array<Arms<4>, N>& arms_next,
                                                 double theta, RowMat<6 * N, 6 * N>& K) noexcept {
  constexpr int S = 4 * N;
  constexpr int row = 6 * N;
  const double* A = scalars.data();
  for (int b = 0; b < N; ++b) {
    const double* arms = arms_next[static_cast<std::size_t>(b)].slots.data();
    double v[3][S] = {};
    for (int t = 0; t < 4; ++t) {
      for (int c = 0; c < 3; ++c) {
        const double arm = arms[3 * t + c];
        for (int s = 0; s < S; ++s) v[c][s] += arm * A[S * (4 * b + t) + s];
      }
    }
    for (int a = 0; a < N; ++a) {
      const double* own = arms_theta[static_cast<std::size_t>(a)].slots.data();
      double W[9] = {};
      double lever[3] = {};
      for (int s = 0; s < 4; ++s) {
        for (int c = 0; c < 3; ++c) {
          for (int d = 0; d < 3; ++d) W[3 * c + d] += v[c][4 * a + s] * own[3 * s + d];
          lever[c] += A[S * 4 * b + 4 * a + s] * own[3 * s + c];
        }
      }
      if (a == b) {
        // [f][arm] = arm f^T - (arm . f) 1
        const double* f = slot_force.data() + 12 * a;
        for (int s = 0; s < 4; ++s) {
          for (int c = 0; c < 3; ++c) {
            for (int d = 0; d < 3; ++d) W[3 * c + d] -= theta * arms[3 * s + c] * f[3 * s + d];
          }
        }
      }
      double* block = K.data() + 6 * row * a + 6 * b;
      const double scalar = A[S * 4 * b + 4 * a];
      const double trace = W[0] + W[4] + W[8];
      for (int c = 0; c < 3; ++c) {
        block[row * c + c] += scalar;
        block[row * (3 + c) + 3 + c] += trace;
        for (int d = 0; d < 3; ++d) block[row * (3 + c) + 3 + d] -= W[3 * c + d];
      }
      add_skew(-v[0][4 * a], -v[1][4 * a], -v[2][4 * a], block + 3, row);
      add_skew(lever[0], lever[1], lever[2], block + 3 * row, row);
    }
  }
}

template void add_triad_tangent<2>(const SlotMatrix<8>&, const Slots<8>&,
                                   const std::array<Arms<4>, 2>&, const std::array<Arms<4>, 2>&,
                                   double, RowMat<12, 12>&) noexcept;
template void add_triad_tangent<3>(const SlotMatrix<12>&, const Slots<12>&,
                                   const std::array<Arms<4>, 3>&, const std::array<Arms<4>, 3>&,
                                   double, RowMat<18, 18>&) noexcept;
template void add_triad_tangent<4>(const SlotMatrix<16>&, const Slots<16>&,
                                   const std::array<Arms<4>, 4>&, const std::array<Arms<4>, 4>&,
                                   double, RowMat<24, 24>&) noexcept;

}  // namespace culm::model
