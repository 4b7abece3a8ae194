#include <culm/math/rotation.hpp>
#include <culm/math/rotation_series.hpp>
#include <culm/math/vector_units.hpp>
#include <culm/mechanics/triad_pack.hpp>

namespace culm {
namespace {

// Coordinates of the directors among those of the slots.
constexpr std::size_t directors = 3;

Mat3 triad_of(const Packs<12>& slots, int lane) {
  Mat3 D;
  for (int c = 0; c < 9; ++c) D.data()[c] = slots.of(lane, static_cast<int>(directors) + c);
  return D;
}

}  // namespace

CULM_FOR_EACH_VECTOR_UNIT void move_triads(const Packs<6>& u, Packs<12>& slots) {
  for (std::size_t c = 0; c < 3; ++c) slots[c] += u[c];
  const Pack x = u[3], y = u[4], z = u[5];
  const Pack t2 = x * x + y * y + z * z;
  Pack a, b;
  find_polynomial(sine_series, t2, a);
  find_polynomial(cosine_series, t2, b);
  for (int l = 0; l < pack_lanes; ++l) {
    if (t2[l] < small_turn_squared) continue;
    const RotationFactors factors = rotation_factors(t2[l]);
    a[l] = factors.sine;
    b[l] = factors.cosine;
  }
  // by columns, as exp_rotation
  const Pack c = 1.0 - b * t2;
  const Pack xy = b * x * y, yz = b * y * z, zx = b * z * x;
  const Pack R[9] = {c + b * x * x, xy + a * z,    zx - a * y,  //
                     xy - a * z,    c + b * y * y, yz + a * x,  //
                     zx + a * y,    yz - a * x,    c + b * z * z};
  Pack D[9];
  for (std::size_t i = 0; i < 3; ++i) {
    const Pack* d = slots.data() + directors + 3 * i;
    for (std::size_t r = 0; r < 3; ++r)
      D[3 * i + r] = R[r] * d[0] + R[3 + r] * d[1] + R[6 + r] * d[2];
  }
  // D (3 - D^T D) / 2
  Pack S[9];
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      const Pack* p = D + 3 * i;
      const Pack* q = D + 3 * j;
      S[3 * i + j] = S[3 * j + i] = -0.5 * (p[0] * q[0] + p[1] * q[1] + p[2] * q[2]);
    }
    S[4 * i] += 1.5;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t r = 0; r < 3; ++r) {
      slots[directors + 3 * i + r] =
          D[r] * S[3 * i] + D[3 + r] * S[3 * i + 1] + D[6 + r] * S[3 * i + 2];
    }
  }
}

CULM_FOR_EACH_VECTOR_UNIT void find_motions(const Packs<12>& from, const Packs<12>& to,
                                            Packs<6>& u) {
  for (std::size_t c = 0; c < 3; ++c) u[c] = to[c] - from[c];
  Pack R[9];  // to from^T, by rows
  for (std::size_t r = 0; r < 3; ++r) {
    for (std::size_t c = 0; c < 3; ++c) {
      Pack& sum = R[3 * r + c] = to[directors + r] * from[directors + c];
      for (std::size_t d = directors + 3; d < 12; d += 3) sum += to[d + r] * from[d + c];
    }
  }
  const Pack twice[3] = {R[7] - R[5], R[2] - R[6], R[3] - R[1]};
  const Pack s2 = 0.25 * (twice[0] * twice[0] + twice[1] * twice[1] + twice[2] * twice[2]);
  const Pack trace = R[0] + R[4] + R[8];
  Pack factor;
  find_polynomial(arcsine_series, s2, factor);
  for (std::size_t c = 0; c < 3; ++c) u[3 + c] = 0.5 * factor * twice[c];
  for (int l = 0; l < pack_lanes; ++l) {
    if (s2[l] < small_turn_squared && trace[l] > 1.0) continue;
    const Vec3 theta = log_rotation(triad_of(to, l) * triad_of(from, l).transpose());
    for (int c = 0; c < 3; ++c) u.of(l, 3 + c) = theta[c];
  }
}

CULM_FOR_EACH_VECTOR_UNIT void find_rates(const Packs<12>& slots, const Packs<12>& velocities,
                                          Packs<6>& rates) {
  for (std::size_t c = 0; c < 3; ++c) {
    rates[c] = velocities[c];
    rates[3 + c] = Pack{};
  }
  for (std::size_t at = directors; at < 12; at += 3) {
    const Pack* d = slots.data() + at;
    const Pack* w = velocities.data() + at;
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t i = (c + 1) % 3, j = (c + 2) % 3;
      rates[3 + c] += 0.5 * (d[i] * w[j] - d[j] * w[i]);
    }
  }
}

}  // namespace culm
