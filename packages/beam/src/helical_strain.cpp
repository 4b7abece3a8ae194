#include <culm/beam/helical_strain.hpp>
#include <culm/math/quadrature.hpp>
#include <culm/math/vector_units.hpp>

#include <Eigen/Geometry>

#include <array>
#include <cmath>
#include <numbers>

namespace culm::beam {

namespace {

// A function of one variable with its first two derivatives.
struct Jet {
  double value;
  double first;
  double second;
};

// sum_n coefficients[n] x^n with derivatives, by Horner's rule. Coefficients fall, so that for
// small x the last terms are less than rounding in all three.
template <std::size_t N>
Jet polynomial(const std::array<double, N>& coefficients, double x) {
  static_assert(N >= 11);
  const double size = std::abs(x);
  const std::size_t terms = size < 1e-4 ? 7 : size < 1e-2 ? 11 : N;
  Jet p{coefficients[terms - 1], 0.0, 0.0};
  for (std::size_t n = terms - 1; n-- > 0;) {
    p.second = p.second * x + p.first;
    p.first = p.first * x + p.value;
    p.value = p.value * x + coefficients[n];
  }
  p.second *= 2.0;
  return p;
}

// theta / sin theta = sum_n k_n y^n in y = 1 - cos theta: k_0 = 1, k_n+1 / k_n = (n + 1) / (2 n +
// 3)
constexpr std::array<double, 14> make_angle_by_sine_series() {
  std::array<double, 14> k{1.0};
  for (std::size_t n = 0; n + 1 < k.size(); ++n) {
    k[n + 1] = k[n] * (static_cast<double>(n) + 1.0) / (2.0 * static_cast<double>(n) + 3.0);
  }
  return k;
}
constexpr auto angle_by_sine_series = make_angle_by_sine_series();

// f(c) = theta / sin theta with c = cos theta, continued analytically to c > 1.
// Closed form: (1 - c^2) f' = c f - 1 ,  (1 - c^2) f'' = 3 c f' + f. The series keeps what these
// quotients lose near c = 1.
Jet angle_by_sine(double c) noexcept {
  const double y = 1.0 - c;
  if (std::abs(y) < 0.1) {
    const Jet p = polynomial(angle_by_sine_series, y);
    return {p.value, -p.first, p.second};
  }
  const double sine2 = y * (1.0 + c);
  const double f = c < 1.0 ? std::acos(c) / std::sqrt(sine2) : std::acosh(c) / std::sqrt(-sine2);
  const double df = (c * f - 1.0) / sine2;
  return {f, df, (3.0 * c * df + f) / sine2};
}

// 2 (zeta(2 n + 2) - 1)
constexpr std::array<double, 15> zeta_series{
    1.2898681336964528729,    0.16464646742227638303,   0.034686123968898279429,
    0.0081547123958886787574, 0.0019891502556361706743, 0.00049217310661609659728,
    1.2249627011740965852e-4, 3.0564518817303743465e-5, 7.6345865299996797129e-6,
    1.9079240677455922263e-6, 4.7690100545546598001e-7, 1.1921637810251895922e-7,
    2.9803109656730082469e-8, 7.4506680495769141096e-9, 1.8626548648393363657e-9};

// g(t^2) = 1 / t^2 - (1 + cos t) / (2 t sin t) = sum_n 2 zeta(2 n + 2) w^n / (2 pi)^2 with
// w = (t / 2 pi)^2. Taking the pole 2 / (1 - w) out of the series leaves terms below (w / 4)^n, so
// one formula serves from zero to beyond t = pi (w = 1/4) without cancellation.
Jet rotation_coupling(double t2) noexcept {
  constexpr double scale = 1.0 / (4.0 * std::numbers::pi * std::numbers::pi);
  const double w = scale * t2;
  const double pole = 1.0 / (1.0 - w);
  const Jet p = polynomial(zeta_series, w);
  return {scale * (2.0 * pole + p.value), scale * scale * (2.0 * pole * pole + p.first),
          scale * scale * scale * (4.0 * pole * pole * pole + p.second)};
}

// Derivatives of phi(psi, r) = w . (Γ, K); there is no second derivative by r.
struct RotationDerivatives {
  Vec3 by_psi;
  Vec3 by_r;
  Mat3 psi_psi;
  Mat3 psi_r;
};

// With n, m the weights of Γ, K and s = psi . psi:
//   phi = n . r - 1/2 psi . (r x n) + g(s) p + m . psi / h ,  p = (n . psi)(psi . r) - (n . r) s
RotationDerivatives weigh_by_rotation(const Vec3& psi, const Vec3& r, const Vec6& w,
                                      double h) noexcept {
  const Vec3 n = w.head<3>();
  const double s = psi.squaredNorm();
  const Jet g = rotation_coupling(s);
  const double n_psi = n.dot(psi);
  const double r_psi = r.dot(psi);
  const double n_r = n.dot(r);
  const double p = n_psi * r_psi - n_r * s;
  const Vec3 p_psi = n * r_psi + n_psi * r - 2.0 * n_r * psi;  // ∂p/∂psi
  const Vec3 p_r = n_psi * psi - s * n;                        // ∂p/∂r

  RotationDerivatives d;
  d.by_psi = -0.5 * r.cross(n) + 2.0 * g.first * p * psi + g.value * p_psi + w.tail<3>() / h;
  d.by_r = n - 0.5 * n.cross(psi) + g.value * p_r;
  const Mat3 outer = psi * p_psi.transpose();
  const Mat3 nr = n * r.transpose();
  d.psi_psi = 2.0 * g.first * (outer + outer.transpose()) + g.value * (nr + nr.transpose());
  d.psi_psi += 4.0 * g.second * p * psi * psi.transpose();
  d.psi_psi.diagonal().array() += 2.0 * (g.first * p - g.value * n_r);
  d.psi_r = 0.5 * skew(n) + 2.0 * g.first * psi * p_r.transpose();
  d.psi_r += g.value * (n * psi.transpose() - 2.0 * psi * n.transpose());
  d.psi_r.diagonal().array() += g.value * n_psi;
  return d;
}

// A quantity over a step: mean of its end values, and their difference. Products follow exactly:
// mean(u v) = mu mv + 1/4 du dv ,  delta(u v) = mu dv + du mv, so differences never cancel.
template <class T>
struct OverStep {
  T mean;
  T delta;
};

OverStep<double> dot(const OverStep<Vec3>& u, const OverStep<Vec3>& v) {
  return {u.mean.dot(v.mean) + 0.25 * u.delta.dot(v.delta),
          u.mean.dot(v.delta) + u.delta.dot(v.mean)};
}
OverStep<Vec3> cross(const OverStep<Vec3>& u, const OverStep<Vec3>& v) {
  return {u.mean.cross(v.mean) + 0.25 * u.delta.cross(v.delta),
          u.mean.cross(v.delta) + u.delta.cross(v.mean)};
}
OverStep<Vec3> scale(const OverStep<double>& s, const OverStep<Vec3>& v) {
  return {s.mean * v.mean + 0.25 * s.delta * v.delta, s.mean * v.delta + s.delta * v.mean};
}

// A function over a step of its argument. For steps short against `reach`, the distance to its
// nearest singularity, the difference is the integral of the derivative, elsewhere the plain one.
OverStep<double> over_step(Jet (*function)(double) noexcept, const OverStep<double>& x,
                           double reach) {
  const double f0 = function(x.mean - 0.5 * x.delta).value;
  const double f1 = function(x.mean + 0.5 * x.delta).value;
  OverStep<double> f{0.5 * (f0 + f1), f1 - f0};
  if (std::abs(x.delta) < 5e-3 * reach) {
    double slope = 0.0;
    for (const auto& [xi, weight] : gauss_legendre(3)) {
      slope += 0.5 * weight * function(x.mean + 0.5 * xi * x.delta).first;
    }
    f.delta = slope * x.delta;
  }
  return f;
}

}  // namespace

double helical_rotation(const Vec<7>& z) noexcept {
  const HelicalInvariants m(z);
  return angle_by_sine(m.c).value * m.a.norm();
}

Vec6 helical_strain(const Vec<7>& z, double h) noexcept {
  const HelicalInvariants m(z);
  const Vec3 psi = angle_by_sine(m.c).value * m.a;
  const Vec3 u = psi.cross(m.r);
  Vec6 e;
  e << m.r - 0.5 * u + rotation_coupling(psi.squaredNorm()).value * psi.cross(u), psi / h;
  return e;
}

CULM_FOR_EACH_VECTOR_UNIT [[gnu::flatten]] Mat<6, 7> helical_strain_gradient(const Vec<7>& z,
                                                                             double h) noexcept {
  const HelicalInvariants m(z);
  const Jet f = angle_by_sine(m.c);
  const Vec3 psi = f.value * m.a;
  const Jet g = rotation_coupling(psi.squaredNorm());
  const Mat3 P = skew(psi);
  const Vec3 u = psi.cross(m.r);
  // ∂Γ/∂psi = 1/2 [r] + 2 g' v psi^T - g ([u] + [psi][r]) ,  u = psi x r ,  v = psi x u
  const Mat3 R = skew(m.r);
  const Mat3 strain_by_psi =
      0.5 * R + 2.0 * g.first * psi.cross(u) * psi.transpose() - g.value * (skew(u) + P * R);
  Mat<6, 7> J;
  J.topLeftCorner<3, 1>() = f.first * strain_by_psi * m.a;
  J.block<3, 3>(0, 1) = f.value * strain_by_psi;
  // ∂Γ/∂r = 1 - 1/2 [psi] + g [psi]^2
  J.topRightCorner<3, 3>() = Mat3::Identity() - 0.5 * P + g.value * P * P;
  J.bottomLeftCorner<3, 1>() = f.first / h * m.a;
  J.block<3, 3>(3, 1) = f.value / h * Mat3::Identity();
  J.bottomRightCorner<3, 3>().setZero();
  return J;
}

// psi = f(c) a:  ∂psi/∂c = f' a ,  ∂psi/∂a = f 1 ,  ∂2psi/∂c2 = f'' a ,  ∂2psi/∂c∂a = f' 1
CULM_FOR_EACH_VECTOR_UNIT [[gnu::flatten]] WeightedHelicalStrain weigh_helical_strain(
    const Vec<7>& z, const Vec6& w, double h) noexcept {
  const HelicalInvariants m(z);
  const Jet f = angle_by_sine(m.c);
  const RotationDerivatives phi = weigh_by_rotation(f.value * m.a, m.r, w, h);
  WeightedHelicalStrain result;
  result.gradient << f.first * phi.by_psi.dot(m.a), f.value * phi.by_psi, phi.by_r;
  const Vec3 Ha = phi.psi_psi * m.a;
  Mat<7, 7>& H = result.hessian;
  H(0, 0) = f.first * f.first * m.a.dot(Ha) + f.second * phi.by_psi.dot(m.a);
  H.block<3, 1>(1, 0) = f.first * (f.value * Ha + phi.by_psi);
  H.block<3, 3>(1, 1) = f.value * f.value * phi.psi_psi;
  H.block<3, 1>(4, 0) = f.first * phi.psi_r.transpose() * m.a;
  H.block<3, 3>(4, 1) = f.value * phi.psi_r.transpose();
  H.block<3, 3>(4, 4).setZero();
  H.block<1, 6>(0, 1) = H.block<6, 1>(1, 0).transpose();
  H.block<3, 3>(1, 4) = H.block<3, 3>(4, 1).transpose();
  return result;
}

CULM_FOR_EACH_VECTOR_UNIT [[gnu::flatten]] Vec6 helical_strain_increment(const Vec<7>& z0,
                                                                         const Vec<7>& z1,
                                                                         double h) noexcept {
  const HelicalInvariants mean(0.5 * (z0 + z1));
  const HelicalInvariants delta(z1 - z0);
  const OverStep<Vec3> a{mean.a, delta.a};
  const OverStep<Vec3> r{mean.r, delta.r};
  // the singularities: c = -1 (relative rotation pi), t = 2 pi
  const OverStep<double> f = over_step(angle_by_sine, {mean.c, delta.c}, 1.0 + mean.c);
  const OverStep<Vec3> psi = scale(f, a);
  const OverStep<double> g = over_step(rotation_coupling, dot(psi, psi), 10.0);
  const OverStep<Vec3> u = cross(psi, r);
  const OverStep<Vec3> v = scale(g, cross(psi, u));
  Vec6 de;
  de << r.delta - 0.5 * u.delta + v.delta, psi.delta / h;
  return de;
}

}  // namespace culm::beam
