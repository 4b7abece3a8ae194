#include "block_plan.hpp"

#include <culm/base/error.hpp>
#include <culm/math/types.hpp>

#include "blocks.hpp"
#include "elimination_groups.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

namespace culm::solver {
namespace {

// Until all is listed, panels stand side by side, and every number has a place of its own.
class Planner {
 public:
  Planner(const BlockRows& rows, const std::vector<int>& host, int first_kept, std::size_t cached)
      : rows_(rows),
        blocks_(find_blocks(rows)),
        block_of_(block_of_row(blocks_)),
        graph_(couple(blocks_, block_of_)),
        first_row_(blocks_.sizes.size()),
        groups_(order_groups(graph_, host, first_kept)) {
    blocks_.rows = std::vector<long long>();  // of what is asked no more, memory goes back
    blocks_.columns = std::vector<long long>();
    std::exclusive_scan(blocks_.sizes.begin(), blocks_.sizes.end(), first_row_.begin(), 0);
    place_blocks();
    find_panels();
    list_copies();
    list_updates();
    find_gaps();
    find_need();
    fill_when_needed();
    if (end_ <= cached) {
      plan_.num_values = end_;
      return;
    }
    const bool keeps = first_kept < static_cast<int>(blocks_.sizes.size());
    place_factors(plan_.panels.size() - (keeps ? 1 : 0));
    move_to_bench();
  }
  BlockPlan take() { return std::move(plan_); }

 private:
  struct Place {
    std::size_t at = 0;
    int stride = 0;
  };

  static BlockPlan::Place short_of(std::size_t place) {
    if (place > std::numeric_limits<BlockPlan::Place>::max()) {
      throw NumericalError(
          "Block LU cannot number the factors of a matrix so large on one process: take more "
          "processes, or 'Linear Solver' = Iterative");
    }
    return static_cast<BlockPlan::Place>(place);
  }

  void place_blocks() {
    group_of_.resize(blocks_.sizes.size());
    place_.resize(blocks_.sizes.size());
    int place = 0;
    for (std::size_t g = 0; g < groups_.size(); ++g) {
      for (int block : groups_[g]) {
        group_of_[index(block)] = static_cast<int>(g);
        place_[index(block)] = place;
        place += blocks_.sizes[index(block)];
        for (int i = 0; i < blocks_.sizes[index(block)]; ++i) {
          plan_.unknown.push_back(first_row_[index(block)] + i);
        }
        add_run(first_row_[index(block)], blocks_.sizes[index(block)]);
      }
    }
  }

  void add_run(int row, int count) {
    BlockPlan::Run* const last = plan_.runs.empty() ? nullptr : &plan_.runs.back();
    if (last != nullptr && last->row + last->count == row) {
      last->count += count;
    } else {
      plan_.runs.push_back({row, count});
    }
  }

  // A group passes on to the first that follows in U what else stands there.
  void find_panels() {
    beside_.resize(groups_.size());
    std::vector<std::vector<int>> children(groups_.size());
    std::vector<int> seen_by(blocks_.sizes.size(), -1);
    for (int g = 0; g < static_cast<int>(groups_.size()); ++g) {
      std::vector<int>& beside = beside_[index(g)];
      const auto add = [&](int block) {
        if (group_of_[index(block)] <= g || seen_by[index(block)] == g) return;
        seen_by[index(block)] = g;
        beside.push_back(block);
      };
      for (int block : groups_[index(g)]) {
        for (int e = graph_.begin[index(block)]; e < graph_.begin[index(block) + 1]; ++e) {
          add(graph_.neighbours[index(e)]);
        }
      }
      for (int child : children[index(g)]) {
        for (int block : beside_[index(child)]) add(block);
      }
      std::ranges::sort(beside, {}, [&](int block) { return place_[index(block)]; });
      if (!beside.empty()) children[index(group_of_[index(beside.front())])].push_back(g);
      add_panel(g);
    }
  }

  void add_panel(int g) {
    BlockPlan::Panel panel;
    panel.first = place_[index(groups_[index(g)].front())];
    panel.row = plan_.unknown[index(panel.first)];
    for (int block : groups_[index(g)]) {
      if (first_row_[index(block)] != panel.row + panel.size) panel.row = -1;
      panel.size += blocks_.sizes[index(block)];
    }
    panel.beside = short_of(plan_.beside.size());
    for (int block : beside_[index(g)]) {
      for (int i = 0; i < blocks_.sizes[index(block)]; ++i) {
        plan_.beside.push_back(place_[index(block)] + i);
      }
      panel.width += blocks_.sizes[index(block)];
    }
    panel.pivot = short_of(end_);
    end_ = panel.below() + index(panel.width) * index(panel.size);
    plan_.panels.push_back(panel);
  }

  // Of a place among the columns of U, or rows of L.
  int among_beside(const BlockPlan::Panel& panel, int place) const {
    const auto first = plan_.beside.begin() + static_cast<std::ptrdiff_t>(panel.beside);
    return static_cast<int>(std::lower_bound(first, first + panel.width, place) - first);
  }

  // Where the entry of the first row of one block in the first column of another stands.
  Place find(int row_block, int column_block) const {
    const int row = place_[index(row_block)];
    const int column = place_[index(column_block)];
    const int g = group_of_[index(row_block)];
    const int h = group_of_[index(column_block)];
    const BlockPlan::Panel& panel = plan_.panels[index(std::min(g, h))];
    if (h < g) {
      const std::size_t above = index(among_beside(panel, row)) * index(panel.size);
      return {panel.below() + above + index(column - panel.first), panel.size};
    }
    const int across = g == h ? column - panel.first : panel.size + among_beside(panel, column);
    const std::size_t above = index(row - panel.first) * index(panel.stride());
    return {panel.pivot + above + index(across), panel.stride()};
  }

  void list_copies() {
    std::vector<std::pair<int, std::size_t>> entries;  // column and source
    for (std::size_t b = 0; b < blocks_.sizes.size(); ++b) {
      const std::size_t first = plan_.copies.size();  // of this block
      entries.clear();
      rows_.for_entries(first_row_[b], [&](int column, std::size_t source) {
        entries.emplace_back(column, source);
      });
      std::ranges::sort(entries);
      for (std::size_t k = 0; k < entries.size();) {
        const auto [column, source] = entries[k];
        const int other = block_of_[index(column)];
        const int last = first_row_[index(other)] + blocks_.sizes[index(other)];
        int run = 1;
        while (k + index(run) < entries.size() && column + run < last &&
               entries[k + index(run)] == std::pair(column + run, source + index(run))) {
          ++run;
        }
        const Place target = find(static_cast<int>(b), other);
        const auto at = short_of(target.at + index(column - first_row_[index(other)]));
        BlockPlan::Copy* last_copy = plan_.copies.size() > first ? &plan_.copies.back() : nullptr;
        if (last_copy != nullptr &&
            last_copy->source + static_cast<unsigned>(last_copy->columns) == source &&
            last_copy->target + static_cast<unsigned>(last_copy->columns) == at &&
            panel_of(last_copy->target) == panel_of(at)) {
          last_copy->columns += run;
        } else {
          plan_.copies.push_back(
              {short_of(source), at, blocks_.widths[b], target.stride, blocks_.sizes[b], run});
        }
        k += index(run);
      }
    }
  }

  void list_updates() {
    for (std::size_t g = 0; g < groups_.size(); ++g) {
      BlockPlan::Panel& panel = plan_.panels[g];
      std::size_t below = panel.below();
      for (int row_block : beside_[g]) {
        std::size_t beside = panel.pivot + index(panel.size);
        std::size_t first = plan_.updates.size();  // of this row
        for (int column_block : beside_[g]) {
          const Place found = find(row_block, column_block);
          const auto target = short_of(found.at);
          const int columns = blocks_.sizes[index(column_block)];
          BlockPlan::Update* last = plan_.updates.size() > first ? &plan_.updates.back() : nullptr;
          if (last != nullptr && last->target + static_cast<unsigned>(last->columns) == target &&
              last->stride == found.stride && panel_of(last->target) == panel_of(target)) {
            last->columns += columns;
          } else {
            plan_.updates.push_back({short_of(below), short_of(beside), target, found.stride,
                                     blocks_.sizes[index(row_block)], columns});
          }
          beside += index(columns);
        }
        below += index(blocks_.sizes[index(row_block)]) * index(panel.size);
      }
      panel.updates = short_of(plan_.updates.size());
    }
  }

  void find_gaps() {
    std::vector<bool> is_filled(end_, false);
    for (const BlockPlan::Copy& copy : plan_.copies) {
      for (int i = 0; i < copy.rows; ++i) {
        const std::size_t first = copy.target + index(i) * index(copy.target_stride);
        std::fill_n(is_filled.begin() + static_cast<std::ptrdiff_t>(first), copy.columns, true);
      }
    }
    for (std::size_t g = 0; g < plan_.panels.size(); ++g) {
      bool goes_on = false;
      for (std::size_t k = plan_.panels[g].pivot; k < end_of(g); ++k) {
        if (!is_filled[k] && goes_on) ++plan_.gaps.back().size;
        if (!is_filled[k] && !goes_on) plan_.gaps.push_back({short_of(k), 1});
        goes_on = !is_filled[k];
      }
    }
  }

  // Of the values of a panel.
  std::size_t end_of(std::size_t panel) const {
    return panel + 1 < plan_.panels.size() ? plan_.panels[panel + 1].pivot : end_;
  }

  // By which panel each is first updated; by itself if by none.
  void find_need() {
    needed_by_.resize(plan_.panels.size());
    std::iota(needed_by_.begin(), needed_by_.end(), std::size_t{0});
    std::size_t k = 0;
    for (std::size_t g = 0; g < plan_.panels.size(); ++g) {
      for (; k < plan_.panels[g].updates; ++k) {
        std::size_t& first = needed_by_[panel_of(plan_.updates[k].target)];
        first = std::min(first, g);
      }
    }
  }

  // A panel is filled before it is eliminated or another one updates it first, and not earlier, so
  // that it is still in the cache.
  void fill_when_needed() {
    sort_by_need(plan_.copies, &BlockPlan::Panel::copies);
    sort_by_need(plan_.gaps, &BlockPlan::Panel::gaps);
  }

  std::size_t panel_of(std::size_t value) const {
    const auto next = std::ranges::upper_bound(plan_.panels, value, {}, &BlockPlan::Panel::pivot);
    return index(next - plan_.panels.begin()) - 1;
  }

  template <class Item>
  void sort_by_need(std::vector<Item>& items, BlockPlan::Place BlockPlan::Panel::*end) {
    std::vector<std::size_t> next(plan_.panels.size(), 0);  // place of the next item, by panel
    for (const Item& item : items) ++next[needed_by_[panel_of(item.target)]];
    std::exclusive_scan(next.begin(), next.end(), next.begin(), std::size_t{0});
    std::vector<Item> sorted(items.size());
    for (const Item& item : items) sorted[next[needed_by_[panel_of(item.target)]]++] = item;
    for (std::size_t g = 0; g < plan_.panels.size(); ++g) plan_.panels[g].*end = short_of(next[g]);
    items = std::move(sorted);
  }

  void place_factors(std::size_t num_eliminated) {
    const auto take = [](int numbers, std::size_t& end) {
      const std::size_t first = std::exchange(end, end + whole_lines(index(numbers)));
      return short_of(first / numbers_of_line);
    };
    const std::span panels(plan_.panels.data(), num_eliminated);
    for (auto p = panels.rbegin(); p != panels.rend(); ++p)
      p->line_of_V = take(p->size * p->width, plan_.num_values);
    for (BlockPlan::Panel& p : panels) p.line_of_D = take(p.size * p.stride(), plan_.num_lower);
  }

  void move_to_bench() {
    const std::vector<std::size_t> bench = find_places_on_bench();
    const auto move = [&](BlockPlan::Place& value) {
      const std::size_t panel = panel_of(value);
      value = short_of(value + bench[panel] - plan_.panels[panel].pivot);
    };
    for (BlockPlan::Copy& copy : plan_.copies) move(copy.target);
    for (BlockPlan::Gap& gap : plan_.gaps) move(gap.target);
    for (BlockPlan::Update& update : plan_.updates) {
      move(update.target);
      move(update.below);
      move(update.beside);
    }
    for (std::size_t p = 0; p < bench.size(); ++p) plan_.panels[p].pivot = short_of(bench[p]);
  }

  // Of each panel, from when it is needed until it is eliminated.
  std::vector<std::size_t> find_places_on_bench() {
    const auto size_of = [&](std::size_t panel) {
      return whole_lines(end_of(panel) - plan_.panels[panel].pivot);
    };
    std::vector<std::size_t> by_need(plan_.panels.size());
    std::iota(by_need.begin(), by_need.end(), std::size_t{0});
    std::ranges::stable_sort(by_need, {}, [&](std::size_t panel) { return needed_by_[panel]; });
    std::vector<std::size_t> places(plan_.panels.size());
    std::map<std::size_t, std::vector<std::size_t>> free;  // by size
    auto next = by_need.begin();
    for (std::size_t g = 0; g < plan_.panels.size(); ++g) {
      for (; next != by_need.end() && needed_by_[*next] == g; ++next) {
        std::vector<std::size_t>& fitting = free[size_of(*next)];
        if (fitting.empty()) {
          fitting.push_back(plan_.bench_size);
          plan_.bench_size += size_of(*next);
        }
        places[*next] = fitting.back();
        fitting.pop_back();
      }
      free[size_of(g)].push_back(places[g]);
    }
    return places;
  }

  const BlockRows& rows_;
  Blocks blocks_;
  std::vector<int> block_of_;  // of each row
  parallel::Graph graph_;
  std::vector<int> first_row_;            // of each block
  std::vector<std::vector<int>> groups_;  // blocks, in the order of elimination
  std::vector<int> group_of_;             // of each block
  std::vector<int> place_;                // of the first unknown of each block
  std::vector<std::vector<int>> beside_;  // of each group: blocks right of the diagonal, in order
  std::size_t end_ = 0;                   // of panels side by side
  std::vector<std::size_t> needed_by_;    // of each panel
  BlockPlan plan_;
};

}  // namespace

BlockPlan plan_blocks(const BlockRows& rows, const std::vector<int>& host, int first_kept,
                      std::size_t cached) {
  return Planner(rows, host, first_kept, cached).take();
}

}  // namespace culm::solver
