#include <culm/material/rectangle_section.hpp>
#include <culm/material/section.hpp>
#include <culm/math/quadrature.hpp>

#include <culm_kit/finite_difference.hpp>
#include <culm_kit/rigid_motion.hpp>
#include <gtest/gtest.h>

#include <cmath>

namespace culm::material {
namespace {

using kit::relative_difference;

// A rectangle of width b and height t, turned by an angle and then moved, by integration over its
// points: C = int B^T diag(G, G, E) B dA with the strains (1.8) of a point, m = int rho f f^T dA
// with f = (1, xi1, xi2). Two Gauss points per side are exact.
struct Integrated {
  static constexpr double E = 7.0, G = 2.6, rho = 1.3;
  Mat6 stiffness = Mat6::Zero();
  Mat3 mass = Mat3::Zero();
  StiffnessValues values;

  Integrated(double b, double t, double angle, const Vec<2>& centre) {
    for (const auto& [u, wu] : gauss_legendre(2)) {
      for (const auto& [v, wv] : gauss_legendre(2)) {
        const double x = 0.5 * b * u;
        const double y = 0.5 * t * v;
        const double xi1 = centre[0] + std::cos(angle) * x - std::sin(angle) * y;
        const double xi2 = centre[1] + std::sin(angle) * x + std::cos(angle) * y;
        add_point(xi1, xi2, 0.25 * b * t * wu * wv);
      }
    }
  }

 private:
  void add_point(double xi1, double xi2, double dA) {
    // eps_13 = Γ1 - K3 xi2 ,  eps_23 = Γ2 + K3 xi1 ,  eps_33 = Γ3 + K1 xi2 - K2 xi1
    Mat<3, 6> B;
    B << 1, 0, 0, 0, 0, -xi2,  //
        0, 1, 0, 0, 0, xi1,    //
        0, 0, 1, xi2, -xi1, 0;
    stiffness += dA * B.transpose() * Vec3(G, G, E).asDiagonal() * B;
    const Vec3 f(1.0, xi1, xi2);
    mass += dA * rho * f * f.transpose();
    values.EA += E * dA;
    values.GA1 += G * dA;
    values.GA2 += G * dA;
    values.EI1 += E * xi2 * xi2 * dA;
    values.EI2 += E * xi1 * xi1 * dA;
    values.GIp += G * (xi1 * xi1 + xi2 * xi2) * dA;
    values.ES1 += E * xi2 * dA;
    values.ES2 += E * xi1 * dA;
    values.GS1 += G * xi2 * dA;
    values.GS2 += G * xi1 * dA;
    values.EI12 += E * xi1 * xi2 * dA;
  }
};

Section centred_rectangle(double b, double t) {
  const Integrated centred(b, t, 0.0, {0.0, 0.0});
  return {centred.stiffness, centred.mass, rectangle_outline(b, t)};
}

TEST(StiffnessMatrix, IsTheIntegralOverAnOffsetRectangle) {
  const Integrated offset(0.4, 0.9, 0.3, {0.7, -0.2});
  EXPECT_LT(relative_difference(stiffness_matrix(offset.values), offset.stiffness), 1e-15);
}

TEST(Shifted, IsTheIntegralOverTheShiftedRectangle) {
  const Vec<2> centre(0.7, -0.2);
  const Integrated offset(0.4, 0.9, 0.0, centre);
  const Section section = shifted(centred_rectangle(0.4, 0.9), centre);
  EXPECT_LT(relative_difference(section.stiffness, offset.stiffness), 1e-14);
  EXPECT_LT(relative_difference(section.mass, offset.mass), 1e-14);
  EXPECT_LT((section.outline[2] - Vec<2>(0.9, 0.25)).norm(), 1e-15);
}

// 1/2 int rho |v + w x xi|^2 dA over the points.
TEST(FullMass, IsTheKineticEnergyOfTheOffsetRectangle) {
  const double b = 0.4, t = 0.9, angle = 0.3, rho = Integrated::rho;
  const Vec<2> centre(0.7, -0.2);
  const Vec6 motion = kit::Random(3).matrix<6, 1>();
  double energy = 0.0;
  for (const auto& [u, wu] : gauss_legendre(2)) {
    for (const auto& [v, wv] : gauss_legendre(2)) {
      const double x = 0.5 * b * u;
      const double y = 0.5 * t * v;
      const Vec3 xi(centre[0] + std::cos(angle) * x - std::sin(angle) * y,
                    centre[1] + std::sin(angle) * x + std::cos(angle) * y, 0.0);
      const Vec3 velocity = motion.head<3>() + motion.tail<3>().cross(xi);
      energy += 0.5 * rho * 0.25 * b * t * wu * wv * velocity.squaredNorm();
    }
  }
  const Mat3 mass = Integrated(b, t, angle, centre).mass;
  EXPECT_NEAR(0.5 * motion.dot(full_mass(mass) * motion), energy, 1e-14);
  EXPECT_LT((plane_mass(full_mass(mass)) - mass).norm(), 1e-15);
  EXPECT_TRUE(full_mass_mistakes(full_mass(mass)).empty());
}

TEST(FullMass, RefusesWhatIsNoPlaneSection) {
  const Mat6 mass = full_mass(Integrated(0.4, 0.9, 0.3, {0.7, -0.2}).mass);
  const auto refused = [&](int i, int j, double by) {
    Mat6 other = mass;
    other(i, j) += by;
    if (i != j) other(j, i) += by;
    const auto found = full_mass_mistakes(other);
    return found.empty() ? std::string() : found.front();
  };
  const std::string plane = "the mass is not that of a plane section";
  EXPECT_NE(refused(5, 5, -0.01)
                .find(plane + ", which moves with the directors of its plane: "
                              "entry (6, 6) is"),
            std::string::npos);
  EXPECT_NE(refused(0, 4, 0.02).find("entry (1, 5) is 0.02, by the others it must be 0"),
            std::string::npos);
  EXPECT_NE(refused(3, 5, 0.02).find(plane), std::string::npos);
  EXPECT_NE(refused(1, 1, 0.02).find("entry (2, 2)"), std::string::npos);
  EXPECT_EQ(refused(5, 5, 1e-6), "");  // digits of a file
  EXPECT_NE(refused(3, 3, -mass(3, 3)).find("not positive semidefinite"), std::string::npos);
}

TEST(Rotated, IsTheIntegralOverTheRotatedRectangle) {
  const Integrated turned(0.4, 0.9, 0.6, {0.0, 0.0});
  const Section section = rotated(centred_rectangle(0.4, 0.9), 0.6);
  EXPECT_LT(relative_difference(section.stiffness, turned.stiffness), 1e-14);
  EXPECT_LT(relative_difference(section.mass, turned.mass), 1e-14);
}

TEST(Rotated, AndShiftedSectionIsTurnedAboutItsOwnOrigin) {
  const Vec<2> centre(0.7, -0.2);
  const Integrated both(0.4, 0.9, 0.6, centre);
  const Section section = shifted(rotated(centred_rectangle(0.4, 0.9), 0.6), centre);
  EXPECT_LT(relative_difference(section.stiffness, both.stiffness), 1e-14);
  EXPECT_LT(relative_difference(section.mass, both.mass), 1e-14);
}

TEST(Rotated, BackIsTheIdentity) {
  const Section section{
      kit::Random(1).positive_matrix<6>(), kit::Random(2).positive_matrix<3>(), {}};
  const Section back = rotated(rotated(section, 1.1), -1.1);
  EXPECT_LT(relative_difference(back.stiffness, section.stiffness), 1e-14);
  EXPECT_LT(relative_difference(back.mass, section.mass), 1e-14);
}

TEST(MassMatrix, OrdersItsMomentsByTheAxisTheyAreAbout) {
  const Mat3 m = mass_matrix(
      {.rhoA = 1.0, .rhoI1 = 2.0, .rhoI2 = 3.0, .rhoS1 = 0.1, .rhoS2 = 0.2, .rhoI12 = 0.3});
  Mat3 expected;  // slots x, d1, d2
  expected << 1.0, 0.2, 0.1, 0.2, 3.0, 0.3, 0.1, 0.3, 2.0;
  EXPECT_EQ(m, expected);
}

TEST(Interpolate, IsLinearAndMeetsItsEnds) {
  const Section a = centred_rectangle(1.0, 1.0);
  const Section b = centred_rectangle(2.0, 1.0);
  EXPECT_EQ(interpolate(a, b, 0.0).stiffness, a.stiffness);
  EXPECT_EQ(interpolate(a, b, 1.0).mass, b.mass);
  // what is the same is so to the last digit
  EXPECT_EQ(interpolate(a, a, 0.3).stiffness, a.stiffness);
  EXPECT_EQ(interpolate(a, a, 0.3).mass, a.mass);
  const Section middle = interpolate(a, b, 0.25);
  EXPECT_LT(relative_difference(middle.stiffness, Mat6(0.75 * a.stiffness + 0.25 * b.stiffness)),
            1e-15);
  EXPECT_LT((middle.outline[1] - Vec<2>(0.625, -0.5)).norm(), 1e-15);
}

TEST(Interpolate, DoesNotStiffenWhatMovesOrTurnsItsOwnAxes) {
  const Section own_a = centred_rectangle(0.4, 0.9), own_b = centred_rectangle(0.2, 0.8);
  const Section a = placed(own_a, 0.6, {0.7, -0.2}), b = placed(own_b, -0.4, {0.0, 0.3});
  const Section expected = placed(interpolate(own_a, own_b, 0.25), 0.35, {0.525, -0.075});
  const Section found = interpolate(a, b, 0.25);
  EXPECT_LT(relative_difference(found.stiffness, expected.stiffness), 1e-14);
  EXPECT_LT(relative_difference(found.mass, expected.mass), 1e-14);
  EXPECT_LT((found.outline[1] - expected.outline[1]).norm(), 1e-15);
  EXPECT_LT(relative_difference(interpolate(a, b, 0.0).stiffness, a.stiffness), 1e-14);
  EXPECT_LT(relative_difference(interpolate(found, b, 1.0).mass, b.mass), 1e-14);
}

TEST(Interpolate, TakesTheNearerOutlineWhenTheyDiffer) {
  Section a = centred_rectangle(1.0, 1.0);
  Section b = a;
  b.outline.pop_back();
  EXPECT_EQ(interpolate(a, b, 0.4).outline.size(), 4U);
  EXPECT_EQ(interpolate(a, b, 0.6).outline.size(), 3U);
}

TEST(Mistakes, AcceptSoundAndSemidefiniteMatrices) {
  EXPECT_TRUE(stiffness_mistakes(kit::Random(3).positive_matrix<6>()).empty());
  const Vec6 v = kit::Random(4).matrix<6, 1>();
  EXPECT_TRUE(stiffness_mistakes(v * v.transpose()).empty());
  EXPECT_TRUE(mass_mistakes(Mat3::Zero()).empty());
}

TEST(Mistakes, DoNotDependOnUnits) {
  Mat6 C = kit::Random(3).positive_matrix<6>();
  const Vec6 units = (Vec6() << 1e9, 1e9, 1e9, 1e-3, 1e-3, 1e-3).finished();
  C = units.asDiagonal() * C * units.asDiagonal();
  EXPECT_TRUE(stiffness_mistakes(C).empty());
}

TEST(Mistakes, NameWhatIsWrong) {
  EXPECT_EQ(stiffness_mistakes(Mat6::Zero()).at(0), "the stiffness is zero");
  Mat6 C = Mat6::Identity();
  C(0, 4) = 0.5;
  EXPECT_EQ(stiffness_mistakes(C).at(0),
            "the stiffness is not symmetric: entry (5, 1) is 0 but (1, 5) is 0.5");
  C(4, 0) = 0.5;
  EXPECT_TRUE(stiffness_mistakes(C).empty());
  C(0, 4) = C(4, 0) = 1.5;
  EXPECT_EQ(stiffness_mistakes(C).at(0),
            "the stiffness is not positive semidefinite: its smallest eigenvalue, with the "
            "diagonal scaled to one, is -0.5");
  Mat3 m = Mat3::Identity();
  m(2, 2) = -1.0;
  EXPECT_EQ(mass_mistakes(m).at(0), "the mass has the negative diagonal entry (3, 3) = -1");
}

}  // namespace
}  // namespace culm::material
