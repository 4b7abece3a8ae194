#include "block_lu.hpp"

#include <culm/base/error.hpp>
#include <culm/math/fetch.hpp>
#include <culm/math/types.hpp>
#include <culm/math/vector_units.hpp>

#include "block_hosts.hpp"
#include "block_kernels.hpp"
#include "blocks.hpp"
#include "past_cache.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

namespace culm::solver {
namespace {

constexpr auto no_place = std::numeric_limits<BlockPlan::Place>::max();

// Eliminating others may leave on the diagonal so many times the largest entry of the row, as with
// kept pivots of KLU2. The error of a solution grows by as much.
constexpr double largest_pivot_growth = 1e4;

// Of the largest coefficient of a joint; with less an unknown hardly takes part in it.
constexpr double smallest_share = 1e-2;

// More are not parts of a model that joints hold, but a matrix that is singular.
constexpr int most_merged = 8;

// What rounding may leave of a number where many others have been subtracted.
constexpr double rest_of_rounding = 512.0 * std::numeric_limits<double>::epsilon();

// Where there is a choice, a pivot keeps more of what has been on the diagonal. Long beams that are
// held at one end have smaller ones, whatever the choice.
constexpr double good_pivot = 1e-6;

// What takes a fixed size where it can: the unknowns of a node, and those of a body with the forces
// of a ball joint.
constexpr Fixed<6> node{};
constexpr Fixed<3> ball{};
constexpr Fixed<node + ball> jointed{};

// Nodes of chains have one or two neighbours that are eliminated later.
template <class Visit>
auto with_sizes(const BlockPlan::Panel& panel, const Visit& visit) {
  if (panel.size == jointed && panel.width == node) return visit(jointed, node);
  if (panel.size != node) return visit(panel.size, panel.width);
  if (panel.width == node) return visit(node, node);
  if (panel.width == 2 * node) return visit(node, Fixed<2 * node>());
  return visit(node, panel.width);
}

// Columns of one or two nodes and of joints.
template <class Visit>
[[gnu::always_inline]] inline void with_few(int columns, const Visit& visit) {
  switch (columns) {
    case 1:
      return visit(Fixed<1>());
    case 2:
      return visit(Fixed<2>());
    case 3:
      return visit(Fixed<3>());
    case 4:
      return visit(Fixed<4>());
    case 5:
      return visit(Fixed<5>());
    case node:
      return visit(node);
    case 2 * node:
      return visit(Fixed<2 * node>());
    default:
      return visit(columns);
  }
}

// Room for so many numbers and for what is read behind them.
void resize(LargeVector<Packs<1>>& packs, std::size_t numbers) {
  if (numbers > 0) numbers += numbers_behind;
  packs.assign((numbers + pack_lanes - 1) / pack_lanes, Packs<1>());
}

}  // namespace

BlockLu::BlockLu(const BlockRows& rows, int kept, std::size_t cached)
    : rows_(rows), block_of_(block_of_row(find_blocks(rows))), kept_(kept), cached_(cached) {
  num_blocks_ = block_of_.empty() ? 0 : block_of_.back() + 1;
  first_kept_ = kept == 0 ? num_blocks_ : block_of_[block_of_.size() - index(kept)];
}

bool BlockLu::factor() {
  keep_lower(true);
  return factor_numbers({});
}

bool BlockLu::factor_and_reduce(std::span<const double> x) {
  keep_lower(std::exchange(reduces_again_, false));
  return factor_numbers(x);
}

bool BlockLu::factor_with_new_hosts() {
  keep_lower(true);
  return factor_with_chosen_hosts({});
}

bool BlockLu::factor_numbers(const ToReduce& x) {
  return host_.empty() ? factor_with_chosen_hosts(x) : factor_as_planned(rest_of_rounding, x);
}

bool BlockLu::factor_with_chosen_hosts(const ToReduce& x) {
  const std::vector<int> hosts = choose_hosts(rows_, first_kept_);
  return factor_and_merge(hosts, good_pivot, x) || factor_and_merge(hosts, rest_of_rounding, x);
}

bool BlockLu::factor_and_merge(const std::vector<int>& hosts, double least, const ToReduce& x) {
  host_ = hosts;
  plan();
  for (int merged = 0; merged < most_merged; ++merged) {
    if (factor_as_planned(least, x)) return true;
    if (!merge_failed()) return false;
    plan();
  }
  return factor_as_planned(least, x);
}

// What only later reductions read is neither written nor given memory before there are any.
void BlockLu::keep_lower(bool wanted) {
  keeps_lower_ = wanted;
  if (!wanted) lower_ = LargeVector<Packs<1>>();  // {} would keep the memory
  if (wanted && has_bench() && lower_.empty()) resize(lower_, plan_.num_lower);
  exchanged_.resize(is_whole() ? plan_.unknown.size() : row_weight_.size());
}

// Pivots have to exceed so much of what has been on the diagonal.
bool BlockLu::factor_as_planned(double least, const ToReduce& x) {
  if (x) take(*x);
  failed_ = nullptr;
  noted_ = 0;
  exchanges_ = 0;
  for (const BlockPlan::Panel& panel : eliminated()) {
    if (!eliminate(panel, least)) return false;
    if (x) reduce_by(panel, made_lower(panel));
  }
  if (kept_ > 0) fill_before(plan_.panels.back());
  return true;
}

std::span<const BlockPlan::Panel> BlockLu::eliminated() const {
  return {plan_.panels.data(), plan_.panels.size() - (kept_ > 0 ? 1 : 0)};
}

// A part that joints hold, and nothing else, has no pivots for its last group before the joints are
// eliminated. So this group is eliminated with the one that follows.
bool BlockLu::merge_failed() {
  if (failed_ == nullptr || failed_->width == 0) return false;
  const auto host_at = [&](int place) {
    const int block = block_of_[index(plan_.unknown[index(place)])];
    return host_[index(block)] < 0 ? block : host_[index(block)];
  };
  const int from = host_at(failed_->first);
  const int to = host_at(plan_.beside[failed_->beside]);
  if (to >= first_kept_) return false;
  for (std::size_t block = 0; block < host_.size(); ++block) {
    if (static_cast<int>(block) == from || host_[block] == from) host_[block] = to;
  }
  return true;
}

bool BlockLu::set_hosts(std::span<const int> host) {
  if (std::ranges::equal(host_, host)) return true;
  const auto is_block = [&](int b) { return b >= -1 && b < num_blocks_; };
  // a host stands for itself
  const auto fits = [&](int b) { return b < 0 || host[index(b)] < 0 || host[index(b)] == b; };
  const bool fit =
      host.empty() || (host.size() == index(num_blocks_) && std::ranges::all_of(host, is_block) &&
                       std::ranges::all_of(host, fits));
  host_.assign(host.begin(), fit ? host.end() : host.begin());
  if (!host_.empty()) plan();
  return fit;
}

void BlockLu::plan() {
  plan_ = plan_blocks(rows_, host_, first_kept_, cached_);
  const std::size_t rows = plan_.unknown.size();
  resize(bench_, has_bench() ? plan_.bench_size : 0);
  resize(factors_, plan_.num_values);
  reciprocals_.assign(rows, 0.0);
  before_.assign(rows, 0.0);
  x_.assign(rows, 0.0);
  diagonal_.assign(rows, no_place);
  place_.assign(rows, 0);
  for (std::size_t place = 0; place < rows; ++place) {
    const std::size_t row = index(plan_.unknown[place]);
    place_[row] = static_cast<int>(place);
    rows_.for_entries(plan_.unknown[place], [&](int column, std::size_t source) {
      if (index(column) == row) diagonal_[place] = static_cast<BlockPlan::Place>(source);
    });
  }
  int widest = 0;
  int tallest = 0;
  int room = 0;
  for (const BlockPlan::Panel& panel : plan_.panels) {
    widest = std::max(widest, panel.width);
    tallest = std::max(tallest, panel.size);
    room = std::max(room, panel.size * vectors_of(panel.stride()));
  }
  beside_.assign(index(widest), 0.0);
  row_weight_.assign(index(tallest), 0.0);
  room_.resize(index(room));
  lower_.clear();
  keep_lower(keeps_lower_);
}

BlockLu::Kept BlockLu::kept_V(const BlockPlan::Panel& p) const {
  if (has_bench()) return {factors() + numbers_of_line * p.line_of_V, p.width};
  return {factors() + p.pivot + p.size, p.stride()};
}

BlockLu::Lower BlockLu::kept_lower(const BlockPlan::Panel& p) {
  if (!has_bench()) return made_lower(p);
  const double* D = numbers_of(lower_) + numbers_of_line * p.line_of_D;
  return {D, p.size, D + p.size * p.size, {exchanged_rows(p), index(p.size)}};
}

BlockLu::Lower BlockLu::made_lower(const BlockPlan::Panel& p) {
  return {bench() + p.pivot, p.stride(), bench() + p.below(), {exchanged_rows(p), index(p.size)}};
}

BlockPlan::Panel BlockLu::before(const BlockPlan::Panel& panel) const {
  const auto number = &panel - plan_.panels.data();
  return number == 0 ? BlockPlan::Panel() : plan_.panels[index(number - 1)];
}

// Asks the memory for what panels behind this one bring from the matrix.
[[gnu::always_inline]] inline void BlockLu::fetch_before(const BlockPlan::Panel& panel) {
  constexpr std::ptrdiff_t ahead = 4;
  const BlockPlan::Panel* last = plan_.panels.data() + plan_.panels.size() - 1;
  if (last - &panel < ahead) return;
  const BlockPlan::Panel* then = &panel + ahead;
  for (BlockPlan::Place k = (then - 1)->copies; k < then->copies; ++k) {
    const BlockPlan::Copy& c = plan_.copies[k];
    const double* source = rows_.values(c.source);
    for (int i = 0; i < c.rows; ++i, source += c.source_stride) {
      fetch(source, index(c.columns) * sizeof(double));
    }
  }
}

// Brings from the matrix what the elimination of a panel is the first to need.
[[gnu::always_inline]] inline void BlockLu::fill_before(const BlockPlan::Panel& panel) {
  const auto copy_rows = [&](const BlockPlan::Copy& c, auto columns)
      __attribute__((always_inline)) {
    const double* source = rows_.values(c.source);
    double* target = bench() + c.target;
    for (int i = 0; i < c.rows; ++i, source += c.source_stride, target += c.target_stride) {
      copy_numbers(source, columns, target);
    }
  };
  const BlockPlan::Panel done = before(panel);
  for (BlockPlan::Place k = done.gaps; k < panel.gaps; ++k) {
    std::fill_n(bench() + plan_.gaps[k].target, plan_.gaps[k].size, 0.0);
  }
  for (BlockPlan::Place k = done.copies; k < panel.copies; ++k) {
    const BlockPlan::Copy& c = plan_.copies[k];
    with_few(
        c.columns, [&](auto columns) __attribute__((always_inline)) { copy_rows(c, columns); });
  }
}

// What is on the diagonal of the matrix at a place.
double BlockLu::start_at(std::size_t place) const {
  return diagonal_[place] == no_place ? 0.0 : std::abs(rows_.value(diagonal_[place]));
}

// Also notes how large entries of the diagonal have been. Multipliers begin with nothing there, so
// that there is no growth to judge.
bool BlockLu::has_grown(const BlockPlan::Panel& panel) {
  const std::size_t first = index(panel.first);
  noted_ = first + index(panel.size);
  for (std::size_t place = first; place < noted_; ++place) before_[place] = start_at(place);
  const double* entry = bench() + panel.pivot;
  for (int i = 0; i < panel.size; ++i, entry += panel.stride() + 1) {
    const std::size_t place = index(panel.first + i);
    const double now = std::abs(*entry);
    const int row = plan_.unknown[place];
    if (now > largest_pivot_growth * before_[place] && before_[place] > 0.0 &&
        now > largest_pivot_growth * largest_in_row(row) &&
        now > largest_pivot_growth * largest_behind_joints(row)) {
      return true;
    }
    before_[place] = std::max(before_[place], now);
  }
  return false;
}

double BlockLu::largest_in_row(int row) const {
  double largest = 0.0;
  rows_.for_entries(row, [&](int, std::size_t source) {
    largest = std::max(largest, std::abs(rows_.value(source)));
  });
  return largest;
}

// What joints may bring to this row: a body with next to no mass of its own carries, once a joint
// to a heavy one is eliminated, the mass of that one.
double BlockLu::largest_behind_joints(int row) const {
  const auto for_entries = [&](int of, const auto& visit) {
    rows_.for_entries(of, [&](int column, std::size_t source) {
      if (rows_.value(source) != 0.0) visit(column, std::abs(rows_.value(source)));
    });
  };
  double largest = 0.0;
  for_entries(row, [&](int joint, double here) {
    const BlockPlan::Place diagonal = diagonal_[index(place_[index(joint)])];
    if (diagonal != no_place && rows_.value(diagonal) != 0.0) return;
    const double least = smallest_share * largest_in_row(joint);
    for_entries(joint, [&](int other, double there) {
      const double ratio = here / std::max(there, least);
      const std::size_t place = index(place_[index(other)]);
      largest =
          std::max(largest, ratio * ratio * (place < noted_ ? before_[place] : start_at(place)));
    });
  });
  return largest;
}

[[gnu::always_inline]] inline void BlockLu::update(const BlockPlan::Panel& panel,
                                                   std::size_t from) {
  double* v = bench();
  const int stride = panel.stride();
  for (std::size_t k = from; k < panel.updates; ++k) {
    const BlockPlan::Update& u = plan_.updates[k];
    const double* L = v + u.below;
    const double* V = v + u.beside;
    double* target = v + u.target;
    if (panel.size == node && u.rows == node && u.columns == node) {
      subtract_product(L, V, stride, target, u.stride, node, node, node);
    } else if (panel.size == node && u.rows == node && u.columns == 2 * node) {
      subtract_product(L, V, stride, target, u.stride, node, node, Fixed<2 * node>());
    } else if (panel.size == jointed && u.rows == node && u.columns == node) {
      subtract_product(L, V, stride, target, u.stride, node, jointed, node);
    } else {
      subtract_product(L, V, stride, target, u.stride, u.rows, panel.size, u.columns);
    }
  }
}

CULM_FOR_EACH_VECTOR_UNIT [[gnu::flatten]] bool BlockLu::eliminate(const BlockPlan::Panel& panel,
                                                                   double least) {
  if (has_bench()) fetch_before(panel);
  fill_before(panel);
  if (has_grown(panel)) return false;
  const bool is_sound = with_sizes(panel, [&](auto size, auto width) {
    return factor_panel(bench() + panel.pivot, size, width, before_.data() + panel.first, least,
                        exchanged_rows(panel), row_weight_.data(), room_.data()->numbers);
  });
  if (!is_sound) {
    failed_ = &panel;
    return false;
  }
  const int* exchanged = exchanged_rows(panel);
  for (int i = 0; i < panel.size; ++i) {
    reciprocals_[index(panel.first + i)] = bench()[panel.pivot + index(i * (panel.stride() + 1))];
    if (exchanged[i] != i) ++exchanges_;
  }
  update(panel, before(panel).updates);
  if (has_bench()) {
    with_sizes(panel, [&](auto size, auto width) { put_away(panel, size, width); });
  }
  return true;
}

// From the bench to the factors.
template <class Size, class Width>
[[gnu::always_inline]] inline void BlockLu::put_away(const BlockPlan::Panel& panel, Size size,
                                                     Width width) {
  const double* rows = bench() + panel.pivot;
  double* V = factors() + numbers_of_line * panel.line_of_V;
  double* D = keeps_lower_ ? numbers_of(lower_) + numbers_of_line * panel.line_of_D : nullptr;
  const auto put = [&](const auto& copy) __attribute__((always_inline)) {
    for (int r = 0; r < size; ++r) copy(rows + r * (size + width) + size, width, V + r * width);
    if (!keeps_lower_) return;
    for (int r = 0; r < size; ++r) copy(rows + r * (size + width), size, D + r * size);
    for (int r = 0; r < width; ++r) {
      copy(bench() + panel.below() + index(r * size), size, D + (size + r) * size);
    }
  };
  if (size % 2 != 0 || width % 2 != 0) {
    return put([](const double* from, auto count, double* to)
                   __attribute__((always_inline)) { copy_numbers(from, count, to); });
  }
  put([](const double* from, auto count, double* to)
          __attribute__((always_inline)) { copy_past_cache(from, count, to); });
  // lines go to memory at once where all of them is written
  constexpr double nothing[pack_lanes] = {};
  const auto fill_line = [&](int count, double* to) {
    const auto end = static_cast<int>(whole_lines(index(count)));
    copy_past_cache(nothing, end - count, to + count);
  };
  fill_line(size * width, V);
  if (keeps_lower_) fill_line(size * (size + width), D);
}

void BlockLu::solve(std::span<double> x) {
  reduce(x);
  extend(x);
}

std::span<const double> BlockLu::remainder() const {
  if (kept_ == 0) return {};
  return {bench() + plan_.panels.back().pivot, index(kept_) * index(kept_)};
}

void BlockLu::reduce(std::span<double> x) {
  if (has_bench() && !keeps_lower_) {
    keep_lower(true);
    internal_check(factor_as_planned(rest_of_rounding, {}),
                   "a matrix has changed since it was factored");
  }
  reduces_again_ = true;
  take(x);
  for (const BlockPlan::Panel& panel : eliminated()) reduce_by(panel, kept_lower(panel));
  put_kept(x);
}

void BlockLu::take(std::span<const double> x) {
  double* to = x_.data();
  for (const BlockPlan::Run& run : plan_.runs) {
    to = std::copy_n(x.data() + run.row, run.count, to);
  }
}

// The same code whenever it is called, so that a solution does not depend on it.
CULM_FOR_EACH_VECTOR_UNIT [[gnu::flatten]] void BlockLu::reduce_by(const BlockPlan::Panel& panel,
                                                                   const Lower& lower) {
  with_sizes(panel, [&](auto size, auto width) { substitute_forward(panel, size, width, lower); });
}

void BlockLu::put_kept(std::span<double> x) const {
  for (std::size_t place = x_.size() - index(kept_); place < x_.size(); ++place) {
    x[index(plan_.unknown[place])] = x_[place];
  }
}

// Asks the memory for what panels before this one keep.
[[gnu::always_inline]] inline void BlockLu::fetch_kept_before(const BlockPlan::Panel& panel) const {
  constexpr std::ptrdiff_t ahead = 8;
  if (&panel - plan_.panels.data() < ahead) return;
  const BlockPlan::Panel& then = *(&panel - ahead);
  fetch(factors() + numbers_of_line * then.line_of_V,
        index(then.size * then.width) * sizeof(double));
}

CULM_FOR_EACH_VECTOR_UNIT [[gnu::flatten]] void BlockLu::extend(std::span<double> x) {
  for (std::size_t place = x_.size() - index(kept_); place < x_.size(); ++place) {
    x_[place] = x[index(plan_.unknown[place])];
  }
  const auto panels = eliminated();
  for (auto panel = panels.rbegin(); panel != panels.rend(); ++panel) {
    if (has_bench()) fetch_kept_before(*panel);
    with_sizes(*panel, [&](auto size, auto width) {
      substitute_back(*panel, size, width);
      put_solved(*panel, size, x);
    });
  }
}

template <class Size>
void BlockLu::put_solved(const BlockPlan::Panel& panel, Size size, std::span<double> x) const {
  const double* solved = x_.data() + panel.first;
  if (panel.row >= 0) return copy_numbers(solved, size, x.data() + panel.row);
  for (int i = 0; i < size; ++i) x[index(plan_.unknown[index(panel.first + i)])] = solved[i];
}

// With known sizes the block is solved in registers.
template <class Size, class Width>
void BlockLu::substitute_forward(const BlockPlan::Panel& panel, Size size, Width width,
                                 const Lower& lower) {
  const auto& [D, stride, L, exchanged] = lower;
  double* x = x_.data() + panel.first;
  const int* beside = plan_.beside.data() + panel.beside;
  exchange_rows(exchanged, x);
  const auto subtract_from_beside = [&](const double* solved) __attribute__((always_inline)) {
    for (int i = 0; i < width; ++i) {
      double sum = 0.0;
      for (int k = 0; k < size; ++k) sum += L[i * size + k] * solved[k];
      x_[index(beside[i])] -= sum;
    }
  };
  if constexpr (std::is_same_v<Size, int>) {
    solve_block(D, stride, size, x);
    subtract_from_beside(x);
  } else {
    double solved[Size::value];
    std::copy_n(x, Size::value, solved);
    solve_block(D, stride, size, solved);
    std::copy_n(solved, Size::value, x);
    subtract_from_beside(solved);
  }
}

template <class Size, class Width>
void BlockLu::substitute_back(const BlockPlan::Panel& panel, Size size, Width width) {
  const int* beside = plan_.beside.data() + panel.beside;
  for (int k = 0; k < width; ++k) beside_[index(k)] = x_[index(beside[k])];
  const Kept V = kept_V(panel);
  subtract_product(V.numbers, V.stride, beside_.data(), x_.data() + panel.first, size, width);
}

// Rows and columns are in the same order, so that only exchanges inside blocks change the sign.
// Without them the factors of a symmetric matrix are L D L^T, and D has the signs of the
// eigenvalues.
Determinant BlockLu::determinant() const {
  Determinant d{1, 0.0};
  int negative = 0;
  for (const BlockPlan::Panel& panel : eliminated()) {
    for (int i = 0; i < panel.size; ++i) {
      const double reciprocal = reciprocals_[index(panel.first + i)];
      if (reciprocal < 0.0) ++negative;
      d.log_size -= std::log(std::abs(reciprocal));
    }
  }
  if ((negative + exchanges_) % 2 != 0) d.sign = -1;
  if (exchanges_ == 0) d.negative = negative;
  return d;
}

}  // namespace culm::solver
