#include <culm/model/projection.hpp>
#include <culm/model/redundancy.hpp>

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>
#include <Eigen/SparseQR>

#include <algorithm>

namespace culm::model {
namespace {

using Sparse = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;

// dh/dq of a row for the slots of one node, shape (12)
Vec<12> slot_gradient(const ConstraintRow& row, std::size_t node, const Vec3& P, const Vec3& Q) {
  Vec<12> gradient;
  for (std::size_t s = 0; s < 4; ++s) {
    Vec3 g = row.alpha[4 * node + s] * Q;
    if (!row.linear()) g += row.beta[4 * node + s] * P;
    gradient.segment<3>(3 * static_cast<int>(s)) = g;
  }
  return gradient;
}

Vec3 sum(const SlotSum& factors, const std::vector<int>& nodes, const NodeTable& table) {
  Vec3 result = Vec3::Zero();
  for (std::size_t s = 0; s < factors.size(); ++s) {
    result += factors[s] * NodeTable::slots(table.reference(), nodes[s / 4]).col(s % 4);
  }
  return result;
}

// (H P)^T in the reference: one column per row of the constraints, scaled to unit length.
Sparse reduced_gradients(const NodeTable& table, const std::vector<Constraint>& equations) {
  std::vector<Eigen::Triplet<double>> entries;
  int column = 0;
  for (const Constraint& c : equations) {
    for (const ConstraintRow& row : c.rows) {
      const Vec3 P = sum(row.alpha, c.nodes, table);
      const Vec3 Q =
          row.linear() ? row.direction : Vec3(row.direction + sum(row.beta, c.nodes, table));
      for (std::size_t a = 0; a < c.nodes.size(); ++a) {
        const int master = table.master(c.nodes[a]);
        RowMat<6, 1> reduced;
        NullSpace::reduce_rows(slot_gradient(row, a, P, Q),
                               arms_of(table, c.nodes[a], table.reference()), reduced);
        for (int i = 0; i < 6; ++i) {
          if (reduced[i] != 0.0 && !table.fixed(master)[static_cast<std::size_t>(i)]) {
            entries.emplace_back(6 * master + i, column, reduced[i]);
          }
        }
      }
      ++column;
    }
  }
  Sparse gradients(6 * table.size(), column);
  gradients.setFromTriplets(entries.begin(), entries.end());
  for (int k = 0; k < column; ++k) {
    const double length = gradients.col(k).norm();
    if (length > 0.0) gradients.col(k) /= length;
  }
  return gradients;
}

// Numbers of the columns that others span.
std::vector<int> dependent_columns(Sparse gradients) {
  gradients.makeCompressed();
  Eigen::SparseQR<Sparse, Eigen::COLAMDOrdering<int>> qr;
  qr.setPivotThreshold(1e-10);
  qr.compute(gradients);
  std::vector<int> dependent;
  const auto order = qr.colsPermutation().indices();
  for (int k = static_cast<int>(qr.rank()); k < gradients.cols(); ++k)
    dependent.push_back(order[k]);
  return dependent;
}

}  // namespace

std::vector<std::string> remove_redundant_rows(const NodeTable& nodes,
                                               std::vector<Constraint>& equations) {
  if (equations.empty()) return {};
  const std::vector<int> dependent = dependent_columns(reduced_gradients(nodes, equations));
  std::vector<std::string> notes;
  int column = 0;
  for (Constraint& c : equations) {
    std::vector<ConstraintRow> kept;
    const std::size_t all = c.rows.size();
    // a driven constraint finds its rows by their place; redundant ones are left to the diagnosis
    for (ConstraintRow& row : c.rows) {
      const bool is_dependent =
          !c.drive && std::find(dependent.begin(), dependent.end(), column) != dependent.end();
      ++column;
      if (!is_dependent) kept.push_back(std::move(row));
    }
    c.rows = std::move(kept);
    if (c.rows.size() == all) continue;
    notes.push_back(c.type + " '" + c.name + "': " + std::to_string(all - c.rows.size()) + " of " +
                    std::to_string(all) +
                    " equations follow from other constraints and are left out; its reactions are "
                    "not unique");
  }
  std::erase_if(equations, [](const Constraint& c) { return c.rows.empty(); });
  return notes;
}

}  // namespace culm::model
