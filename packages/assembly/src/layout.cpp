#include <culm/assembly/layout.hpp>
#include <culm/parallel/partition.hpp>

#include <algorithm>

namespace culm::assembly {
namespace {

std::vector<double> levers_of(const model::NodeTable& nodes) {
  if (nodes.num_slaves() == 0) return {};
  std::vector<double> levers(index(nodes.size()), 0.0);
  const auto place = [&](int node) {
    return model::NodeTable::slots(nodes.reference(), node).col(0);
  };
  for (int node = 0; node < nodes.size(); ++node) {
    if (!nodes.is_slave(node)) continue;
    double& lever = levers[index(nodes.master(node))];
    lever = std::max(lever, (place(node) - place(nodes.master(node))).norm());
  }
  return levers;
}

}  // namespace

Layout::Layout(model::Model& model, const parallel::Comm& comm)
    : comm_(comm), levers_(levers_of(model.nodes())) {
  const model::UnknownTable& unknowns = model.unknowns();
  const Neighbours neighbours = couple_blocks(model);
  choose_owners(unknowns, neighbours);
  number_locally(unknowns, neighbours);
  build_pattern(unknowns, neighbours);
  for (model::Batch* batch : model.batches()) {
    batch->place(place(*batch, unknowns), unknowns.form());
  }
  runs_ = std::vector<std::vector<std::pair<int, int>>>();  // {} would keep the memory
}

// Blocks that share an item, each block with itself; sorted.
Layout::Neighbours Layout::couple_blocks(const model::Model& model) const {
  const model::UnknownTable& unknowns = model.unknowns();
  Neighbours neighbours(index(unknowns.num_blocks()));
  for (std::size_t b = 0; b < neighbours.size(); ++b) {
    neighbours[b].push_back(static_cast<int>(b));
  }
  for (const model::Batch* batch : model.batches()) {
    if (!batch->has_tangent()) continue;
    for (int item = 0; item < batch->size(); ++item) {
      const std::vector<int> blocks = batch->blocks(item, unknowns);
      for (int a : blocks) {
        for (int b : blocks) neighbours[index(a)].push_back(b);
      }
    }
  }
  for (auto& list : neighbours) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  return neighbours;
}

void Layout::choose_owners(const model::UnknownTable& unknowns, const Neighbours& neighbours) {
  parallel::Graph graph;
  for (std::size_t b = 0; b < neighbours.size(); ++b) {
    for (int other : neighbours[b]) {
      if (other != static_cast<int>(b)) graph.neighbours.push_back(other);
    }
    graph.begin.push_back(static_cast<int>(graph.neighbours.size()));
    graph.weights.push_back(1 + unknowns.block(static_cast<int>(b)).shape.active);
  }
  owners_ = parallel::partition(graph, comm_.size());
}

// Columns: owned blocks in global order, then the blocks beside them in global order.
void Layout::number_locally(const model::UnknownTable& unknowns, const Neighbours& neighbours) {
  const std::size_t count = neighbours.size();
  std::vector<bool> beside(count, false);
  for (std::size_t b = 0; b < count; ++b) {
    if (owners_[b] != comm_.rank()) continue;
    for (int other : neighbours[b]) beside[index(other)] = owners_[index(other)] != comm_.rank();
  }
  local_row_.assign(count, -1);
  local_column_.assign(count, -1);
  int column = 0;
  for (const bool owned : {true, false}) {
    for (std::size_t b = 0; b < count; ++b) {
      if (owned ? owners_[b] != comm_.rank() : !beside[b]) continue;
      if (owned) local_row_[b] = column;
      local_column_[b] = column;
      local_blocks_.push_back({static_cast<int>(b), column, owned});
      const model::Block block = unknowns.block(static_cast<int>(b));
      column += block.shape.active;
      if (owned && block.kind == model::BlockKind::node) num_node_rows_ = column;
    }
  }
}

// Of the matrix, in rows of this rank.
std::size_t Layout::count_entries(const model::UnknownTable& unknowns,
                                  const Neighbours& neighbours) const {
  std::size_t count = 0;
  for (const LocalBlock& local : local_blocks_) {
    if (!local.owned) continue;
    const auto rows = static_cast<std::size_t>(unknowns.block(local.block).shape.active);
    for (int other : neighbours[index(local.block)]) {
      count += rows * static_cast<std::size_t>(unknowns.block(other).shape.active);
    }
  }
  return count;
}

void Layout::build_pattern(const model::UnknownTable& unknowns, const Neighbours& neighbours) {
  std::vector<long long> rows;
  std::vector<long long> columns;
  for (const LocalBlock& local : local_blocks_) {
    const model::Block block = unknowns.block(local.block);
    for (int i = 0; i < block.shape.active; ++i) {
      if (local.owned) rows.push_back(block.first + i);
      columns.push_back(block.first + i);
    }
  }
  rows_.emplace(rows, comm_);
  columns_ = comm_.size() == 1 ? *rows_ : Rows(columns, comm_);

  std::vector<std::size_t> begin = {0};
  std::vector<int> column_of;
  column_of.reserve(count_entries(unknowns, neighbours));
  runs_.resize(neighbours.size());
  for (const LocalBlock& local : local_blocks_) {
    if (!local.owned) continue;
    std::vector<int> coupled = neighbours[index(local.block)];
    std::sort(coupled.begin(), coupled.end(),
              [&](int a, int b) { return local_column_[index(a)] < local_column_[index(b)]; });
    std::vector<int> pattern;
    for (int other : coupled) {
      runs_[index(local.block)].emplace_back(other, static_cast<int>(pattern.size()));
      const int active = unknowns.block(other).shape.active;
      for (int j = 0; j < active; ++j) pattern.push_back(local_column_[index(other)] + j);
    }
    for (int i = 0; i < unknowns.block(local.block).shape.active; ++i) {
      column_of.insert(column_of.end(), pattern.begin(), pattern.end());
      begin.push_back(column_of.size());
    }
  }
  pattern_.emplace(*rows_, *columns_, begin, column_of);
}

int Layout::offset_in_row(int row_block, int column_block) const {
  for (const auto& [block, offset] : runs_[index(row_block)]) {
    if (block == column_block) return offset;
  }
  return 0;  // no tangent between these blocks
}

model::Placement Layout::place(const model::Batch& batch,
                               const model::UnknownTable& unknowns) const {
  model::Placement placement;
  for (int item = 0; item < batch.size(); ++item) {
    const std::vector<int> blocks = batch.blocks(item, unknowns);
    const bool here = std::any_of(blocks.begin(), blocks.end(),
                                  [&](int b) { return owners_[index(b)] == comm_.rank(); });
    if (!here) continue;
    std::vector<model::Scatter::Rows> rows;
    std::vector<int> offsets;
    for (int a : blocks) {
      rows.push_back({local_row_[index(a)], &unknowns.block(a).shape});
      for (int b : blocks) offsets.push_back(offset_in_row(a, b));
    }
    placement.items.push_back(item);
    placement.owned.push_back(owners_[index(blocks.front())] == comm_.rank());
    placement.scatter.add_item(rows, offsets);
  }
  return placement;
}

}  // namespace culm::assembly
