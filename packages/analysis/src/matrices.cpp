#include <culm/analysis/matrices.hpp>

#include "whole_matrix.hpp"

#include <fmt/format.h>

namespace culm::analysis {
namespace {

using assembly::Matrix;

// The entries that are not zero, of all ranks, on rank 0.
ReportMatrix gather(const std::string& name, const Matrix& matrix, const parallel::Comm& comm) {
  const Entries mine = entries_of(matrix);
  const auto size = static_cast<int>(matrix.rows().total());
  return {name,
          size,
          size,
          comm.gather(std::span<const int>(mine.row)),
          comm.gather(std::span<const int>(mine.column)),
          comm.gather(std::span<const double>(mine.value))};
}

// Number of each unknown among the motions and signals, or -1 - k for the k-th multiplier.
std::vector<int> split_unknowns(const model::Model& model) {
  const model::UnknownTable& unknowns = model.unknowns();
  std::vector<int> numbers(static_cast<std::size_t>(unknowns.num_unknowns()));
  int motions = 0;
  int multipliers = 0;
  for (const model::Block& block : unknowns.blocks()) {
    for (int i = 0; i < block.shape.active; ++i) {
      // supports take nothing away from blocks of multipliers
      numbers[static_cast<std::size_t>(block.first + i)] =
          model.is_force(block, i) ? -1 - multipliers++ : motions++;
    }
  }
  return numbers;
}

// The part of a bordered matrix between motions, or the rows of multipliers without their scale.
ReportMatrix part(const std::string& name, const ReportMatrix& all, const std::vector<int>& numbers,
                  bool border, double scale) {
  ReportMatrix result;
  result.name = name;
  for (int number : numbers) (number < 0 ? result.rows : result.columns) += 1;
  if (!border) result.rows = result.columns;
  for (std::size_t k = 0; k < all.value.size(); ++k) {
    const int row = numbers[static_cast<std::size_t>(all.row[k])];
    const int column = numbers[static_cast<std::size_t>(all.column[k])];
    if (column < 0 || (row < 0) != border) continue;
    result.row.push_back(border ? -1 - row : row);
    result.column.push_back(column);
    result.value.push_back(all.value[k] / scale);
  }
  return result;
}

ReportMatrix null_space_basis(const model::Model& model, const model::State& state,
                              const std::vector<int>& numbers) {
  const model::UnknownTable& unknowns = model.unknowns();
  const model::NodeTable& nodes = model.nodes();
  ReportMatrix basis;
  basis.name = "null_space_basis";
  basis.rows = 12 * nodes.size();
  for (int number : numbers) basis.columns += number >= 0;
  const bool null_space = unknowns.form() == model::Form::null_space;
  model::Coordinates motion(state.next.size(), 0.0);
  for (int node = 0; node < nodes.size(); ++node) {
    const int master = null_space ? nodes.master(node) : node;
    const model::Block block = unknowns.block(unknowns.node_block(master));
    for (int i = 0; i < block.shape.width; ++i) {
      const int at = block.shape.position[static_cast<std::size_t>(i)];
      if (at < 0) continue;
      auto slots = model::NodeTable::slots(motion, master);
      if (null_space) {
        slots = nodes.slot_motion(master, Vec6(Vec6::Unit(i)), state.next);
      } else {
        slots.setZero();
        slots.data()[i] = 1.0;
      }
      if (nodes.is_slave(node)) nodes.follow_master(node, motion);
      const auto moved = model::NodeTable::slots(motion, node);
      for (int c = 0; c < 12; ++c) {
        if (moved.data()[c] == 0.0) continue;
        basis.row.push_back(12 * node + c);
        basis.column.push_back(numbers[static_cast<std::size_t>(block.first + at)]);
        basis.value.push_back(moved.data()[c]);
      }
      slots.setZero();
    }
  }
  return basis;
}

}  // namespace

Schema Matrices::schema() {
  return Schema(
      "Matrices",
      "Writes stiffness, mass, damping, the same of viscoelastic branches and delayed forces "
      "by relaxation time, constraint Jacobian and null-space basis about the present state, as "
      "MatrixMarket files and into run.h5.");
}

std::unique_ptr<Inspection> Matrices::make(const Options&) { return std::make_unique<Matrices>(); }

AnalysisReport Matrices::inspect(Context& context, model::State& state) {
  assembly::System& system = context.system;
  const Linearisation linear = linearise(context, state);
  system.synchronise(state);
  const std::vector<int> numbers = split_unknowns(system.model());
  AnalysisReport report;
  const auto add = [&](const std::string& name, const Matrix& matrix) {
    const ReportMatrix all = gather(name, matrix, system.comm());
    report.matrices.push_back(part(name, all, numbers, false, 1.0));
    return all;
  };
  const ReportMatrix stiffness = add("stiffness", *linear.stiffness);
  add("mass", *linear.mass);
  if (linear.damping) add("damping", *linear.damping);
  for (std::size_t k = 0; k < linear.branches.size(); ++k) {
    const std::string name = fmt::format("relaxation_{}", k + 1);
    add(name, *linear.branches[k].stiffness);
    if (linear.branches[k].damping) add(name + "_damping", *linear.branches[k].damping);
    report.text += fmt::format("{}: relaxation time {} s\n", name, linear.branches[k].time);
  }
  if (system.model().unknowns().num_forces() > 0) {
    report.matrices.push_back(
        part("constraint_jacobian", stiffness, numbers, true, system.multiplier_scale()));
  }
  report.matrices.push_back(null_space_basis(system.model(), state, numbers));
  for (const ReportMatrix& matrix : report.matrices) {
    report.text += fmt::format("{}: {} x {}, {} entries\n", matrix.name, matrix.rows,
                               matrix.columns, matrix.value.size());
  }
  return report;
}

}  // namespace culm::analysis
