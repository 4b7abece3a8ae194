#include <culm/beam/held_beam.hpp>
#include <culm/mechanics/linear_law.hpp>

namespace culm::beam {

template <int Order, int First, int Count>
HeldBeam<Order, First, Count>::HeldBeam(const Base& base) : base_(base) {
  for (int p = 0; p < num_points; ++p) {
    Mat6 C = base.stiffness(p);
    if (held.shear_and_extension) C = without_shear_and_extension(C);
    stiffness_[static_cast<std::size_t>(p)] = C.template block<Count, Count>(First, First);
  }
}

template <int Order, int First, int Count>
void HeldBeam<Order, First, Count>::strain(int point, const Nodes& q, Strain& e) const noexcept {
  Vec6 all;
  base_.strain(point, q, all);
  e = all.template segment<Count>(First);
}

template <int Order, int First, int Count>
void HeldBeam<Order, First, Count>::gradient(int point, const Nodes& q,
                                             Gradient<num_slots, num_strains>& B) const noexcept {
  Gradient<num_slots, 6> all;
  base_.gradient(point, q, all);
  B = all.template middleCols<Count>(First);
}

template <int Order, int First, int Count>
void HeldBeam<Order, First, Count>::add_curvature(int point, const Strain& S,
                                                  SlotMatrix<num_slots>& A) const noexcept {
  Vec6 all = Vec6::Zero();
  all.template segment<Count>(First) = S;
  base_.add_curvature(point, all, A);
}

template <int Order, int First, int Count>
Verdict HeldBeam<Order, First, Count>::respond(int point, const Strain& prev, const Strain& next,
                                               const Stencil& stencil,
                                               Response<num_strains>& response) const noexcept {
  LinearLaw<Count>{stiffness(point)}.respond(prev, next, stencil, response);
  return Verdict::ok;
}

template <int Order, int First, int Count>
double HeldBeam<Order, First, Count>::energy(int point, const Strain& e) const noexcept {
  return LinearLaw<Count>{stiffness(point)}.energy(e);
}

template <int Order, int First, int Count>
typename HeldBeam<Order, First, Count>::Strain HeldBeam<Order, First, Count>::resultants(
    int point, const Strain& e) const noexcept {
  return stiffness(point) * e / base_.length(point);
}

template class HeldBeam<1, 3, 3>;
template class HeldBeam<2, 3, 3>;
template class HeldBeam<3, 3, 3>;
template class HeldBeam<1, 0, 5>;
template class HeldBeam<2, 0, 5>;
template class HeldBeam<3, 0, 5>;
template class HeldBeam<1, 3, 2>;
template class HeldBeam<2, 3, 2>;
template class HeldBeam<3, 3, 2>;

}  // namespace culm::beam
