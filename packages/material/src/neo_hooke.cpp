#include <culm/material/isotropic.hpp>
#include <culm/material/neo_hooke.hpp>

#include <Eigen/LU>

#include <cmath>
#include <limits>

namespace culm::material {

namespace {

// Row and column of the tensor component behind each Voigt index.
constexpr int first_index[] = {0, 1, 2, 1, 0, 0};
constexpr int second_index[] = {0, 1, 2, 2, 2, 1};

Mat3 tensor(const Vec6& E) {
  Mat3 T;
  T << E[0], 0.5 * E[5], 0.5 * E[4], 0.5 * E[5], E[1], 0.5 * E[3], 0.5 * E[4], 0.5 * E[3], E[2];
  return T;
}

// Principal invariants of E
struct Invariants {
  double I1, I2, I3;
  explicit Invariants(const Mat3& E)
      : I1(E.trace()),
        I2(E(0, 0) * E(1, 1) + E(1, 1) * E(2, 2) + E(2, 2) * E(0, 0) - E(0, 1) * E(0, 1) -
           E(1, 2) * E(1, 2) - E(0, 2) * E(0, 2)),
        I3(E.determinant()) {}
  // det(1 + 2 E) - 1
  double volume_change() const { return 2.0 * I1 + 4.0 * I2 + 8.0 * I3; }
};

// x - ln(1 + x) without cancellation
double minus_log(double x) {
  if (std::abs(x) > 0.01) return x - std::log1p(x);
  double sum = 0.0;
  for (int n = 10; n >= 2; --n) sum = 1.0 / n - x * sum;  // 1/2 - x/3 + x^2/4 - ...
  return x * x * sum;
}

}  // namespace

NeoHooke::NeoHooke(double lambda, double mu) : lambda_(lambda), mu_(mu) {
  small_ = lame_stiffness(lambda, mu);
}

NeoHooke NeoHooke::from_moduli(double E, double nu) {
  const double mu = E / (2.0 * (1.0 + nu));
  return {2.0 * mu * nu / (1.0 - 2.0 * nu), mu};
}

Schema NeoHooke::schema() {
  return isotropic_constants_schema(
      "Neo-Hooke",
      "Compressible Neo-Hooke solid for large strains; E and nu are those at small strains.");
}

Material NeoHooke::make(const Options& options) {
  return make_material(
      from_moduli(options.number("Young Modulus"), options.number("Poisson Ratio")), options);
}

// tr C - 3 - 2 ln J = (-4 I2 - 8 I3) + (x - ln(1 + x)),  2 ln J = ln(1 + x)
double NeoHooke::energy(const Vec6& strain) const noexcept {
  const Invariants invariants(tensor(strain));
  const double x = invariants.volume_change();
  if (!(x > -1.0)) return std::numeric_limits<double>::quiet_NaN();
  const double ln_J = 0.5 * std::log1p(x);
  return 0.5 * mu_ * (-4.0 * invariants.I2 - 8.0 * invariants.I3 + minus_log(x)) +
         0.5 * lambda_ * ln_J * ln_J;
}

// S = μ (1 - C^-1) + λ ln J C^-1, where 1 - C^-1 = 2 C^-1 E
// ∂S/∂E = λ C^-1 (x) C^-1 + (μ - λ ln J) (Ci_ik Ci_jl + Ci_il Ci_jk)
Verdict NeoHooke::respond(const Vec6& strain, Vec6& S, Mat6& tangent) const noexcept {
  const Mat3 E = tensor(strain);
  const double x = Invariants(E).volume_change();
  if (!(x > -1.0)) {
    S.setZero();
    tangent.setZero();
    return Verdict::law_out_of_range;
  }
  const double ln_J = 0.5 * std::log1p(x);
  const Mat3 Ci = (Mat3::Identity() + 2.0 * E).inverse();
  const Mat3 stress = 2.0 * mu_ * Ci * E + lambda_ * ln_J * Ci;
  const double shear = mu_ - lambda_ * ln_J;
  for (int I = 0; I < 6; ++I) {
    const int i = first_index[I];
    const int j = second_index[I];
    S[I] = 0.5 * (stress(i, j) + stress(j, i));
    for (int K = 0; K < 6; ++K) {
      const int k = first_index[K];
      const int l = second_index[K];
      tangent(I, K) =
          lambda_ * Ci(i, j) * Ci(k, l) + shear * (Ci(i, k) * Ci(j, l) + Ci(i, l) * Ci(j, k));
    }
  }
  return Verdict::ok;
}

}  // namespace culm::material
