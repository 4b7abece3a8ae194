#include <culm/model/cells.hpp>

#include <algorithm>
#include <iterator>

namespace culm::model {
namespace {

bool same(const Cell& a, const Cell& b) {
  return std::ranges::equal(a.nodes, b.nodes) && a.source == b.source && a.item == b.item;
}

}  // namespace

Cell Cells::Run::at(std::size_t k) const {
  Cell cell = first;
  for (int& node : cell.nodes) node += static_cast<int>(k) * node_step;
  cell.item += static_cast<int>(k) * item_step;
  return cell;
}

void Cells::push_back(const Cell& cell) {
  const auto goes_on = [&](const Run& run) { return same(run.at(size_ - run.begin), cell); };
  if (!runs_.empty() && goes_on(runs_.back())) {
    ++size_;
    return;
  }
  // the second of a run says how it goes on
  if (!runs_.empty() && size_ == runs_.back().begin + 1 && cell.nodes.size() != 0) {
    Run run = runs_.back();
    run.node_step = cell.nodes.front() - run.first.nodes.front();
    run.item_step = cell.item - run.first.item;
    if (goes_on(run)) {
      runs_.back() = run;
      ++size_;
      return;
    }
  }
  runs_.push_back({size_++, cell});
}

Cell Cells::operator[](std::size_t i) const {
  const auto run = std::prev(std::ranges::upper_bound(runs_, i, {}, &Run::begin));
  return run->at(i - run->begin);
}

}  // namespace culm::model
