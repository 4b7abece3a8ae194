#include <culm/analysis/multi_blade.hpp>
#include <culm/base/error.hpp>

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>

namespace culm::analysis {
namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;

void add_block(Triplets& triplets, int row, int column, const Mat3& block) {
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      if (block(i, j) != 0.0) triplets.emplace_back(row + i, column + j, block(i, j));
    }
  }
}

Mat3 turn(const Vec3& axis, double angle) { return Eigen::AngleAxisd(angle, axis).matrix(); }

// Factors of the coordinates of N blades for one of them, and their first two derivatives.
struct Factors {
  Eigen::VectorXd f, df, ddf;
};

Factors factors(int count, double azimuth) {
  Factors all{Eigen::VectorXd::Zero(count), Eigen::VectorXd::Zero(count),
              Eigen::VectorXd::Zero(count)};
  const double one = 1.0 / std::sqrt(count);
  all.f[0] = one;
  for (int m = 1; 2 * m < count; ++m) {
    const double size = std::numbers::sqrt2 * one;
    const double c = size * std::cos(m * azimuth);
    const double s = size * std::sin(m * azimuth);
    all.f.segment<2>(2 * m - 1) << c, s;
    all.df.segment<2>(2 * m - 1) << -m * s, m * c;
    all.ddf.segment<2>(2 * m - 1) << -m * m * c, -m * m * s;
  }
  if (count % 2 == 0) all.f[count - 1] = one * std::cos(0.5 * count * azimuth);
  return all;
}

// X -> A X B of three vectors side by side.
void add_both_sides(Triplets& triplets, int first, const Mat3& A, const Mat3& B) {
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      if (B(i, j) != 0.0) add_block(triplets, first + 3 * j, first + 3 * i, B(i, j) * A);
    }
  }
}

SparseMatrix assemble(int size, const Triplets& triplets) {
  SparseMatrix matrix(size, size);
  matrix.setFromTriplets(triplets.begin(), triplets.end());
  return matrix;
}

}  // namespace

MultiBlade::MultiBlade(int size, const RotorUnknowns& rotor) {
  const int count = static_cast<int>(rotor.blades.size());
  const Mat3 n = skew(rotor.axis);
  const double part = 2.0 * std::numbers::pi / (count > 0 ? count : 3);
  Triplets L, first, second, symmetry;
  std::vector<bool> turns(static_cast<std::size_t>(size), false);
  const auto mark = [&](int at) {
    for (int i = 0; i < 3; ++i) turns[static_cast<std::size_t>(at + i)] = true;
  };
  for (int at : rotor.hub) {
    mark(at);
    add_block(L, at, at, Mat3::Identity());
    add_block(first, at, at, -n);
    add_block(second, at, at, n * n);
    add_block(symmetry, at, at, turn(rotor.axis, part));
  }
  for (const RotorUnknowns::Triad& triad : rotor.triads) {
    for (int i = 0; i < 3; ++i) mark(triad.first + 3 * i);
    const Mat3& D = triad.directors;
    const Mat3 one = Mat3::Identity();
    const Mat3 g = D.transpose() * n * D;  // dG/dpsi
    add_both_sides(L, triad.first, one, one);
    add_both_sides(first, triad.first, -n, one);
    add_both_sides(first, triad.first, one, g);
    add_both_sides(second, triad.first, n * n, one);
    add_both_sides(second, triad.first, -2.0 * n, g);
    add_both_sides(second, triad.first, one, g * g);
    const Mat3 R = turn(rotor.axis, part);
    add_both_sides(symmetry, triad.first, R, D.transpose() * R.transpose() * D);
  }
  for (std::size_t k = 0; k < rotor.blades.size(); ++k) {
    internal_check(rotor.blades[k].size() == rotor.blades[0].size(), "blades are equal");
    const double azimuth = rotor.azimuth[k];
    std::size_t next = 0;  // the blade one part of a turn on
    while (std::cos(rotor.azimuth[next] - azimuth - part) < 1.0 - 1e-6) ++next;
    const Factors of_blade = factors(count, azimuth);
    const Mat3 axes = turn(rotor.axis, azimuth);
    for (std::size_t v = 0; v < rotor.blades[k].size(); ++v) {
      const int row = rotor.blades[k][v];
      mark(row);
      add_block(symmetry, rotor.blades[next][v], row, turn(rotor.axis, part));
      for (int c = 0; c < count; ++c) {
        const int column = rotor.blades[static_cast<std::size_t>(c)][v];
        add_block(L, row, column, of_blade.f[c] * axes);
        add_block(first, row, column, of_blade.df[c] * axes);
        add_block(second, row, column, of_blade.ddf[c] * axes);
      }
    }
  }
  for (int i = 0; i < size; ++i) {
    if (!turns[static_cast<std::size_t>(i)]) L.emplace_back(i, i, 1.0);
  }
  L_ = assemble(size, L);
  first_ = assemble(size, first);
  second_ = assemble(size, second);
  symmetry_ = assemble(size, symmetry);
}

WhirlShares whirl_shares(const RotorUnknowns& rotor, const SparseMatrix& mass,
                         const Eigen::VectorXcd& z) {
  const std::complex<double> i(0.0, 1.0);
  const std::size_t count = rotor.blades.size();
  const auto square = [&](const auto& coordinates_of) {
    Eigen::VectorXcd part = Eigen::VectorXcd::Zero(z.size());
    for (std::size_t v = 0; count > 0 && v < rotor.blades[0].size(); ++v) coordinates_of(part, v);
    return part.dot(mass * part).real();
  };
  const auto at = [&](std::size_t coordinate, std::size_t v) {
    return Eigen::seqN(rotor.blades[coordinate][v], 3);
  };
  WhirlShares shares;
  shares.collective = square([&](auto& part, std::size_t v) { part(at(0, v)) = z(at(0, v)); });
  // cos(omega t - m psi) = Re (cos m psi - i sin m psi) exp(i omega t) turns with the rotor
  const auto whirl = [&](double sign) {
    return square([&](auto& part, std::size_t v) {
      for (std::size_t m = 1; 2 * m < count; ++m) {
        const auto c = at(2 * m - 1, v);
        const auto s = at(2 * m, v);
        const Eigen::Vector3cd pattern = 0.5 * (z(c) + sign * i * z(s));
        part(c) = pattern;
        part(s) = -sign * i * pattern;
      }
    });
  };
  shares.forward = whirl(1.0);
  shares.backward = whirl(-1.0);
  return shares;
}

}  // namespace culm::analysis
