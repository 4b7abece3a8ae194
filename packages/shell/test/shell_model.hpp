/// A few shell elements put together and solved, without batches: for tests of elements.
#pragma once

#include <culm/mechanics/internal_variables.hpp>
#include <culm/shell/shell_forms.hpp>

#include <Eigen/Geometry>
#include <Eigen/Sparse>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseLU>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>
#include <vector>

namespace culm::shell {

/// Nodes with their directors; two columns x, d per node.
using NodeColumns = Eigen::Matrix3Xd;

template <class E>
class ShellModel {
 public:
  explicit ShellModel(const NodeColumns& nodes)
      : reference(nodes), q(nodes), force(NodeColumns::Zero(3, nodes.cols())) {}

  void add(E element, const std::array<int, 4>& nodes) {
    elements.push_back(std::move(element));
    connectivity.push_back(nodes);
    internals_.emplace_back();
    internals_prev_.emplace_back();
    predicted_.emplace_back();
    if constexpr (ElementWithInternals<E>) {
      internals_.back().setZero();
      internals_prev_.back().setZero();
    }
  }
  /// Nodes of an element, out of all columns.
  static ShellForms::Nodes gather(const NodeColumns& all, const std::array<int, 4>& nodes) {
    ShellForms::Nodes slots;
    for (int a = 0; a < 4; ++a) {
      slots.middleCols<2>(2 * a) = all.middleCols<2>(2 * nodes[static_cast<std::size_t>(a)]);
    }
    return slots;
  }
  /// Holds a component of a slot (0 position, 1 director) where it is in `q`.
  void hold(int node, int slot, int component) { held_.insert(6 * node + 3 * slot + component); }
  void hold(int node, int slot) {
    for (int c = 0; c < 3; ++c) hold(node, slot, c);
  }
  void hold(int node) {
    hold(node, 0);
    hold(node, 1);
  }

  /// Static equilibrium under `force`, in equal steps. @return iterations in all; 0 if it failed
  int solve(int steps = 1, int most_iterations = 50) {
    const NodeColumns full = force;
    int iterations = 0;
    for (int step = 1; step <= steps; ++step) {
      force = full * step / steps;
      const int used = newton(Stencil::statics(), most_iterations);
      if (used == 0) return 0;
      iterations += used;
      internals_prev_ = internals_;
    }
    return iterations;
  }

  /// The linear answer to `force` and to what is held away from the reference.
  void solve_linear() {
    const NodeColumns held_at = q;
    const NodeColumns full = force;
    q = reference;
    assemble(Stencil::statics(), true, true);
    // residual of the held displacements, through the matrix of all components
    const Eigen::Map<const Eigen::VectorXd> u(held_at.data(), held_at.size());
    const Eigen::Map<const Eigen::VectorXd> u0(reference.data(), reference.size());
    Eigen::VectorXd shift = u - u0;
    for (Eigen::Index i = 0; i < shift.size(); ++i) {
      if (!held_.contains(static_cast<int>(i))) shift[i] = 0.0;
    }
    residual_ += tangent_ * shift;
    const Eigen::VectorXd free = solve_free();
    Eigen::Map<Eigen::VectorXd>(q.data(), q.size()) = u0 + shift + free;
  }

  /// Work 1/2 u . K u of the linear problem, at the displacements that are there now.
  double linear_energy() {
    const NodeColumns now = q;
    q = reference;
    assemble(Stencil::statics(), true, true);
    q = now;
    const NodeColumns moved = q - reference;
    const Eigen::Map<const Eigen::VectorXd> u(moved.data(), moved.size());
    return 0.5 * u.dot(tangent_ * u);
  }

  /// One energy-conserving step of a model that is free, or held at rest.
  bool advance(double h) {
    if (velocity.size() == 0) velocity = NodeColumns::Zero(3, q.cols());
    q_prev_ = q;
    q += h * velocity;
    const Stencil stencil = Stencil::midpoint(h);
    if (newton(stencil, 30) == 0) return false;
    velocity = 2.0 / h * (q - q_prev_) - velocity;
    internals_prev_ = internals_;
    return true;
  }

  /// Whether the tangent at rest in `q` is positive definite on all that is not held.
  bool is_stable() {
    if (assemble(Stencil::statics(), true, true) != Verdict::ok) return false;
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(moving_tangent());
    return factor.info() == Eigen::Success && factor.vectorD().minCoeff() > 0.0;
  }

  double stored_energy() const {
    double energy = 0.0;
    for (std::size_t e = 0; e < elements.size(); ++e) {
      ShellForms::Strain y;
      elements[e].strain(0, gather(q, connectivity[e]), y);
      if constexpr (ElementWithInternals<E>) {
        energy += elements[e].energy(0, y, internals_[e]);
      } else {
        energy += elements[e].energy(0, y);
      }
    }
    return energy;
  }

  struct Motion {
    double kinetic = 0.0;
    Vec3 linear = Vec3::Zero();
    Vec3 angular = Vec3::Zero();
  };
  Motion motion() const {
    Motion sum;
    for (std::size_t e = 0; e < elements.size(); ++e) {
      const ShellForms::Nodes v = gather(velocity, connectivity[e]);
      const ShellForms::Nodes at = gather(q, connectivity[e]);
      const ShellForms::Nodes p = v * elements[e].mass();
      sum.kinetic += 0.5 * (v.array() * p.array()).sum();
      for (int s = 0; s < 8; ++s) {
        if (s % 2 == 0) sum.linear += p.col(s);
        sum.angular += at.col(s).cross(p.col(s));
      }
    }
    return sum;
  }

  /// Forces that the elements and `force` leave on a held component.
  Vec3 reaction(int node) const { return Eigen::Map<const Vec3>(residual_.data() + 6 * node); }

  const auto& internals(std::size_t element) const { return internals_[element]; }

  NodeColumns reference, q, force, velocity;
  std::vector<E> elements;
  std::vector<std::array<int, 4>> connectivity;

 private:
  struct None {};
  template <class T>
  struct InternalsOf {
    using type = None;
  };
  template <ElementWithInternals T>
  struct InternalsOf<T> {
    using type = typename T::Internals;
  };
  using Internals = typename InternalsOf<E>::type;
  using Response28 = Response<ShellForms::num_strains>;

  Verdict respond(std::size_t e, const ShellForms::Strain& prev, const ShellForms::Strain& next,
                  const Stencil& stencil, Response28& response) {
    if constexpr (ElementWithInternals<E>) {
      return elements[e].respond(0, prev, next, internals_prev_[e], stencil, internals_[e],
                                 response);
    } else {
      return elements[e].respond(0, prev, next, stencil, response);
    }
  }

  Verdict assemble(const Stencil& stencil, bool with_tangent, bool first) {
    const auto size = static_cast<Eigen::Index>(q.size());
    residual_ = -Eigen::Map<const Eigen::VectorXd>(force.data(), size);
    force_scale_ = residual_.lpNorm<Eigen::Infinity>();
    std::vector<Eigen::Triplet<double>> triplets;
    Response28 response;
    ShellForms::Strain y;
    ShellForms::Strain y_prev = ShellForms::Strain::Zero();
    for (std::size_t e = 0; e < elements.size(); ++e) {
      const E& element = elements[e];
      const ShellForms::Nodes next = gather(q, connectivity[e]);
      ShellForms::Nodes mid = next;
      ShellForms::Nodes f = ShellForms::Nodes::Zero();
      element.strain(0, next, y);
      if (stencil.theta != 1.0) {
        const ShellForms::Nodes prev = gather(q_prev_, connectivity[e]);
        mid = 0.5 * (prev + next);
        element.strain(0, prev, y_prev);
        f += (stencil.inertia * (next - prev) -
              2.0 / stencil.step * gather(velocity, connectivity[e])) *
             element.mass();
      }
      const Verdict verdict = respond(e, y_prev, y, stencil, response);
      if (verdict != Verdict::ok) return verdict;
      E::add_force(mid, response.stress, f);
      force_scale_ = std::max(force_scale_, f.cwiseAbs().maxCoeff());
      const auto& nodes = connectivity[e];
      const auto row = [&](int i) { return 6 * nodes[static_cast<std::size_t>(i / 6)] + i % 6; };
      for (int i = 0; i < 24; ++i) residual_[row(i)] += f.data()[i];
      if (!with_tangent) continue;
      RowMat<24, 24> K = RowMat<24, 24>::Zero();
      E::add_stiffness(mid, next, response.tangent, 1.0, K);
      SlotMatrix<8> A = SlotMatrix<8>::Zero();
      const bool predict = !first && stencil.theta == 1.0;
      element.add_curvature(0, predict ? predicted_[e] : response.stress, A);
      A = stencil.theta * A + stencil.inertia * element.mass();
      for (int i = 0; i < 24; ++i) {
        for (int j = 0; j < 24; ++j) {
          const double curvature = i % 3 == j % 3 ? A(i / 3, j / 3) : 0.0;
          triplets.emplace_back(row(i), row(j), K(i, j) + curvature);
        }
      }
    }
    if (with_tangent) {
      tangent_.resize(size, size);
      tangent_.setFromTriplets(triplets.begin(), triplets.end());
    }
    return Verdict::ok;
  }

  // Mixed-integration-point Newton: in statics the curvature takes the stress that the linear
  // increment predicts.
  int newton(const Stencil& stencil, int most_iterations) {
    for (int iteration = 1; iteration <= most_iterations; ++iteration) {
      if (assemble(stencil, true, iteration == 1) != Verdict::ok) return 0;
      double largest = 0.0;
      for (Eigen::Index i = 0; i < residual_.size(); ++i) {
        if (!held_.contains(static_cast<int>(i))) {
          largest = std::max(largest, std::abs(residual_[i]));
        }
      }
      const Eigen::VectorXd u = solve_free();
      if (!u.allFinite()) return 0;
      if (stencil.theta == 1.0) predict(u);
      Eigen::Map<Eigen::VectorXd>(q.data(), q.size()) += u;
      // quadratic convergence: the increment that is small is the last one worth adding
      if (u.lpNorm<Eigen::Infinity>() < 1e-9 && largest < 1e-6 * force_scale_) {
        return assemble(stencil, false, true) == Verdict::ok ? iteration : 0;
      }
    }
    return 0;
  }

  void predict(const Eigen::VectorXd& u) {
    const Eigen::Map<const NodeColumns> du(u.data(), 3, q.cols());
    Response28 response;
    ShellForms::Strain y;
    Gradient<8, ShellForms::num_strains> B;
    for (std::size_t e = 0; e < elements.size(); ++e) {
      const ShellForms::Nodes at = gather(q, connectivity[e]);
      const ShellForms::Nodes moved = gather(du, connectivity[e]);
      elements[e].strain(0, at, y);
      elements[e].gradient(0, at, B);
      respond(e, y, y, Stencil::statics(), response);
      predicted_[e] = response.stress + response.tangent * (B.transpose() * moved.reshaped());
    }
  }

  /// Numbers of the components that are not held.
  Eigen::VectorXi moving() const {
    Eigen::VectorXi rows(q.size() - static_cast<Eigen::Index>(held_.size()));
    Eigen::Index next = 0;
    for (int i = 0; i < q.size(); ++i) {
      if (!held_.contains(i)) rows[next++] = i;
    }
    return rows;
  }

  Eigen::SparseMatrix<double> moving_tangent() const {
    const Eigen::VectorXi rows = moving();
    Eigen::VectorXi place = Eigen::VectorXi::Constant(q.size(), -1);
    for (int n = 0; n < rows.size(); ++n) place[rows[n]] = n;
    std::vector<Eigen::Triplet<double>> triplets;
    for (int column = 0; column < tangent_.outerSize(); ++column) {
      for (Eigen::SparseMatrix<double>::InnerIterator it(tangent_, column); it; ++it) {
        const int i = place[it.row()];
        const int j = place[column];
        if (i >= 0 && j >= 0) triplets.emplace_back(i, j, it.value());
      }
    }
    Eigen::SparseMatrix<double> K(rows.size(), rows.size());
    K.setFromTriplets(triplets.begin(), triplets.end());
    return K;
  }

  Eigen::VectorXd solve_free() const {
    const Eigen::VectorXi rows = moving();
    const Eigen::SparseLU<Eigen::SparseMatrix<double>> factor(moving_tangent());
    EXPECT_EQ(factor.info(), Eigen::Success);
    const Eigen::VectorXd u = factor.solve(-residual_(rows));
    Eigen::VectorXd all = Eigen::VectorXd::Zero(q.size());
    all(rows) = u;
    return all;
  }

  std::set<int> held_;
  std::vector<Internals> internals_, internals_prev_;
  std::vector<ShellForms::Strain> predicted_;
  NodeColumns q_prev_;
  Eigen::VectorXd residual_;
  double force_scale_ = 0.0;
  Eigen::SparseMatrix<double> tangent_;
};

}  // namespace culm::shell
