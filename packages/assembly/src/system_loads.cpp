#include <culm/assembly/system.hpp>

#include "block_values.hpp"

#include <Eigen/QR>

#include <algorithm>
#include <map>
#include <set>

namespace culm::assembly {
namespace {

// How h of a row changes with the slots of one of its nodes.
model::NodeSlots slot_gradient(const model::ConstraintRow& row, int place,
                               const Eigen::Matrix3Xd& q) {
  const auto size = static_cast<Eigen::Index>(row.alpha.size());
  const Eigen::Map<const Eigen::RowVectorXd> alpha(row.alpha.data(), size);
  const Eigen::RowVector4d own_alpha = alpha.segment<4>(4 * place);
  if (row.linear()) return row.direction * own_alpha;
  const Eigen::Map<const Eigen::RowVectorXd> beta(row.beta.data(), size);
  const Vec3 P = q * alpha.transpose();
  const Vec3 Q = row.direction + q * beta.transpose();
  return Q * own_alpha + P * beta.segment<4>(4 * place);
}

// The directions in the unknowns of each node in which equations hold it: those on it alone, and
// those that join it to nodes that are held themselves.
class HeldDirections {
 public:
  HeldDirections(const model::Model& model, const model::Coordinates& q) : model_(model), q_(q) {
    std::vector<const model::Constraint*> left;
    for (const model::Constraint& c : model.equations()) left.push_back(&c);
    do {
      std::erase_if(left, [&](const model::Constraint* c) { return add(*c); });
    } while (find_still_nodes());
  }

  // Null where nothing holds a node.
  const Eigen::MatrixXd* of(int node) const {
    const auto at = held_.find(node);
    return at == held_.end() ? nullptr : &at->second;
  }

 private:
  model::Block block_of(int node) const {
    return model_.unknowns().block(model_.unknowns().node_block(node));
  }

  bool is_still(int node) const {
    const model::Block block = block_of(node);
    return block.shape.active == 0 || still_.count(block.owner) > 0;
  }

  // @return whether the rows need no further look: at most one of the nodes can move
  bool add(const model::Constraint& c) {
    int moving = -1;
    for (std::size_t k = 0; k < c.nodes.size(); ++k) {
      if (is_still(c.nodes[k])) continue;
      if (moving >= 0) return false;
      moving = static_cast<int>(k);
    }
    if (moving < 0) return true;
    const int node = c.nodes[index(moving)];
    const model::Block block = block_of(node);
    if (block.owner != node) return false;  // it follows another node
    Eigen::MatrixXd& directions = held_[node];
    const Eigen::Matrix3Xd slots = model::slots_of(c, q_);
    for (const model::ConstraintRow& row : c.rows) {
      if (row.alpha.empty()) continue;  // one on velocities
      const model::NodeSlots gradient = slot_gradient(row, moving, slots);
      directions.conservativeResize(block.shape.active, directions.cols() + 1);
      for (int i = 0; i < block.shape.width; ++i) {
        const int at = block.shape.position[index(i)];
        if (at < 0) continue;
        std::array<double, 12> unit{};
        unit[index(i)] = 1.0;
        directions(at, directions.cols() - 1) =
            gradient.cwiseProduct(slot_motion(model_, node, unit, q_)).sum();
      }
    }
    return true;
  }

  // @return whether there are new ones
  bool find_still_nodes() {
    bool found = false;
    for (const auto& [node, directions] : held_) {
      const int unknowns = block_of(node).shape.active;
      if (directions.cols() < unknowns || still_.count(node) > 0) continue;
      if (directions.colPivHouseholderQr().rank() < unknowns) continue;
      found = still_.insert(node).second;
    }
    return found;
  }

  const model::Model& model_;
  const model::Coordinates& q_;
  std::map<int, Eigen::MatrixXd> held_;
  std::set<int> still_;  // nodes that cannot move at all
};

// The rows of a node on this rank.
struct NodeRows {
  std::size_t first = 0;
  int count = 0;
  int node = 0;
};

// Of all nodes of this rank, rising.
std::vector<NodeRows> rows_of_nodes(const Layout& layout, const model::Model& model) {
  std::vector<NodeRows> nodes;
  for (const Layout::LocalBlock& local : layout.local_blocks()) {
    if (!local.owned) continue;
    const model::Block block = model.unknowns().block(local.block);
    if (block.kind != model::BlockKind::node || block.shape.active == 0) continue;
    nodes.push_back({index(local.first_column), block.shape.active, block.owner});
  }
  std::ranges::sort(nodes, {}, &NodeRows::first);
  return nodes;
}

// Null for a row that is none of a node.
const NodeRows* node_of_row(const std::vector<NodeRows>& nodes, std::size_t row) {
  const auto after = std::ranges::upper_bound(nodes, row, {}, &NodeRows::first);
  if (after == nodes.begin()) return nullptr;
  const NodeRows& last = *std::prev(after);
  return row < last.first + index(last.count) ? &last : nullptr;
}

// The first place from one on where a force is not zero; the size if there is none. One load of
// many leaves nearly all at zero, so they are looked at side by side.
std::size_t next_acting(std::span<const double> forces, std::size_t from) {
  constexpr std::size_t together = 32;
  for (; from + together <= forces.size(); from += together) {
    bool acts = false;
    for (std::size_t k = 0; k < together; ++k) acts |= forces[from + k] != 0.0;
    if (acts) break;
  }
  while (from < forces.size() && forces[from] == 0.0) ++from;
  return from;
}

// What forces on the unknowns of a node amount to; those on a director do so by its arm.
Vec6 force_and_moment(const model::Model& model, int node, const model::NodeSlots& q,
                      const double* unknowns) {
  Vec6 sum = Vec6::Zero();
  sum.head<3>() = Eigen::Map<const Vec3>(unknowns);
  if (model.unknowns().form() == model::Form::null_space && model.nodes().turns(node)) {
    sum.tail<3>() = Eigen::Map<const Vec3>(unknowns + 3);
    return sum;
  }
  for (int director = 1; director <= 3; ++director) {
    sum.tail<3>() +=
        Vec3(q.col(director)).cross(Vec3(Eigen::Map<const Vec3>(unknowns + 3 * director)));
  }
  return sum;
}

}  // namespace

void System::assemble_alone(model::Batch& load, const model::State& state, double theta,
                            std::span<double> residual, std::span<double> taken) const {
  model::Target target;
  target.residual = residual;
  target.reactions = taken;
  target.row_begin = matrix_->row_begin();
  Stencil stencil = Stencil::statics();
  stencil.theta = stencil.theta_strain = theta;
  load.assemble(state, stencil, Want::residual, target);
}

LoadShare System::share_of(model::Batch& load, const model::State& state) const {
  model::Batch* const alone = &load;
  return shares_of({&alone, 1}, state).front();
}

std::vector<LoadShare> System::shares_of(std::span<model::Batch* const> loads,
                                         const model::State& state, double theta) const {
  std::vector<double> whole(loads.size(), 0.0), moving(loads.size(), 0.0);
  std::vector<double> residual(layout_.rows().size(), 0.0), taken(reactions_.size(), 0.0);
  struct Range {
    std::size_t first = 0, end = 0;
  };
  std::vector<Range> acting(loads.size());  // rows, from the first to the last
  for (std::size_t l = 0; l < loads.size(); ++l) {
    assemble_alone(*loads[l], state, theta, residual, taken);
    const auto note = [&](double& force) {
      whole[l] = std::max(whole[l], std::abs(force));
      force = 0.0;  // for the next load
    };
    for (std::size_t at = 0; (at = next_acting(taken, at)) < taken.size();) note(taken[at]);
    Range& rows = acting[l];
    rows.first = next_acting(residual, 0);
    for (std::size_t row = rows.first; row < residual.size(); row = next_acting(residual, row)) {
      note(residual[row]);
      rows.end = row + 1;
    }
  }
  comm_.max(whole);
  if (std::ranges::all_of(whole, [](double force) { return force == 0.0; })) {
    return std::vector<LoadShare>(loads.size());  // none acts now
  }
  model::Coordinates q = state.next;
  if (!model_.equations().empty()) complete(q);  // joints lead to what is held on other ranks
  const HeldDirections held(model_, q);
  const std::vector<NodeRows> nodes = rows_of_nodes(layout_, model_);
  for (std::size_t l = 0; l < loads.size(); ++l) {
    if (whole[l] == 0.0) continue;
    assemble_alone(*loads[l], state, theta, residual, {});
    const auto rows = std::span<const double>(residual).first(acting[l].end);
    for (std::size_t row = acting[l].first; (row = next_acting(rows, row)) < rows.size();) {
      const NodeRows* const node = node_of_row(nodes, row);
      if (node == nullptr) {
        residual[row] = 0.0;  // of a signal
        continue;
      }
      Eigen::Map<Eigen::VectorXd> f(&residual[node->first], node->count);
      if (const Eigen::MatrixXd* directions = held.of(node->node)) {
        f -= *directions * directions->colPivHouseholderQr().solve(f);
      }
      moving[l] = std::max(moving[l], f.lpNorm<Eigen::Infinity>());
      f.setZero();
    }
  }
  comm_.max(moving);
  std::vector<LoadShare> shares;
  for (std::size_t l = 0; l < loads.size(); ++l) shares.push_back({whole[l], moving[l]});
  return shares;
}

std::vector<Vec6> System::forces_of(model::Batch& load, const model::State& state) const {
  Vector forces(layout_.rows());
  const auto residual = forces.values();
  std::vector<double> taken(reactions_.size(), 0.0);
  assemble_alone(load, state, 1.0, residual, taken);
  std::vector<double> all(12 * index(model_.nodes().size()), 0.0);  // unknowns of nodes
  const auto each_unknown = [&](const model::Block& block, auto action) {
    if (block.kind != model::BlockKind::node) return;
    for (int i = 0; i < block.shape.width; ++i) {
      action(all[12 * index(block.owner) + index(i)], block.shape.position[index(i)]);
    }
  };
  for (const model::Block& block : model_.unknowns().blocks()) {
    each_unknown(block, [&](double& force, int at) {
      if (at < 0) force = -taken[index(block.shape.first_reaction - 1 - at)];
    });
  }
  for (const Layout::LocalBlock& local : layout_.local_blocks()) {
    if (!local.owned) continue;
    each_unknown(model_.unknowns().block(local.block), [&](double& force, int at) {
      if (at >= 0) force = -residual[index(local.first_column + at)];
    });
  }
  comm_.sum(all);
  std::vector<Vec6> found;
  for (int node = 0; node < model_.nodes().size(); ++node) {
    const auto slots = model::NodeTable::slots(state.next, node);
    found.push_back(force_and_moment(model_, node, slots, all.data() + 12 * node));
  }
  return found;
}

}  // namespace culm::assembly
