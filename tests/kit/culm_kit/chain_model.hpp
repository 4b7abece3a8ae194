/// A small model without deck or beams: a chain of nodes tied by stretch and turn springs, for
/// tests of assembly, solver and analysis.
#pragma once

#include <culm/mechanics/linear_law.hpp>
#include <culm/model/element_batch.hpp>
#include <culm/model/model.hpp>

#include <cmath>

namespace culm::kit {

/// Two nodes with the forms (d_i,1 + d_i,2) . (x2 - x1) / 2 and d_i,1 . d_j,2, stress-free in the
/// reference: every motion but a rigid one is resisted.
class SpringLink {
 public:
  static constexpr NodeKind node_kind = NodeKind::node12;
  static constexpr int num_nodes = 2;
  static constexpr int num_slots = 8;
  static constexpr int num_points = 1;
  static constexpr int num_strains = 6;
  static constexpr int num_resultants = 6;
  using Nodes = Slots<num_slots>;

  SpringLink(const Nodes& reference, double stiffness) {
    strain(0, reference, offset_);
    law_.C = stiffness * RowMat<6, 6>::Identity();
  }

  void strain(int, const Nodes& q, Vec6& y) const noexcept {
    const Vec3 chord = q.col(4) - q.col(0);
    for (int i = 0; i < 3; ++i) {
      y[i] = 0.5 * (q.col(1 + i) + q.col(5 + i)).dot(chord) - offset_[i];
      y[3 + i] = q.col(1 + i).dot(q.col(5 + (i + 1) % 3)) - offset_[3 + i];
    }
  }
  void gradient(int, const Nodes& q, Gradient<8, 6>& B) const noexcept {
    B.setZero();
    const Vec3 chord = q.col(4) - q.col(0);
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3;
      const Vec3 mean = 0.5 * (q.col(1 + i) + q.col(5 + i));
      B.block<3, 1>(0, i) = -mean;
      B.block<3, 1>(12, i) = mean;
      B.block<3, 1>(3 + 3 * i, i) = 0.5 * chord;
      B.block<3, 1>(15 + 3 * i, i) = 0.5 * chord;
      B.block<3, 1>(3 + 3 * i, 3 + i) = q.col(5 + j);
      B.block<3, 1>(15 + 3 * j, 3 + i) = q.col(1 + i);
    }
  }
  void add_curvature(int, const Vec6& S, SlotMatrix<8>& A) const noexcept {
    const auto add = [&A](int s, int t, double value) {
      A(s, t) += value;
      A(t, s) += value;
    };
    for (int i = 0; i < 3; ++i) {
      for (int director : {1 + i, 5 + i}) {
        add(0, director, -0.5 * S[i]);
        add(4, director, 0.5 * S[i]);
      }
      add(1 + i, 5 + (i + 1) % 3, S[3 + i]);
    }
  }
  Verdict respond(int, const Vec6& prev, const Vec6& next, const Stencil& stencil,
                  Response<6>& response) const noexcept {
    law_.respond(prev, next, stencil, response);
    return Verdict::ok;
  }
  double energy(int, const Vec6& y) const noexcept { return law_.energy(y); }
  SlotMatrix<8> mass() const noexcept { return SlotMatrix<8>::Identity(); }
  Vec6 resultants(int, const Vec6& y) const noexcept { return law_.C * y; }
  static constexpr std::array<const char*, 6> resultant_names() {
    return {"a", "b", "c", "d", "e", "f"};
  }

 private:
  Vec6 offset_ = Vec6::Zero();
  LinearLaw<6> law_;
};

static_assert(Element<SpringLink>);

/// Fills a model with `links` springs in a row along a gentle helix, held at its first node.
inline void add_chain(model::Model& model, int links, double stiffness = 100.0) {
  model::Structure& structure = model.add_structure("chain");
  auto& batch = model::elements<SpringLink>(model, "Spring link");
  for (int i = 0; i <= links; ++i) {
    model::NodeSlots slots = model::NodeSlots::Zero();
    slots.col(0) = Vec3(i, std::sin(0.3 * i), 0.1 * i);
    slots.rightCols<3>().setIdentity();
    structure.nodes.push_back(model.nodes().add(slots));
  }
  for (int i = 0; i < links; ++i) {
    Slots<8> reference;
    reference << model::NodeTable::slots(model.nodes().reference(), i),
        model::NodeTable::slots(model.nodes().reference(), i + 1);
    structure.cells.push_back(
        {{i, i + 1}, &batch, batch.add(SpringLink(reference, stiffness), {i, i + 1})});
  }
}

/// Holds a node completely: twelve rows, or no unknowns.
inline model::Constraint clamp(const model::Model& model, int node) {
  model::Constraint c;
  c.name = "clamp";
  c.type = "Rigid Support";
  c.nodes = {node};
  c.fix = model::Constraint::Fix{node, std::bitset<6>("111111")};
  c.replaces_internal = node;
  const Eigen::Matrix3Xd q = model::NodeTable::slots(model.nodes().reference(), node);
  for (int s = 0; s < 4; ++s) {
    model::SlotSum alpha(4, 0.0);
    alpha[static_cast<std::size_t>(s)] = 1.0;
    for (int i = 0; i < 3; ++i) c.rows.push_back(model::linear_row(Vec3::Unit(i), alpha, q));
  }
  return c;
}

/// Holds the position of a node: three rows, or no translations.
inline model::Constraint pin(const model::Model& model, int node) {
  model::Constraint c;
  c.name = "pin";
  c.type = "Spherical Support";
  c.nodes = {node};
  c.fix = model::Constraint::Fix{node, std::bitset<6>("000111")};
  const Eigen::Matrix3Xd q = model::NodeTable::slots(model.nodes().reference(), node);
  for (int i = 0; i < 3; ++i) {
    c.rows.push_back(model::linear_row(Vec3::Unit(i), {1.0, 0.0, 0.0, 0.0}, q));
  }
  return c;
}

}  // namespace culm::kit
