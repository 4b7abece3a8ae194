#include <culm/assembly/system.hpp>

#include "block_values.hpp"

#include <Eigen/Geometry>

#include <array>
#include <cmath>

namespace culm::assembly {
namespace {

// What acts on the unknowns of a node as force and moment; of a shell the last three act on its
// director, and do so by its arm.
Vec6 with_moment(const model::NodeTable& nodes, int node, const model::State& state,
                 const Vec6& unknowns) {
  if (nodes.turns(node)) return unknowns;
  Vec6 r = unknowns;
  const Vec3 director = model::NodeTable::slots(state.next, node).col(1);
  r.tail<3>() = director.cross(Vec3(unknowns.tail<3>()));
  return r;
}

}  // namespace

Vec6 System::reaction(int node, const model::State& state) const {
  const model::UnknownTable& unknowns = model_.unknowns();
  const model::BlockShape& shape = unknowns.block(unknowns.node_block(node)).shape;
  Vec6 reaction = Vec6::Zero();
  if (unknowns.form() == model::Form::null_space) {
    for (int i = 0; i < 6; ++i) {
      const int at = shape.position[index(i)];
      if (at < 0) reaction[i] = gathered_reactions_[index(shape.first_reaction - 1 - at)];
    }
  }
  return with_moment(model_.nodes(), node, state, reaction + equation_reaction("", node, state));
}

Vec6 System::reaction_of(const std::string& constraint, int node, const model::State& state) const {
  return with_moment(model_.nodes(), node, state, equation_reaction(constraint, node, state));
}

Vec6 System::equation_reaction(const std::string& constraint, int node,
                               const model::State& state) const {
  Vec6 reaction = Vec6::Zero();
  for (const auto& batch : model_.constraint_batches()) {
    reaction += batch->reaction(node, state, constraint);
  }
  for (const model::ReactionSource* source : reaction_sources_) {
    reaction += source->reaction(node, state, constraint);
  }
  return reaction;
}

double System::strain_energy(const model::Coordinates& q) const {
  double energy = 0.0;
  for (const auto& batch : model_.element_batches()) energy += batch->stored_energy(q);
  return comm_.sum(energy);
}

Energies System::energies(const model::Coordinates& q, double kinetic) const {
  double strain = 0.0, potential = 0.0, amount = 0.0;
  const auto add = [&](const model::Batch& batch, double& sum) {
    const double energy = batch.stored_energy(q);
    sum += energy;
    amount += std::abs(energy);
  };
  for (const auto& batch : model_.element_batches()) add(*batch, strain);
  for (const auto& load : model_.loads()) add(*load, potential);
  std::array<double, 3> sums = {strain, potential, amount};
  comm_.sum(sums);
  return {kinetic, sums[0], sums[1], std::abs(kinetic) + sums[2]};
}

double System::kinetic_energy(const model::Coordinates& velocity) const {
  double sum = 0.0;
  for (const model::MassSource* source : masses_) sum += source->kinetic_energy(velocity);
  return comm_.sum(sum);
}

model::Momentum System::momentum(const model::Coordinates& q,
                                 const model::Coordinates& velocity) const {
  model::Momentum total;
  for (const model::MassSource* source : masses_) source->add_momentum(q, velocity, total);
  Vec<7> sums;
  sums << total.kinetic_energy, total.linear, total.angular;
  comm_.sum(std::span(sums.data(), 7));
  return {sums[0], sums.segment<3>(1), sums.tail<3>()};
}

}  // namespace culm::assembly
