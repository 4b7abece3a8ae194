#include <culm/joint/axis_turn.hpp>
#include <culm/math/rotation.hpp>

#include <Eigen/LU>

namespace culm::joint {
namespace {

// sum_i ( |d_i|^2 1 - d_i d_i^T )^-1
Mat3 spread(const Mat3& d) {
  return (d.squaredNorm() * Mat3::Identity() - d * d.transpose()).inverse();
}

// n of the mean directors, and dn/d(nu_k d_k); zero for an axis in space.
struct StepAxis {
  Vec3 n;
  Mat3 derivative = Mat3::Zero();

  StepAxis(const TurnAxis& axis, const Mat3& mean) : n(axis.components) {
    if (!axis.follows) return;
    const Vec3 attached = mean * axis.components;
    n = attached.normalized();
    derivative = (Mat3::Identity() - n * n.transpose()) / attached.norm();
  }
};

// dd_k,next = [-d_k] dtheta, so d tau / d theta = 1 - [tau] / 2 + tau tau^T / 4
void differentiate(const TurnAxis& turn_axis, const StepAxis& axis, const Vec3& tau, const Mat3&,
                   const Mat3& next, double, AxisTurn<model::NullSpace>& turn) {
  const Mat3 dtau = Mat3::Identity() - 0.5 * skew(tau) + 0.25 * tau * tau.transpose();
  Mat3 dn = Mat3::Zero();
  if (turn_axis.follows) dn = -0.5 * axis.derivative * skew(next * turn_axis.components);
  turn.moment << Vec3::Zero(), axis.n;
  turn.gradient << Vec3::Zero(), dtau.transpose() * axis.n + dn.transpose() * tau;
  turn.derivative.setZero();
  turn.derivative.bottomRightCorner<3, 3>() = dn;
}

// dtau/dd_j = Ac^-1 ( [d_j,prev] - tau d_j^T + ( (d_j . tau) 1 + d_j tau^T ) / 2 ), d_j of the
// mean; moment on d_i: mh x d_i at theta, mh = Ac^-1 n
void differentiate(const TurnAxis& turn_axis, const StepAxis& axis, const Vec3& tau,
                   const Mat3& prev, const Mat3& next, double theta,
                   AxisTurn<model::FullSpace>& turn) {
  const Mat3 mean = 0.5 * (prev + next);
  const Mat3 d = (1.0 - theta) * prev + theta * next;
  const Mat3 mean_spread = spread(mean);
  const Mat3 theta_spread = spread(d);
  const Vec3 mh = theta_spread * axis.n;
  turn.moment.setZero();
  turn.gradient.setZero();
  turn.derivative.setZero();
  for (int j = 0; j < 3; ++j) {
    const Mat3 dn = turn_axis.follows ? Mat3(0.5 * turn_axis.components[j] * axis.derivative)
                                      : Mat3(Mat3::Zero());
    const Vec3 m = mean.col(j);
    Mat3 dtau = skew(prev.col(j)) - tau * m.transpose() + 0.5 * m * tau.transpose();
    dtau.diagonal().array() += 0.5 * m.dot(tau);
    turn.gradient.segment<3>(3 + 3 * j) =
        dtau.transpose() * (mean_spread * axis.n) + dn.transpose() * tau;

    Mat3 dmh = d.col(j) * mh.transpose() - 2.0 * mh * d.col(j).transpose();
    dmh.diagonal().array() += d.col(j).dot(mh);
    dmh = theta_spread * (theta * dmh + dn).eval();
    for (int i = 0; i < 3; ++i) {
      turn.derivative.block<3, 3>(3 + 3 * i, 3 + 3 * j) = -skew(d.col(i)) * dmh;
    }
    turn.derivative.block<3, 3>(3 + 3 * j, 3 + 3 * j) += theta * skew(mh);
    turn.moment.segment<3>(3 + 3 * j) = skew(mh) * d.col(j);
  }
}

}  // namespace

template <class Space>
AxisTurn<Space>::AxisTurn(const TurnAxis& turn_axis, const Mat3& prev, const Mat3& next,
                          double theta) {
  const StepAxis step_axis(turn_axis, 0.5 * (prev + next));
  const Vec3 tau = cayley_vector(prev, next);
  axis = step_axis.n;
  turn = axis.dot(tau);
  differentiate(turn_axis, step_axis, tau, prev, next, theta, *this);
}

template struct AxisTurn<model::NullSpace>;
template struct AxisTurn<model::FullSpace>;

}  // namespace culm::joint
