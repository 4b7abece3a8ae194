#include <culm/math/vector_units.hpp>
#include <culm/mechanics/mass_pack.hpp>
#include <culm/mechanics/pack_geometry.hpp>

namespace culm {
namespace {

constexpr int entry(int s, int t) { return s <= t ? s * (7 - s) / 2 + t : entry(t, s); }

}  // namespace

void set_mass(const SlotMatrix<4>& mass, int lane, MassPack& masses) {
  for (int s = 0; s < 4; ++s) {
    for (int t = s; t < 4; ++t) masses.of(lane, entry(s, t)) = mass(s, t);
  }
}

CULM_FOR_EACH_VECTOR_UNIT void evaluate_masses(const MassPack& masses, const PackMotion<1>& motion,
                                               const Stencil& stencil, bool with_tangent,
                                               PackSum<1>& sum) {
  const double theta = stencil.theta;
  Pack mid[12], acceleration[12], force[12] = {}, A[16];
  for (std::size_t c = 0; c < 12; ++c) {
    mid[c] = (1.0 - theta) * motion.prev[c] + theta * motion.next[c];
    acceleration[c] =
        motion.acceleration_offset[c] + stencil.inertia * (motion.next[c] - motion.prev[c]);
  }
  for (int s = 0; s < 4; ++s) {
    for (int t = 0; t < 4; ++t) {
      const Pack& m = masses.numbers[entry(s, t)];
      for (int c = 0; c < 3; ++c) force[3 * s + c] += m * acceleration[3 * t + c];
      A[4 * s + t] = stencil.inertia * m;
    }
  }
  constexpr Pack one = {1, 1, 1, 1, 1, 1, 1, 1};
  for (std::size_t c = 0; c < 3; ++c) {
    sum.residual[c] = sum.pull[c] = force[c];
    sum.residual[3 + c] = Pack{};
  }
  for (int d = 3; d < 12; d += 3) add_cross(mid + d, force + d, one, sum.residual.data() + 3);
  if (!with_tangent) return;
  sum.tangent = Packs<36>{};
  add_pack_geometry<1>(A, force, mid, motion.next.data(), theta, sum.tangent.data());
}

}  // namespace culm
