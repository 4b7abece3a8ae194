#include <culm/water/radiation_fit.hpp>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace culm::water {
namespace {

using Complex = std::complex<double>;
using MatC = Eigen::Matrix<Complex, 6, 6>;
constexpr Complex imaginary(0.0, 1.0);
// A coupling of two motions that is smaller beside their own entries counts by that much only: in
// files of hulls with two planes of symmetry it is what their panels make of it.
constexpr double faint = 0.03;

// What is fitted: entries of the upper triangle that are not nothing, by frequency.
struct Data {
  std::vector<double> frequencies;
  std::vector<std::pair<int, int>> entries;
  Eigen::MatrixXcd values;  // frequency, entry
  Eigen::VectorXd weights;  // of entries: one over their size
};

Data data_of(const PotentialBody& body) {
  Data data;
  std::vector<MatC> all;
  for (const Radiation& one : body.radiation) {
    const Mat6 A = one.added_mass - body.infinite_mass;
    const Mat6 B = one.damping;
    data.frequencies.push_back(one.frequency);
    all.push_back((0.5 * (B + B.transpose())).cast<Complex>() +
                  imaginary * one.frequency * (0.5 * (A + A.transpose())).cast<Complex>());
  }
  // the size of an entry is compared with those of the diagonal beside it
  Mat6 sizes = Mat6::Zero();
  for (const MatC& one : all) sizes = sizes.cwiseMax(one.cwiseAbs());
  for (int i = 0; i < 6; ++i) {
    for (int j = i; j < 6; ++j) {
      const double usual = std::sqrt(sizes(i, i) * sizes(j, j));
      if (sizes(i, j) > 0.0 && sizes(i, j) > 1e-6 * usual) data.entries.emplace_back(i, j);
    }
  }
  const auto rows = static_cast<Eigen::Index>(all.size());
  const auto columns = static_cast<Eigen::Index>(data.entries.size());
  data.values.resize(rows, columns);
  data.weights.resize(columns);
  for (Eigen::Index c = 0; c < columns; ++c) {
    const auto [i, j] = data.entries[static_cast<std::size_t>(c)];
    data.weights[c] = 1.0 / std::max(sizes(i, j), faint * std::sqrt(sizes(i, i) * sizes(j, j)));
    for (Eigen::Index r = 0; r < rows; ++r) {
      data.values(r, c) = all[static_cast<std::size_t>(r)](i, j);
    }
  }
  return data;
}

// For each pole of a pair two functions, whose real factors are real and imaginary part of the
// residue.
Eigen::MatrixXcd basis(const std::vector<Complex>& poles, const std::vector<double>& frequencies) {
  Eigen::MatrixXcd functions(frequencies.size(), 2 * poles.size());
  for (std::size_t r = 0; r < frequencies.size(); ++r) {
    const Complex s = imaginary * frequencies[r];
    for (std::size_t k = 0; k < poles.size(); ++k) {
      const Complex a = 1.0 / (s - poles[k]), b = 1.0 / (s - std::conj(poles[k]));
      const auto row = static_cast<Eigen::Index>(r), column = static_cast<Eigen::Index>(2 * k);
      functions(row, column) = a + b;
      functions(row, column + 1) = imaginary * (a - b);
    }
  }
  return functions;
}

Eigen::MatrixXd parts(const Eigen::MatrixXcd& matrix) {
  Eigen::MatrixXd both(2 * matrix.rows(), matrix.cols());
  both << matrix.real(), matrix.imag();
  return both;
}

// The zeros of 1 + sum of the basis times `factors`, mirrored to the stable side: the next poles.
std::vector<Complex> zeros(const std::vector<Complex>& poles, const Eigen::VectorXd& factors) {
  const auto size = factors.size();
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(size, size);
  Eigen::VectorXd b = Eigen::VectorXd::Zero(size);
  for (std::size_t k = 0; k < poles.size(); ++k) {
    const auto at = static_cast<Eigen::Index>(2 * k);
    H.block<2, 2>(at, at) << poles[k].real(), poles[k].imag(), -poles[k].imag(), poles[k].real();
    b[at] = 2.0;
  }
  H -= b * factors.transpose();
  std::vector<Complex> upper;
  std::vector<double> real;
  const Eigen::VectorXcd found = Eigen::EigenSolver<Eigen::MatrixXd>(H, false).eigenvalues();
  for (const Complex& zero : found) {
    const double decay = -std::max(std::abs(zero.real()), 1e-6 * std::abs(zero));
    if (zero.imag() > 1e-9 * std::abs(zero)) upper.emplace_back(decay, zero.imag());
    if (std::abs(zero.imag()) <= 1e-9 * std::abs(zero)) real.push_back(decay);
  }
  // two real ones become a pair with a small frequency, so that all terms are of one kind
  std::sort(real.begin(), real.end());
  for (std::size_t i = 0; i + 1 < real.size(); i += 2) {
    upper.emplace_back(0.5 * (real[i] + real[i + 1]), 1e-2 * std::abs(real[i] + real[i + 1]));
  }
  return upper;
}

// One step of vector fitting: sigma f = sum c / (s - p) for each entry f, sigma = 1 + sum d / (s -
// p). The factors c of each entry are eliminated by a QR factorisation, as only d is wanted.
std::vector<Complex> relocate(const std::vector<Complex>& poles, const Data& data) {
  const Eigen::MatrixXcd functions = basis(poles, data.frequencies);
  const Eigen::MatrixXd own = parts(functions);
  const Eigen::Index n = functions.cols();
  Eigen::MatrixXd A(n * data.values.cols(), n);
  Eigen::VectorXd b(A.rows());
  for (Eigen::Index c = 0; c < data.values.cols(); ++c) {
    const Eigen::MatrixXcd shared = data.values.col(c).asDiagonal() * functions;
    Eigen::MatrixXd whole(own.rows(), 2 * n + 1);
    whole << own, -parts(shared), parts(Eigen::MatrixXcd(data.values.col(c)));
    whole *= data.weights[c];
    const Eigen::MatrixXd R = Eigen::HouseholderQR<Eigen::MatrixXd>(whole).matrixQR();
    A.middleRows(c * n, n) = R.block(n, n, n, n).triangularView<Eigen::Upper>();
    b.segment(c * n, n) = R.block(n, 2 * n, n, 1);
  }
  return zeros(poles, A.colPivHouseholderQr().solve(b));
}

void set_residues(const std::vector<Complex>& poles, const Data& data, RadiationModel& model) {
  const Eigen::MatrixXd functions = parts(basis(poles, data.frequencies));
  const Eigen::MatrixXd wanted = parts(data.values);
  const Eigen::MatrixXd factors = functions.colPivHouseholderQr().solve(wanted);
  for (const Complex& pole : poles) model.terms.push_back({pole, MatC::Zero()});
  for (std::size_t k = 0; k < poles.size(); ++k) {
    for (Eigen::Index c = 0; c < factors.cols(); ++c) {
      const auto [i, j] = data.entries[static_cast<std::size_t>(c)];
      const auto at = static_cast<Eigen::Index>(2 * k);
      const Complex residue(factors(at, c), factors(at + 1, c));
      model.terms[k].residue(i, j) = model.terms[k].residue(j, i) = residue;
    }
  }
  const Eigen::MatrixXd miss = (functions * factors - wanted) * data.weights.asDiagonal();
  model.error = miss.norm() / (wanted * data.weights.asDiagonal()).norm();
}

struct Lowest {
  double value = 0.0;      // eigenvalue of the damping over its largest entries
  double frequency = 0.0;  // where it is
};

// Each motion is scaled by its largest damping in the files.
Lowest lowest_damping(const RadiationModel& model, const Vec6& largest, double highest) {
  constexpr int steps = 2000;
  Vec6 scale;
  for (int i = 0; i < 6; ++i) scale[i] = largest[i] > 0.0 ? 1.0 / std::sqrt(largest[i]) : 0.0;
  Lowest lowest;
  for (int i = 1; i <= steps; ++i) {
    const double frequency = highest * i / steps;
    const Mat6 scaled = scale.asDiagonal() * Mat6(model.at(frequency).real()) * scale.asDiagonal();
    const double value = Eigen::SelfAdjointEigenSolver<Mat6>(scaled).eigenvalues()[0];
    if (value < lowest.value) lowest = {value, frequency};
  }
  return lowest;
}

// c s / (s^2 + 2 D w s + w^2): damping of all motions about a frequency, and nearly none far below
RadiationModel::Term bump(double frequency, const Vec6& height) {
  constexpr double D = 0.5;
  const double root = std::sqrt(1.0 - D * D);
  const Mat6 c = (2.0 * D * frequency * height).asDiagonal();
  return {frequency * Complex(-D, root), c.cast<Complex>() * Complex(0.5, 0.5 * D / root)};
}

// Where there is hardly any damping, beyond the files or in some motion together with another, a
// fit has a little of either sign. Bumps make up for what is negative, and a constant for the rest.
void take_energy(RadiationModel& model, const PotentialBody& body) {
  Vec6 largest = Vec6::Zero();
  for (const Radiation& one : body.radiation) {
    largest = largest.cwiseMax(one.damping.diagonal().cwiseAbs());
  }
  constexpr int most = 20;
  constexpr double nothing = 1e-8, more = 1.2;
  const double highest = 8.0 * body.radiation.back().frequency;
  Lowest lowest = lowest_damping(model, largest, highest);
  model.creates = -lowest.value;
  for (int i = 0; i < most && lowest.value < -nothing; ++i) {
    model.terms.push_back(bump(lowest.frequency, -more * lowest.value * largest));
    lowest = lowest_damping(model, largest, highest);
  }
  model.extra = (-lowest.value * largest).asDiagonal();
}

}  // namespace

Eigen::Matrix<std::complex<double>, 6, 6> RadiationModel::at(double frequency) const {
  MatC sum = MatC::Zero();
  const Complex s = imaginary * frequency;
  for (const Term& term : terms) {
    sum += term.residue / (s - term.pole) + term.residue.conjugate() / (s - std::conj(term.pole));
  }
  return sum;
}

RadiationModel fit_radiation(const PotentialBody& body, int pairs) {
  RadiationModel model;
  const Data data = data_of(body);
  if (data.entries.empty()) return model;
  std::vector<Complex> poles;
  const double low = data.frequencies.front(), high = data.frequencies.back();
  for (int k = 0; k < pairs; ++k) {
    const double frequency = std::lerp(low, high, (k + 0.5) / pairs);
    poles.emplace_back(-0.3 * frequency, frequency);
  }
  constexpr int rounds = 30;
  for (int round = 0; round < rounds; ++round) poles = relocate(poles, data);
  set_residues(poles, data, model);
  take_energy(model, body);
  return model;
}

}  // namespace culm::water
