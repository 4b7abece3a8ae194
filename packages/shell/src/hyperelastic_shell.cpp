#include <culm/material/discrete_derivative.hpp>
#include <culm/shell/hyperelastic_shell.hpp>
#include <culm/shell/layer_quadrature.hpp>
#include <culm/shell/shell_mass.hpp>

#include <Eigen/LU>

#include <algorithm>
#include <utility>
#include <variant>

namespace culm::shell {

namespace {

constexpr int most = Enhancement::most;
// Eigen's matrices of bounded size live on the stack.
using EnhancedMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, most, most>;
using EnhancedByForms = Eigen::Matrix<double, Eigen::Dynamic, ShellForms::num_strains, 0, most,
                                      ShellForms::num_strains>;
using FormsByEnhanced = Eigen::Matrix<double, ShellForms::num_strains, Eigen::Dynamic, 0,
                                      ShellForms::num_strains, most>;

}  // namespace

// Both ends of a step; the enhanced parameters at its end are sought.
struct HyperelasticShell::Step {
  const Strain& prev;
  const Strain& next;
  EnhancedParameters enhanced_prev;
  const Stencil& stencil;

  // Weighted stress of the step at a point and its derivative by the strain at the end.
  Verdict stress(const HyperelasticShell& shell, const Point& point,
                 const EnhancedParameters& enhanced, Vec6& S, Mat6& D) const noexcept {
    const Vec6 E = shell.strain_at(point, next, enhanced);
    const Vec6 E_prev = stencil.theta == 1.0 ? E : shell.strain_at(point, prev, enhanced_prev);
    const Verdict verdict = std::visit(
        [&](const auto& law) { return material::step_stress(law, E_prev, E, stencil, S, D); },
        *point.law);
    S *= point.weight;
    D *= point.weight;
    return verdict;
  }
};

// What the enhanced modes feel, and its derivative by the enhanced parameters.
struct HyperelasticShell::EnhancedSystem {
  EnhancedParameters residual;
  EnhancedMatrix tangent;
  double largest_strain = 0.0;

  Verdict assemble(const HyperelasticShell& shell, const Step& step,
                   const EnhancedParameters& enhanced) noexcept {
    residual = EnhancedParameters::Zero(enhanced.size());
    tangent = EnhancedMatrix::Zero(enhanced.size(), enhanced.size());
    largest_strain = 0.0;
    Verdict verdict = Verdict::ok;
    Vec6 S;
    Mat6 D;
    for (const Point& point : shell.points_) {
      verdict = worse(verdict, step.stress(shell, point, enhanced, S, D));
      if (verdict != Verdict::ok) return verdict;
      residual.noalias() += point.enhanced.transpose() * S;
      const ShellGeometry::EnhancedModes DM = D * point.enhanced;
      tangent.noalias() += point.enhanced.transpose() * DM;
      largest_strain = std::max(
          largest_strain, shell.strain_at(point, step.next, enhanced).lpNorm<Eigen::Infinity>());
    }
    return verdict;
  }
};

HyperelasticShell::HyperelasticShell(const Nodes& reference,
                                     std::shared_ptr<const material::Layup> layup,
                                     const ShellOptions& options)
    : ShellForms(reference),
      geometry_(reference, *layup, options),
      layup_(std::move(layup)),
      mass_(shell_mass(geometry_, *layup_)) {
  visit_volume(
      *layup_, 2,
      [&](const material::Layer& layer, double xi, double eta, double zeta, double weight) {
        const ShellGeometry::Point point = geometry_.at(xi, eta, zeta, layer.angle);
        points_.push_back({&layer.material.law, weight * point.J, point.strain, point.enhanced});
      });
}

Vec6 HyperelasticShell::strain_at(const Point& point, const Strain& y,
                                  const EnhancedParameters& enhanced) const {
  Vec6 E;
  E.noalias() = point.strain * y;
  E.noalias() += point.enhanced.lazyProduct(enhanced);
  return E;
}

// Newton's method; a step into collapse is halved. It converges quadratically, so when an increment
// is below 1e-10 of the strains, the next one would be below round-off.
Verdict HyperelasticShell::solve_enhanced(const Step& step,
                                          EnhancedParameters& enhanced) const noexcept {
  constexpr int most_iterations = 30;
  EnhancedSystem system;
  Verdict verdict = system.assemble(*this, step, enhanced);
  if (verdict != Verdict::ok) {  // a bad guess
    enhanced.setZero();
    verdict = system.assemble(*this, step, enhanced);
  }
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    if (verdict != Verdict::ok) return verdict;
    EnhancedParameters increment = -system.tangent.partialPivLu().solve(system.residual);
    verdict = system.assemble(*this, step, enhanced + increment);
    for (int halving = 0; halving < 6 && verdict != Verdict::ok; ++halving) {
      increment *= 0.5;
      verdict = system.assemble(*this, step, enhanced + increment);
    }
    enhanced += increment;
    double change = 0.0;
    for (const Point& point : points_) {
      const Vec6 dE = point.enhanced.lazyProduct(increment);
      change = std::max(change, dE.lpNorm<Eigen::Infinity>());
    }
    if (verdict == Verdict::ok && change <= 1e-10 * system.largest_strain) return verdict;
  }
  return worse(verdict, Verdict::law_out_of_range);
}

// Stress and tangent of the forms, the enhanced parameters eliminated. What is left of their
// residual is carried over, so that its effect on the stress is of second order.
Verdict HyperelasticShell::respond(int, const Strain& prev, const Strain& next,
                                   const Internals& internals_prev, const Stencil& stencil,
                                   Internals& internals,
                                   Response<num_strains>& response) const noexcept {
  const Step step{prev, next, active(internals_prev), stencil};
  EnhancedParameters enhanced = active(internals);
  response.stress.setZero();
  response.tangent.setZero();
  if (enhanced.size() > 0) {
    const Verdict verdict = solve_enhanced(step, enhanced);
    if (verdict != Verdict::ok) return verdict;
    internals.head(enhanced.size()) = enhanced;
  }

  const auto n = enhanced.size();
  EnhancedParameters residual = EnhancedParameters::Zero(n);
  EnhancedMatrix K_aa = EnhancedMatrix::Zero(n, n);
  EnhancedByForms K_ay = EnhancedByForms::Zero(n, num_strains);
  FormsByEnhanced K_ya = FormsByEnhanced::Zero(num_strains, n);
  Vec6 S;
  Mat6 D;
  for (const Point& point : points_) {
    const Verdict verdict = step.stress(*this, point, enhanced, S, D);
    if (verdict != Verdict::ok) {
      response.stress.setZero();
      response.tangent.setZero();
      return verdict;
    }
    const ShellGeometry::StrainMap DL = D * point.strain;
    response.stress.noalias() += point.strain.transpose() * S;
    response.tangent.noalias() += point.strain.transpose() * DL;
    if (n == 0) continue;
    const ShellGeometry::EnhancedModes DM = D * point.enhanced;
    residual.noalias() += point.enhanced.transpose() * S;
    K_ay.noalias() += point.enhanced.transpose() * DL;
    K_ya.noalias() += point.strain.transpose() * DM;
    K_aa.noalias() += point.enhanced.transpose() * DM;
  }
  if (n == 0) return Verdict::ok;
  const Eigen::PartialPivLU<EnhancedMatrix> factor(K_aa);
  const EnhancedParameters correction = factor.solve(residual);
  const EnhancedByForms slope = factor.solve(K_ay);
  response.stress.noalias() -= K_ya * correction;
  response.tangent.noalias() -= K_ya * slope;
  return Verdict::ok;
}

double HyperelasticShell::energy(int, const Strain& y, const Internals& internals) const noexcept {
  const EnhancedParameters enhanced = active(internals);
  double energy = 0.0;
  for (const Point& point : points_) {
    const Vec6 E = strain_at(point, y, enhanced);
    energy += point.weight * std::visit([&](const auto& law) { return law.energy(E); }, *point.law);
  }
  return energy;
}

ShellResultants HyperelasticShell::resultants(int, const Strain& y,
                                              const Internals& internals) const noexcept {
  return DeformedShell{geometry_, *layup_, y, active(internals)}.resultants();
}

LayerState HyperelasticShell::layer_state(int layer, double height, const Strain& y,
                                          const Internals& internals) const {
  return DeformedShell{geometry_, *layup_, y, active(internals)}.layer_state(layer, height);
}

}  // namespace culm::shell
