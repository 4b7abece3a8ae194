#include <culm/beam/linear_beam.hpp>

#include <Eigen/Geometry>

#include <algorithm>

namespace culm::beam {
namespace {

// Strains see directors by the turn of their triad, theta = 1/2 sum_i D_i x d_i, alone: what
// directors of unit length lose along themselves as they turn is of second order, and would act on
// normal forces as a geometric stiffness of the wrong sign.
template <class Rows, class Triad>
void see_turns_only(const Triad& triad, Rows&& directors) {
  for (Eigen::Index strain = 0; strain < directors.cols(); ++strain) {
    Vec3 moment = Vec3::Zero();
    for (int i = 0; i < 3; ++i) {
      const Vec3 D = triad.col(i);
      const Vec3 B = directors.col(strain).template segment<3>(3 * i);
      moment += D.cross(B);
    }
    for (int i = 0; i < 3; ++i) {
      const Vec3 D = triad.col(i);
      directors.col(strain).template segment<3>(3 * i) = 0.5 * moment.cross(D);
    }
  }
}

}  // namespace

template <int Order>
LinearBeam<Order>::LinearBeam(const Base& base, const Nodes& reference)
    : base_(base), reference_(in_frame(reference)) {
  const Mat3 frame = reference.template middleCols<3>(1);
  const typename Base::Nodes beam = reference.template rightCols<beam_slots>();
  for (int p = 0; p < num_points; ++p) {
    auto& B = gradient_[static_cast<std::size_t>(p)];
    base.gradient(p, beam, B);
    for (int s = 0; s < beam_slots; ++s) {
      B.template middleRows<3>(3 * s) =
          (frame.transpose() * B.template middleRows<3>(3 * s)).eval();
    }
    for (int s = 0; s < beam_slots; s += 4) {
      see_turns_only(reference_.template middleCols<3>(s + 1), B.template middleRows<9>(3 * s + 3));
    }
  }
}

// R^T (x - x0) of places, R^T d of directors
template <int Order>
typename LinearBeam<Order>::Local LinearBeam<Order>::in_frame(const Nodes& q) noexcept {
  Local v = q.template rightCols<beam_slots>();
  for (int s = 0; s < beam_slots; s += 4) v.col(s) -= q.col(0);
  return q.template middleCols<3>(1).transpose() * v;
}

template <int Order>
void LinearBeam<Order>::strain(int point, const Nodes& q, Strain& e) const noexcept {
  const Local local = in_frame(q) - reference_;
  const Eigen::Map<const Vec<3 * beam_slots>> v(local.data());
  e.noalias() = gradient_[static_cast<std::size_t>(point)].transpose() * v;
}

// ∂y/∂v = R B0 for v = x - x0 and d;   ∂y/∂d_i of the frame = sum_s v_s (row i of B0 of slot s)
template <int Order>
void LinearBeam<Order>::gradient(int point, const Nodes& q,
                                 Gradient<num_slots, num_strains>& B) const noexcept {
  const auto& B0 = gradient_[static_cast<std::size_t>(point)];
  const Mat3 frame = q.template middleCols<3>(1);
  B.template topRows<12>().setZero();
  for (int s = 0; s < beam_slots; ++s) {
    const auto block = B0.template middleRows<3>(3 * s);
    const RowMat<3, num_strains> turned = frame * block;
    B.template middleRows<3>(12 + 3 * s) = turned;
    Vec3 v = q.col(4 + s);
    if (is_place(s)) {
      v -= q.col(0);
      B.template topRows<3>() -= turned;
    }
    for (int i = 0; i < 3; ++i) B.template middleRows<3>(3 + 3 * i) += v * block.row(i);
  }
}

template <int Order>
void LinearBeam<Order>::add_curvature(int point, const Strain& S,
                                      SlotMatrix<num_slots>& A) const noexcept {
  const auto& B0 = gradient_[static_cast<std::size_t>(point)];
  for (int s = 0; s < beam_slots; ++s) {
    const Vec3 weights = B0.template middleRows<3>(3 * s) * S;
    for (int i = 0; i < 3; ++i) {
      A(1 + i, 4 + s) += weights[i];
      A(4 + s, 1 + i) += weights[i];
      if (!is_place(s)) continue;
      A(1 + i, 0) -= weights[i];
      A(0, 1 + i) -= weights[i];
    }
  }
}

template <int Order>
SlotMatrix<LinearBeam<Order>::num_slots> LinearBeam<Order>::mass() const noexcept {
  SlotMatrix<num_slots> M = SlotMatrix<num_slots>::Zero();
  M.template bottomRightCorner<beam_slots, beam_slots>() = base_.mass();
  return M;
}

template class LinearBeam<1>;
template class LinearBeam<2>;
template class LinearBeam<3>;

}  // namespace culm::beam
