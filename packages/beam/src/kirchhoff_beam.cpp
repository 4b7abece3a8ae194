#include <culm/beam/kirchhoff_beam.hpp>
#include <culm/mechanics/linear_law.hpp>

namespace culm::beam {

template <int Order>
KirchhoffBeam<Order>::KirchhoffBeam(const Base& base) : base_(base) {
  for (int p = 0; p < num_points; ++p) {
    stiffness_[static_cast<std::size_t>(p)] = base.stiffness(p).template bottomRightCorner<3, 3>();
  }
}

template <int Order>
void KirchhoffBeam<Order>::strain(int point, const Nodes& q, Strain& e) const noexcept {
  Vec6 all;
  base_.strain(point, q, all);
  e = all.template tail<3>();
}

template <int Order>
void KirchhoffBeam<Order>::gradient(int point, const Nodes& q,
                                    Gradient<num_slots, num_strains>& B) const noexcept {
  Gradient<num_slots, 6> all;
  base_.gradient(point, q, all);
  B = all.template rightCols<3>();
}

template <int Order>
void KirchhoffBeam<Order>::add_curvature(int point, const Strain& S,
                                         SlotMatrix<num_slots>& A) const noexcept {
  Vec6 all = Vec6::Zero();
  all.template tail<3>() = S;
  base_.add_curvature(point, all, A);
}

template <int Order>
Verdict KirchhoffBeam<Order>::respond(int point, const Strain& prev, const Strain& next,
                                      const Stencil& stencil,
                                      Response<num_strains>& response) const noexcept {
  LinearLaw<3>{stiffness(point)}.respond(prev, next, stencil, response);
  return Verdict::ok;
}

template <int Order>
double KirchhoffBeam<Order>::energy(int point, const Strain& e) const noexcept {
  return LinearLaw<3>{stiffness(point)}.energy(e);
}

template <int Order>
Vec3 KirchhoffBeam<Order>::resultants(int point, const Strain& e) const noexcept {
  return stiffness(point) * e / base_.length(point);
}

template <int Order>
model::Constraint shear_free(const std::string& name, const DirectorBeam<Order>& element,
                             const std::array<int, Order + 1>& nodes,
                             const typename DirectorBeam<Order>::Nodes& reference) {
  model::Constraint c;
  c.name = name;
  c.type = "Kirchhoff";
  c.nodes.assign(nodes.begin(), nodes.end());
  c.is_internal = true;
  c.is_structural = true;
  const Eigen::Matrix3Xd q = reference;
  for (int p = 0; p < DirectorBeam<Order>::num_points; ++p) {
    const Vec<Order + 1>& N = element.shape(p);
    const Vec<Order + 1>& dN = element.shape_derivative(p);
    for (int i = 0; i < 3; ++i) {
      model::SlotSum slope(DirectorBeam<Order>::num_slots, 0.0);
      model::SlotSum director(DirectorBeam<Order>::num_slots, 0.0);
      for (int a = 0; a <= Order; ++a) {
        slope[static_cast<std::size_t>(4 * a)] = dN[a];
        director[static_cast<std::size_t>(4 * a + 1 + i)] = N[a];
      }
      c.rows.push_back(model::product_row(std::move(slope), std::move(director), q));
    }
  }
  return c;
}

template class KirchhoffBeam<1>;
template class KirchhoffBeam<2>;
template class KirchhoffBeam<3>;
template model::Constraint shear_free(const std::string&, const DirectorBeam<1>&,
                                      const std::array<int, 2>&, const DirectorBeam<1>::Nodes&);
template model::Constraint shear_free(const std::string&, const DirectorBeam<2>&,
                                      const std::array<int, 3>&, const DirectorBeam<2>::Nodes&);
template model::Constraint shear_free(const std::string&, const DirectorBeam<3>&,
                                      const std::array<int, 4>&, const DirectorBeam<3>::Nodes&);

}  // namespace culm::beam
