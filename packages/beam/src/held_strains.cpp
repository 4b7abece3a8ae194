#include <culm/beam/held_strains.hpp>
#include <culm/model/product_sum.hpp>

#include <Eigen/Geometry>
#include <Eigen/QR>

#include <cmath>
#include <vector>

namespace culm::beam {

namespace {

// Sums of slots that interpolate the axis or vectors of the triad at a point of an element.
template <int Order>
class PointSums {
 public:
  PointSums(const DirectorBeam<Order>& element, int point)
      : N_(element.shape(point)), dN_(element.shape_derivative(point)) {}

  model::SlotSum slope() const { return sum(dN_, Eigen::Vector4d(1.0, 0.0, 0.0, 0.0)); }
  // sum_c u_c d_c and its derivative by arc length
  model::SlotSum director(const Vec3& u) const { return sum(N_, {0.0, u[0], u[1], u[2]}); }
  model::SlotSum director_slope(const Vec3& u) const { return sum(dN_, {0.0, u[0], u[1], u[2]}); }

  // k . K = |k| / 2 (u'. v - v'. u) for a right-handed triad (u, v, k / |k|) in the directors
  std::vector<model::SlotProduct> curvature(const Vec3& k) const {
    const Vec3 n = k.normalized();
    const Vec3 u = n.unitOrthogonal();
    const Vec3 v = n.cross(u);
    const double half = 0.5 * k.norm();
    return {{director_slope(half * u), director(v)}, {director_slope(-half * v), director(u)}};
  }

 private:
  static model::SlotSum sum(const Vec<Order + 1>& shape, const Eigen::Vector4d& factors) {
    model::SlotSum all;
    for (int a = 0; a <= Order; ++a) {
      for (int s = 0; s < 4; ++s) all.push_back(shape[a] * factors[s]);
    }
    return all;
  }

  const Vec<Order + 1>& N_;
  const Vec<Order + 1>& dN_;
};

}  // namespace

Mat3 centre_coupling(const Mat6& stiffness) {
  // without units, so that one threshold tells zero from stiffnesses of any size
  Vec3 scale;
  for (int i = 0; i < 3; ++i) {
    scale[i] = stiffness(i, i) > 0.0 ? 1.0 / std::sqrt(stiffness(i, i)) : 1.0;
  }
  const Mat3 scaled = scale.asDiagonal() * stiffness.topLeftCorner<3, 3>() * scale.asDiagonal();
  Eigen::CompleteOrthogonalDecomposition<Mat3> factors(3, 3);
  factors.setThreshold(1e-12);
  factors.compute(scaled);
  const Mat3 right = scale.asDiagonal() * stiffness.topRightCorner<3, 3>();
  return scale.asDiagonal() * factors.solve(right);
}

Mat6 without_shear_and_extension(const Mat6& stiffness) {
  Mat6 reduced = Mat6::Zero();
  reduced.bottomRightCorner<3, 3>() =
      stiffness.bottomRightCorner<3, 3>() -
      stiffness.bottomLeftCorner<3, 3>() * centre_coupling(stiffness);
  return 0.5 * (reduced + reduced.transpose());
}

template <int Order>
model::Constraint hold_strains(const std::string& name, HeldStrains held,
                               const DirectorBeam<Order>& element,
                               const std::array<int, Order + 1>& nodes,
                               const typename DirectorBeam<Order>::Nodes& reference) {
  model::Constraint c;
  c.name = name;
  c.type = held.shear_and_extension ? "Kirchhoff" : "Torsion held";
  c.nodes.assign(nodes.begin(), nodes.end());
  c.is_internal = true;
  c.is_structural = true;
  const Eigen::Matrix3Xd q = reference;
  for (int p = 0; p < DirectorBeam<Order>::num_points; ++p) {
    const PointSums<Order> at(element, p);
    const Mat3 D = centre_coupling(element.stiffness(p));
    for (int i = 0; held.shear_and_extension && i < 3; ++i) {
      Vec3 k = D.row(i).transpose();
      if (held.torsion) k[2] = 0.0;
      std::vector<model::SlotProduct> strain{{at.slope(), at.director(Vec3::Unit(i))}};
      if (!k.isZero(0.0)) {
        const auto bending = at.curvature(k);
        strain.insert(strain.end(), bending.begin(), bending.end());
      }
      c.rows.push_back(model::sum_row(strain, q));
    }
    // times the length that the point stands for: an angle
    if (held.torsion) {
      c.rows.push_back(model::sum_row(at.curvature(element.length(p) * Vec3::UnitZ()), q));
    }
  }
  return c;
}

template model::Constraint hold_strains(const std::string&, HeldStrains, const DirectorBeam<1>&,
                                        const std::array<int, 2>&, const DirectorBeam<1>::Nodes&);
template model::Constraint hold_strains(const std::string&, HeldStrains, const DirectorBeam<2>&,
                                        const std::array<int, 3>&, const DirectorBeam<2>::Nodes&);
template model::Constraint hold_strains(const std::string&, HeldStrains, const DirectorBeam<3>&,
                                        const std::array<int, 4>&, const DirectorBeam<3>::Nodes&);

}  // namespace culm::beam
