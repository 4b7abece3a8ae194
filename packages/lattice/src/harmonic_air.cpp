#include <culm/lattice/harmonic_air.hpp>

#include <Eigen/LU>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>

namespace culm::lattice {
namespace {

using Complex = std::complex<double>;

// Reduced frequencies k = w c / 2 U.
constexpr double lowest = 0.005, highest = 2.0;
constexpr int samples = 20;
constexpr double first_rate =
    0.0125;  // c / 2 U T of the slowest lag; each has half the time of the one before
constexpr int num_lags = 9;

double rate_of(int lag) { return first_rate * std::pow(2.0, lag); }

// Slow motions count most: the wake is large in them.
double weight(double k) { return 1.0 / std::sqrt(k); }

// What damping, mass and lags of unit size are at a reduced frequency.
Eigen::RowVectorXcd terms(double k) {
  const Complex s(0.0, k);
  Eigen::RowVectorXcd row(2 + num_lags);
  row[0] = s;
  row[1] = s * s;
  for (int lag = 0; lag < num_lags; ++lag) row[2 + lag] = s / (rate_of(lag) + s);
  return row;
}

// Without wind there is no wake, and nothing is to be fitted.
LaggedAir without_wind(const SmallMotions& small) {
  const Eigen::PartialPivLU<Eigen::MatrixXd> influence(small.influence);
  const Eigen::MatrixXd by_velocity = influence.solve(small.flow_by_velocity);
  return {-(small.by_circulation * by_velocity + small.by_velocity),
          -small.by_growth * by_velocity,
          {}};
}

}  // namespace

Eigen::MatrixXcd harmonic_air(const SmallMotions& small, Complex s) {
  Eigen::MatrixXcd influence = small.influence.cast<Complex>();
  for (const WakeRow& row : small.rows) {
    influence.col(row.edge_ring) += std::exp(-s * row.delay) * row.induced;
  }
  const Eigen::MatrixXcd circulation =
      influence.partialPivLu().solve(small.flow_by_place + s * small.flow_by_velocity);
  return -((small.by_circulation + s * small.by_growth) * circulation + small.by_place +
           s * small.by_velocity);
}

Eigen::MatrixXcd LaggedAir::at(Complex s) const {
  Eigen::MatrixXcd sum = s * damping + s * s * mass;
  for (const Lag& lag : lags) sum += s * lag.time / (1.0 + s * lag.time) * lag.stiffness;
  return sum;
}

LaggedAir fit_lags(const SmallMotions& small) {
  if (small.passing == 0.0) return without_wind(small);
  const double end = std::min(highest, 0.5 * small.passing / small.panel);
  std::vector<double> k(samples);
  Eigen::MatrixXd design(2 * samples, 2 + num_lags);
  for (int i = 0; i < samples; ++i) {
    const auto at = static_cast<std::size_t>(i);
    k[at] = lowest * std::pow(end / lowest, i / (samples - 1.0));
    const Eigen::RowVectorXcd row = weight(k[at]) * terms(k[at]);
    design.row(2 * i) = row.real();
    design.row(2 * i + 1) = row.imag();
  }
  const Eigen::MatrixXd inverse = design.completeOrthogonalDecomposition().pseudoInverse();
  const Eigen::MatrixXd steady = harmonic_air(small, 0.0).real();
  std::vector<Eigen::MatrixXd> found(2 + num_lags,
                                     Eigen::MatrixXd::Zero(steady.rows(), steady.cols()));
  for (int i = 0; i < samples; ++i) {
    const double at = k[static_cast<std::size_t>(i)];
    const Eigen::MatrixXcd air =
        weight(at) * (harmonic_air(small, Complex(0.0, at / small.passing)) - steady);
    for (int term = 0; term < 2 + num_lags; ++term) {
      found[static_cast<std::size_t>(term)] +=
          inverse(term, 2 * i) * air.real() + inverse(term, 2 * i + 1) * air.imag();
    }
  }
  LaggedAir result{small.passing * found[0], small.passing * small.passing * found[1], {}};
  for (int lag = 0; lag < num_lags; ++lag) {
    result.lags.push_back(
        {small.passing / rate_of(lag), std::move(found[static_cast<std::size_t>(2 + lag)])});
  }
  return result;
}

}  // namespace culm::lattice
