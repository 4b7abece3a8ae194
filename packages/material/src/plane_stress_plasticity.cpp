#include <culm/material/plane_stress_plasticity.hpp>

#include <cmath>

namespace culm::material {
namespace {

// The modes that Q and P share.
const Mat3& modes() {
  static const double r = std::sqrt(0.5);
  static const Mat3 T = (Mat3() << r, r, 0.0, r, -r, 0.0, 0.0, 0.0, 1.0).finished();
  return T;
}

const Vec3& deviator() {  // P of the modes
  static const Vec3 p(1.0 / 3.0, 1.0, 2.0);
  return p;
}

const double two_thirds = 2.0 / 3.0;
const double root = std::sqrt(two_thirds);

// x = xt / (1 + l k) by modes, where l = theta times the multiplier of the flow
struct Return {
  const Vec3& trial;  // xt
  const Vec3& k;      // Q P + 2/3 Hk by modes
  double isotropic;
  double yield;  // at the start of the step

  Vec3 stress(double l) const { return trial.cwiseQuotient(Vec3::Ones() + l * k); }
  static double norm(const Vec3& x) { return std::sqrt(x.dot(deviator().cwiseProduct(x))); }
  // derivative of norm(x) by l
  double slope(const Vec3& x, double l) const {
    const Vec3 dx = -k.cwiseProduct(x).cwiseQuotient(Vec3::Ones() + l * k);
    return x.dot(deviator().cwiseProduct(dx)) / norm(x);
  }
  // Newton's method from below: the function is convex and falls, so no step goes too far.
  double solve() const {
    constexpr int most_iterations = 50;
    double l = 0.0;
    for (int i = 0; i < most_iterations; ++i) {
      const Vec3 x = stress(l);
      const double length = norm(x);
      const double value = length * (1.0 - two_thirds * isotropic * l) - root * yield;
      const double by_l =
          slope(x, l) * (1.0 - two_thirds * isotropic * l) - two_thirds * isotropic * length;
      const double change = -value / by_l;
      l += change;
      if (change <= 1e-15 * l) break;
    }
    return l;
  }
};

}  // namespace

PlaneStressPlasticity::PlaneStressPlasticity(double E, double nu, const Plasticity& plasticity)
    : q_(E / (1.0 - nu), E / (1.0 + nu), 0.5 * E / (1.0 + nu)), constants_(plasticity) {}

PlasticStep<3> PlaneStressPlasticity::step(const Vec3& prev, const Vec3& next, const Flow& flow,
                                           double theta) const noexcept {
  const Mat3& T = modes();
  const Vec3& P = deviator();
  const Vec3 p = T * flow.strain;
  const Vec3 strain = T * ((1.0 - theta) * prev + theta * next);
  const double kinematic = two_thirds * constants_.kinematic;
  const double yield = constants_.yield_stress + constants_.isotropic * flow.accumulated;
  const Vec3 trial = q_.cwiseProduct(strain - p) - kinematic * p.cwiseQuotient(P);
  PlasticStep<3> step{flow, relief(flow), RowMat<3, 3>::Zero()};
  const double excess = Return::norm(trial) / root - yield;
  if (excess <= 0.0) return step;

  const Vec3 k = q_.cwiseProduct(P) + Vec3::Constant(kinematic);
  const Return to_surface{trial, k, constants_.isotropic, yield};
  const double l = to_surface.solve();
  const Vec3 x = to_surface.stress(l);
  const double length = Return::norm(x);
  const Vec3 flown = l / theta * P.cwiseProduct(x);
  const double grown = root * l / theta * length;
  step.next.strain += T * flown;
  step.next.accumulated += grown;
  step.dissipation = constants_.yield_stress * grown;
  step.relief = T * q_.cwiseProduct(p + theta * flown);
  if (touches(excess, yield)) return step;

  // d relief = theta (l Q P Q / (1 + l k) de + v dl)    v = Q P x / (1 + l k)    dl = g . de
  const Vec3 below = Vec3::Ones() + l * k;
  const Vec3 v = q_.cwiseProduct(P).cwiseProduct(x).cwiseQuotient(below);
  const double m = 1.0 - two_thirds * constants_.isotropic * l;
  const double by_l =
      m * to_surface.slope(x, l) - two_thirds * constants_.isotropic * length;  // < 0
  const Vec3 g = -m / (length * by_l) * v;
  Mat3 slope = v * g.transpose();
  slope.diagonal() += l * q_.cwiseProduct(P).cwiseProduct(q_).cwiseQuotient(below);
  step.slope = theta * T * slope * T;
  return step;
}

double PlaneStressPlasticity::energy(const Vec3& strain, const Flow& flow) const noexcept {
  const Vec3 p = modes() * flow.strain;
  const Vec3 e = modes() * strain;
  return q_.cwiseProduct(p).dot(0.5 * p - e) +
         constants_.kinematic / 3.0 * p.dot(p.cwiseQuotient(deviator())) +
         0.5 * constants_.isotropic * flow.accumulated * flow.accumulated;
}

Vec3 PlaneStressPlasticity::relief(const Flow& flow) const noexcept { return elastic(flow.strain); }

Vec3 PlaneStressPlasticity::elastic(const Vec3& strain) const noexcept {
  return modes() * q_.cwiseProduct(modes() * strain);
}

double PlaneStressPlasticity::equivalent(const Vec3& stress) noexcept {
  return Return::norm(modes() * stress) / root;
}

}  // namespace culm::material
