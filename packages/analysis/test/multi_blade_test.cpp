#include <culm/analysis/multi_blade.hpp>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace culm::analysis {
namespace {

using Eigen::MatrixXd;
using std::numbers::pi;

// A hub of one vector, blades of two, and one unknown that stands.
RotorUnknowns make(int count) {
  RotorUnknowns rotor;
  rotor.axis = Vec3(0.6, 0.0, 0.8);
  rotor.hub = {1};
  for (int k = 0; k < count; ++k) {
    rotor.azimuth.push_back(2.0 * pi * ((k * (count - 1)) % count) / count);  // in any order
    rotor.blades.push_back({4 + 6 * k, 7 + 6 * k});
  }
  return rotor;
}

int size_of(const RotorUnknowns& rotor) { return 4 + 6 * static_cast<int>(rotor.blades.size()); }

// L at another azimuth of the rotor: blades have gone on, and so has what the frame shows of them.
MatrixXd at_azimuth(RotorUnknowns rotor, double psi) {
  const MatrixXd start = MultiBlade(size_of(rotor), rotor).L();
  const Mat3 back = Eigen::AngleAxisd(-psi, rotor.axis).matrix();
  for (double& azimuth : rotor.azimuth) azimuth += psi;
  MatrixXd L = MatrixXd::Zero(start.rows(), start.cols());
  const auto count = static_cast<int>(rotor.blades.size());
  // of alternating blades psi is no argument, so the factors are written out
  for (std::size_t k = 0; k < rotor.blades.size(); ++k) {
    const double azimuth = rotor.azimuth[k];
    const Mat3 axes = Eigen::AngleAxisd(azimuth - psi, rotor.axis).matrix();
    for (std::size_t v = 0; v < 2; ++v) {
      const auto block = [&](int c, double factor) {
        L.block<3, 3>(rotor.blades[k][v], rotor.blades[static_cast<std::size_t>(c)][v]) =
            factor / std::sqrt(count) * axes;
      };
      block(0, 1.0);
      for (int m = 1; 2 * m < count; ++m) {
        block(2 * m - 1, std::sqrt(2.0) * std::cos(m * azimuth));
        block(2 * m, std::sqrt(2.0) * std::sin(m * azimuth));
      }
      if (count % 2 == 0) block(count - 1, std::cos(0.5 * count * (azimuth - psi)));
    }
  }
  L.block<3, 3>(1, 1) = back;
  L(0, 0) = 1.0;
  return L;
}

TEST(MultiBlade, IsOrthogonal) {
  for (int count : {3, 4, 5, 6}) {
    const RotorUnknowns rotor = make(count);
    const MatrixXd L = MultiBlade(size_of(rotor), rotor).L();
    EXPECT_LT((L.transpose() * L - MatrixXd::Identity(L.rows(), L.cols())).norm(), 1e-13);
  }
}

TEST(MultiBlade, HasTheDerivativesByAzimuth) {
  for (int count : {3, 4, 5}) {
    const RotorUnknowns rotor = make(count);
    const MultiBlade map(size_of(rotor), rotor);
    const double h = 1e-4;
    const MatrixXd ahead = at_azimuth(rotor, h);
    const MatrixXd here = at_azimuth(rotor, 0.0);
    const MatrixXd behind = at_azimuth(rotor, -h);
    EXPECT_LT((here - MatrixXd(map.L())).norm(), 1e-14);
    EXPECT_LT(((ahead - behind) / (2.0 * h) - MatrixXd(map.first())).norm(), 1e-7);
    EXPECT_LT(((ahead - 2.0 * here + behind) / (h * h) - MatrixXd(map.second())).norm(), 1e-6);
  }
}

// A triad that turns by a small angle about an axis at rest: what the frame that turns with it
// shows.
TEST(MultiBlade, FollowsTheDirectorsOfABody) {
  RotorUnknowns rotor;
  rotor.axis = Vec3(0.6, 0.0, 0.8);
  const Mat3 D = Eigen::AngleAxisd(0.7, Vec3(1.0, 2.0, -0.5).normalized()).matrix();
  rotor.triads.push_back({0, D});
  const MultiBlade map(9, rotor);
  const Vec3 theta(0.3, -0.4, 1.1);
  const auto seen = [&](double psi) {
    const Mat3 R = Eigen::AngleAxisd(psi, rotor.axis).matrix();
    const Mat3 change = R.transpose() * skew(theta) * R * D;
    return Eigen::VectorXd(Eigen::Map<const Vec<9>>(change.data()));
  };
  const Eigen::VectorXd z = seen(0.0);
  const double h = 1e-4;
  EXPECT_LT((map.L() * z - z).norm(), 1e-15);
  EXPECT_LT((map.first() * z - (seen(h) - seen(-h)) / (2.0 * h)).norm(), 1e-7);
  EXPECT_LT((map.second() * z - (seen(h) - 2.0 * z + seen(-h)) / (h * h)).norm(), 1e-6);
  EXPECT_LT((map.symmetry() * z - seen(-2.0 * pi / 3.0)).norm(), 1e-14);
}

TEST(MultiBlade, MakesASymmetricRotorTheSameAtEachAzimuth) {
  for (int count : {3, 4, 5}) {
    const RotorUnknowns rotor = make(count);
    const MultiBlade map(size_of(rotor), rotor);
    // any matrix, averaged over all places of the rotor
    MatrixXd K = MatrixXd::Random(size_of(rotor), size_of(rotor));
    K.row(0).setZero();
    K.col(0).setZero();
    const MatrixXd S = map.symmetry();
    MatrixXd sum = MatrixXd::Zero(K.rows(), K.cols());
    MatrixXd turned = K;
    for (int i = 0; i < count; ++i) {
      sum += turned;
      turned = S.transpose() * turned * S;
    }
    const MatrixXd at_start = map.L().transpose() * sum * map.L();
    MatrixXd alternating = MatrixXd::Ones(K.rows(), K.cols());
    if (count % 2 == 0) {  // the coordinate that stays periodic where blades couple with the rest
      for (int at : rotor.blades.back()) {
        alternating.middleRows(at, 3).setZero();
        alternating.middleCols(at, 3).setZero();
        alternating.block(at, at, 3, 3).setOnes();
      }
    }
    for (double psi : {0.3, 1.1}) {
      const MatrixXd L = at_azimuth(rotor, psi);
      const MatrixXd there = L.transpose() * sum * L;
      EXPECT_LT((there - at_start).cwiseProduct(alternating).norm(), 1e-12 * sum.norm()) << count;
    }
  }
}

TEST(MultiBlade, TellsWhichWayAPatternTurns) {
  const RotorUnknowns rotor = make(3);
  const int size = size_of(rotor);
  SparseMatrix mass(size, size);
  mass.setIdentity();
  // blade k moves along its own first vector with cos(omega t - sign psi_k), seen at rest
  for (double sign : {1.0, -1.0}) {
    Eigen::VectorXcd z = Eigen::VectorXcd::Zero(size);
    z[rotor.blades[1][0]] = 1.0;
    z[rotor.blades[2][0]] = std::complex<double>(0.0, -sign);
    const WhirlShares shares = whirl_shares(rotor, mass, z);
    EXPECT_NEAR(shares.forward, sign > 0.0 ? 2.0 : 0.0, 1e-14);
    EXPECT_NEAR(shares.backward, sign > 0.0 ? 0.0 : 2.0, 1e-14);
    EXPECT_NEAR(shares.collective, 0.0, 1e-14);
  }
}

}  // namespace
}  // namespace culm::analysis
