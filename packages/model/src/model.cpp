#include <culm/base/error.hpp>
#include <culm/base/text.hpp>
#include <culm/math/rotation.hpp>
#include <culm/model/model.hpp>
#include <culm/model/redundancy.hpp>

#include "repeated_supports.hpp"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>

namespace culm::model {

Model::Model() = default;
Model::~Model() = default;

Structure& Model::add_structure(std::string name) {
  Structure& structure = structures_.emplace_back();
  structure_by_name_.emplace(name, &structure);
  structure.name = std::move(name);
  return structure;
}

void Model::add_element_batch(std::unique_ptr<Batch> batch) {
  element_batches_.push_back(std::move(batch));
}

void Model::add_initial_velocity(const InitialVelocity& velocity) {
  initial_velocities_.push_back(velocity);
}

void Model::add_initial_displacement(const InitialDisplacement& displacement) {
  initial_displacements_.push_back(displacement);
}

void Model::add_node_set(const std::string& name, std::vector<int> nodes) {
  node_sets_[name] = std::move(nodes);
}

void Model::add_constraint(Constraint constraint) { constraints_.push_back(std::move(constraint)); }

void Model::add_load(std::unique_ptr<Batch> load) { loads_.push_back(std::move(load)); }

void Model::add_input(const std::string& name, std::unique_ptr<NodalInput> input) {
  inputs_.emplace(name, std::move(input));
}

void Model::add_setting(const std::string& name, const Signal& signal) {
  settings_.emplace(name, signal);
}

void Model::add_function(const std::string& name, const Amplitude& function) {
  functions_.emplace(name, function);
}

void Model::add_variation(const std::string& name, const Amplitude& variation) {
  variations_.emplace(name, variation);
}

MassBatch& Model::masses(const Effect& effect) {
  for (const auto& batch : element_batches_) {
    auto* same = dynamic_cast<MassBatch*>(batch.get());
    if (same != nullptr && same->effect() == effect) return *same;
  }
  auto batch = std::make_unique<MassBatch>(effect, nodes_);
  MassBatch& result = *batch;
  element_batches_.push_back(std::move(batch));
  return result;
}

void Model::add_initial_velocities(const Coordinates& q, Coordinates& velocity) const {
  for (const InitialVelocity& initial : initial_velocities_) {
    const auto slots = NodeTable::slots(q, initial.node);
    auto v = NodeTable::slots(velocity, initial.node);
    v.col(0) += initial.velocity + initial.omega.cross(Vec3(slots.col(0) - initial.about));
    for (int i = 1; i < 4; ++i) v.col(i) += initial.omega.cross(Vec3(slots.col(i)));
  }
}

void Model::add_rigid_link(std::string name, int slave, int master) {
  Constraint c;
  c.name = std::move(name);
  c.type = "Rigid Connection";
  c.nodes = {master, slave};
  c.link = Constraint::Link{slave, master};
  c.replaces_internal = slave;
  c.is_internal = true;
  Eigen::Matrix3Xd q(3, 8);
  q << NodeTable::slots(nodes_.reference(), master), NodeTable::slots(nodes_.reference(), slave);
  const bool directors = nodes_.kind(master) == NodeKind::node12;
  const Mat3 triad = q.block<3, 3>(0, 1);
  // x_2 - p_1(phi) and d_i,2 - u_1(R_i); between shell nodes x_2 - x_1 and d_2 - d_1: linear rows
  for (int i = 0; i < slots_of(nodes_.kind(slave)); ++i) {
    Vec3 components = i == 0 ? Vec3(Vec3::Zero()) : Vec3(Vec3::UnitX());
    if (directors) {
      components = triad.transpose() * (i == 0 ? Vec3(q.col(4) - q.col(0)) : q.col(4 + i));
    }
    SlotSum on_master =
        i == 0 ? attached_point(0, 2, components) : attached_vector(0, 2, components);
    for (double& factor : on_master) factor = -factor;
    on_master[static_cast<std::size_t>(4 + i)] = 1.0;
    for (int axis = 0; axis < 3; ++axis) {
      c.rows.push_back(linear_row(Vec3::Unit(axis), on_master, q));
    }
  }
  add_constraint(std::move(c));
}

bool Model::eliminate(const Constraint& constraint) {
  if (constraint.link) return nodes_.link(constraint.link->slave, constraint.link->master);
  if (!constraint.fix) return false;
  const int node = constraint.fix->node;
  // followers of a triad have a lever, so the rows of partly held ones stay equations
  const bool has_lever = nodes_.is_slave(node) && nodes_.turns(node);
  if (has_lever && !constraint.fix->unknowns.all()) return false;
  nodes_.fix(nodes_.master(node), constraint.fix->unknowns);
  return true;
}

int Model::add_own_block(OwnBlock block) {
  internal_check(!block.unknowns.empty() && block.unknowns.size() <= 12,
                 "a block of own unknowns is empty or too large");
  if (!own_blocks_.empty()) {
    block.first = own_blocks_.back().first + static_cast<int>(own_blocks_.back().unknowns.size());
  }
  own_blocks_.push_back(std::move(block));
  return static_cast<int>(own_blocks_.size()) - 1;
}

Signal Model::signal(int block, int place) const {
  const OwnBlock& own = own_blocks_[static_cast<std::size_t>(block)];
  const OwnUnknown& unknown = own.unknowns[static_cast<std::size_t>(place)];
  return {block, place, own.first + place, unknown.kind, unknown.scale};
}

bool Model::is_force(const Block& block, int i) const {
  if (block.kind != BlockKind::own) return block.kind == BlockKind::multipliers;
  const OwnBlock& own = own_blocks_[static_cast<std::size_t>(block.owner)];
  return own.unknowns[static_cast<std::size_t>(i)].kind == UnknownKind::multiplier;
}

void Model::set_initial(const Signal& signal, double value) {
  own_blocks_[static_cast<std::size_t>(signal.block)]
      .unknowns[static_cast<std::size_t>(signal.place)]
      .initial = value;
}

void Model::batch_equations(double length) {
  for (std::size_t number = 0; number < equations_.size(); ++number) {
    const Constraint& equation = equations_[number];
    const auto same = [&](const auto& batch) { return batch->effect() == equation.type; };
    auto at = std::find_if(constraint_batches_.begin(), constraint_batches_.end(), same);
    if (at == constraint_batches_.end()) {
      constraint_batches_.push_back(
          std::make_unique<ConstraintBatch>(equation.type, nodes_, length));
      at = constraint_batches_.end() - 1;
    }
    (*at)->add(equation, static_cast<int>(number));
  }
}

void Model::refuse_displaced_supports(double length) const {
  const Coordinates q = initial_configuration();
  InputIssues issues;
  for (const InitialDisplacement& displacement : initial_displacements_) {
    for (const Constraint& c : constraints_) {
      if (!c.fix && !c.link) continue;  // equations can be fulfilled by others
      if (std::find(c.nodes.begin(), c.nodes.end(), displacement.node) == c.nodes.end()) continue;
      double violation = 0.0;
      for (const ConstraintRow& row : c.rows) {
        violation = std::max(violation, std::abs(row_value(row, slots_of(c, q))));
      }
      if (violation <= 1e-9 * length) continue;
      issues.add(displacement.where, "takes '" + node_name(displacement.node) + "' out of " +
                                         c.type + " '" + c.name + "' by " +
                                         fmt::format("{:.3g}", violation));
    }
  }
  issues.throw_if_any();
}

namespace {

std::string quoted_name(const Constraint& c) { return c.type + " '" + c.name + "'"; }

// Notes name so many, and say how many more there are.
constexpr std::size_t most_named = 8;

// "a, b and c", without repetitions
std::string enumerate(const std::vector<std::string>& names) {
  std::vector<std::string> once;
  for (const std::string& name : names) {
    if (std::find(once.begin(), once.end(), name) == once.end()) once.push_back(name);
  }
  if (once.size() < 2) return join(once, "");
  if (once.size() > most_named) {
    const std::size_t more = once.size() - most_named;
    once.resize(most_named);
    return join(once, ", ") + " and " + std::to_string(more) + " more";
  }
  const std::string last = once.back();
  once.pop_back();
  return join(once, ", ") + " and " + last;
}

// Whether a constraint takes away unknowns of a node that another one holds as well.
bool removes_unknowns(const NodeTable& nodes, const Constraint& constraint, const Constraint& other,
                      int master) {
  if (constraint.fix) return nodes.master(constraint.fix->node) == master;
  // links matter where another one closes a loop with them
  return constraint.link && other.link && nodes.master(constraint.link->slave) == master;
}

// A drive finds the rows by their place among all.
void leave_out(const std::vector<bool>& rows, Constraint& constraint) {
  if (std::find(rows.begin(), rows.end(), true) == rows.end()) return;
  const auto keep = [rows](const std::vector<ConstraintRow>& all,
                           std::vector<ConstraintRow>& kept) {
    kept.clear();
    for (std::size_t r = 0; r < rows.size(); ++r) {
      if (!rows[r]) kept.push_back(all[r]);
    }
  };
  std::vector<ConstraintRow> all = constraint.rows;
  keep(all, constraint.rows);
  if (!constraint.drive) return;
  constraint.drive = [keep, all, drive = constraint.drive](
                         double time, std::vector<ConstraintRow>& kept) mutable {
    drive(time, all);
    keep(all, kept);
  };
}

}  // namespace

std::vector<std::string> Model::remove_redundant_equations(Form form) {
  const auto sets = find_redundant_rows(nodes_, equations_, form, initial_configuration());
  std::vector<std::string> notes;
  InputIssues issues;
  std::vector<std::vector<bool>> is_left_out;  // by equation and row
  for (const Constraint& c : equations_) is_left_out.emplace_back(c.rows.size(), false);
  for (const RedundantSet& set : sets) {
    std::vector<std::string> names;
    std::vector<std::string> bodies;
    std::vector<std::string> supports;  // that take the unknowns of these nodes away
    const Constraint* named = &equations_[static_cast<std::size_t>(set.members.front())];
    for (int member : set.members) {
      const Constraint& c = equations_[static_cast<std::size_t>(member)];
      names.push_back(quoted_name(c));
      if (c.is_driven() || !c.velocity_rows.empty()) named = &c;
      for (int node : c.nodes) {
        const Structure* structure = structure_of(node);
        bodies.push_back(structure == nullptr ? node_name(node) : "'" + structure->name + "'");
        for (const Constraint& other : constraints_) {
          if (form == Form::null_space && removes_unknowns(nodes_, other, c, nodes_.master(node))) {
            supports.push_back(quoted_name(other));
          }
        }
      }
    }
    names.insert(names.end(), supports.begin(), supports.end());
    if (set.kind == RedundantSet::Kind::structural) {
      std::string left_out;
      for (const RedundantSet::Row& row : set.dependent) {
        is_left_out[static_cast<std::size_t>(row.equation)][static_cast<std::size_t>(row.row)] =
            true;
      }
      notes.push_back(enumerate(names) + " hold motions of " + enumerate(bodies) +
                      " more than once: " + std::to_string(set.dependent.size()) +
                      (set.dependent.size() == 1 ? " equation follows" : " equations follow") +
                      " from the others and " + (set.dependent.size() == 1 ? "is" : "are") +
                      " left out; the reactions of these constraints are not unique");
    } else if (set.kind == RedundantSet::Kind::contradictory) {
      std::erase(names, quoted_name(*named));
      issues.add(named->where, "prescribes a motion of " + enumerate(bodies) +
                                   " that is held already" +
                                   (names.empty() ? "" : ", by " + enumerate(names)));
    } else {
      issues.add(named->where, "starts in a singular position of " + enumerate(bodies) +
                                   ": here, and only here, the equations of " + enumerate(names) +
                                   " depend on each other; start in another position");
    }
  }
  issues.throw_if_any();
  for (std::size_t e = 0; e < equations_.size(); ++e) leave_out(is_left_out[e], equations_[e]);
  std::erase_if(equations_, [](const Constraint& c) { return c.rows.empty(); });
  return notes;
}

std::vector<std::string> Model::freeze(Form form) {
  // links first: whether a support can be eliminated depends on them
  const auto is_link = [](const Constraint& c) { return c.link.has_value(); };
  std::vector<const Constraint*> ordered;
  for (const Constraint& c : constraints_) {
    if (is_link(c)) ordered.push_back(&c);
  }
  for (const Constraint& c : constraints_) {
    if (!is_link(c)) ordered.push_back(&c);
  }
  std::vector<bool> has_internal(static_cast<std::size_t>(nodes_.size()), true);
  NodeTable linked = nodes_;
  std::vector<const Constraint*> eliminated_supports;
  for (const Constraint* c : ordered) {
    if (form == Form::null_space && eliminate(*c)) {
      if (c->fix) eliminated_supports.push_back(c);
      continue;
    }
    equations_.push_back(*c);
    // in a loop of links somebody has to keep the directors
    const bool closes_loop = c->link && !linked.link(c->link->slave, c->link->master);
    if (closes_loop) equations_.back().replaces_internal = -1;
    const int replaced = equations_.back().replaces_internal;
    if (replaced >= 0) has_internal[static_cast<std::size_t>(replaced)] = false;
  }
  refuse_displaced_supports(length());
  std::vector<std::string> notes = notes_on_repeated_supports(*this, eliminated_supports);
  if (!keeps_redundant_rows_) {
    const std::vector<std::string> of_equations = remove_redundant_equations(form);
    notes.insert(notes.end(), of_equations.begin(), of_equations.end());
  }
  // their batches write them
  std::erase_if(equations_, [](const Constraint& c) { return !c.velocity_rows.empty(); });
  if (form == Form::multipliers) {
    for (int node = 0; node < nodes_.size(); ++node) {
      const bool has_triad = nodes_.kind(node) == NodeKind::node12;
      if (has_triad && has_internal[static_cast<std::size_t>(node)]) {
        equations_.push_back(internal_constraint(nodes_, node));
      }
    }
  }
  batch_equations(length());
  std::vector<int> multipliers;
  for (const Constraint& c : equations_) multipliers.push_back(static_cast<int>(c.rows.size()));
  unknowns_ = UnknownTable(nodes_, multipliers, own_blocks_, form);
  mass_ = mass();
  length_ = length();
  for (const auto& batch : constraint_batches_) batch->number(unknowns_);
  return notes;
}

std::vector<Batch*> Model::batches() const {
  std::vector<Batch*> result;
  for (const auto& batch : element_batches_) result.push_back(batch.get());
  for (const auto& batch : constraint_batches_) result.push_back(batch.get());
  for (const auto& batch : loads_) result.push_back(batch.get());
  return result;
}

Coordinates Model::mass_times(const Coordinates& acceleration) const {
  Coordinates force(acceleration.size(), 0.0);
  for (const auto& batch : element_batches_) {
    if (const auto* source = dynamic_cast<const MassSource*>(batch.get())) {
      source->add_mass_times(acceleration, force);
    }
  }
  return force;
}

double Model::mass() const {
  if (mass_) return *mass_;
  Coordinates unit(nodes_.reference().size(), 0.0);
  for (int node = 0; node < nodes_.size(); ++node) NodeTable::slots(unit, node)(0, 0) = 1.0;
  const Coordinates force = mass_times(unit);
  double total = 0.0;
  for (int node = 0; node < nodes_.size(); ++node) total += NodeTable::slots(force, node)(0, 0);
  return total;
}

double Model::length() const {
  if (length_) return *length_;
  Eigen::Array3d low = Eigen::Array3d::Constant(1e300);
  Eigen::Array3d high = -low;
  for (int node = 0; node < nodes_.size(); ++node) {
    const Eigen::Array3d x = NodeTable::slots(nodes_.reference(), node).col(0).array();
    low = low.min(x);
    high = high.max(x);
  }
  const double diagonal = nodes_.size() == 0 ? 0.0 : (high - low).matrix().norm();
  return diagonal > 0.0 ? diagonal : 1.0;
}

Coordinates Model::initial_configuration() const {
  Coordinates q = nodes_.reference();
  for (const InitialDisplacement& d : initial_displacements_) {
    auto slots = NodeTable::slots(q, d.node);
    const Mat3 turn = exp_rotation(d.rotation);
    slots.col(0) = d.about + turn * (slots.col(0) - d.about) + d.translation;
    slots.rightCols<3>() = (turn * slots.rightCols<3>()).eval();
  }
  return q;
}

State Model::initial_state() const {
  State state;
  state.prev = state.next = initial_configuration();
  state.velocity.assign(state.prev.size(), 0.0);
  state.multipliers.assign(static_cast<std::size_t>(unknowns_.num_multipliers()), 0.0);
  state.multipliers_prev = state.multipliers;
  for (const OwnBlock& block : own_blocks_) {
    for (const OwnUnknown& unknown : block.unknowns) state.own.push_back(unknown.initial);
  }
  state.own_prev = state.own;
  return state;
}

}  // namespace culm::model
