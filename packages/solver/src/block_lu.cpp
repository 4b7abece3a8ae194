#include "block_lu.hpp"

#include "block_kernels.hpp"
#include "blocks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace culm::solver {
namespace {

std::size_t index(int i) { return static_cast<std::size_t>(i); }

constexpr auto none = std::numeric_limits<std::size_t>::max();

// A pivot so small beside the entry of the matrix in its place is nothing but rounding.
constexpr double rounding = 4.0 * std::numeric_limits<double>::epsilon();

// What takes a fixed size where it can: the unknowns of a node.
constexpr Fixed<6> node{};

}  // namespace

BlockLu::BlockLu(const assembly::CrsMatrix& matrix) : matrix_(matrix), local_(matrix.getLocalMatrixHost()) {
  const auto& graph = local_.graph;
  int row = 0;
  for (const int size : find_blocks(matrix).sizes) {
    const int first = row;
    for (; row < first + size; ++row) {
      Row found{none, none, none};
      for (auto k = graph.row_map(index(row)); k < graph.row_map(index(row) + 1); ++k) {
        const int column = graph.entries(k);
        if (column == row) found.diagonal = k;
        if (column < first || column >= first + size) continue;
        if (found.first == none) found.first = k;
        found.last = k + 1;
      }
      rows_.push_back(found);
    }
  }
  is_hollow_.assign(rows_.size(), false);
}

bool BlockLu::factor() {
  const double* values = local_.values.data();
  if (find_hollow_rows(values) || plan_.panels.empty()) plan();
  copy(values);
  return std::ranges::all_of(plan_.panels, [this](const auto& panel) { return eliminate(panel); });
}

// Whether others are hollow than before.
bool BlockLu::find_hollow_rows(const double* values) {
  bool changes = false;
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    const Row& row = rows_[r];
    bool hollow = row.diagonal == none || values[row.diagonal] == 0.0;
    if (hollow && row.first != none) {
      hollow =
          std::all_of(values + row.first, values + row.last, [](double v) { return v == 0.0; });
    }
    changes = changes || hollow != is_hollow_[r];
    is_hollow_[r] = hollow;
  }
  return changes;
}

void BlockLu::plan() {
  plan_ = plan_blocks(matrix_, is_hollow_);
  values_.assign(plan_.num_values, 0.0);
  least_.assign(rows_.size(), 0.0);
  exchanged_.assign(rows_.size(), 0);
  x_.assign(rows_.size(), 0.0);
  int widest = 0;
  for (const BlockPlan::Panel& panel : plan_.panels) widest = std::max(widest, panel.width);
  beside_.assign(index(widest), 0.0);
}

void BlockLu::copy(const double* values) {
  for (const auto& [begin, end] : plan_.gaps) {
    std::fill(values_.begin() + static_cast<std::ptrdiff_t>(begin),
              values_.begin() + static_cast<std::ptrdiff_t>(end), 0.0);
  }
  const auto copy_rows = [&](const BlockPlan::Copy& c, auto columns) {
    const double* source = values + c.source;
    double* target = values_.data() + c.target;
    for (int i = 0; i < c.rows; ++i, source += c.source_stride, target += c.target_stride) {
      std::copy_n(source, int{columns}, target);
    }
  };
  for (const BlockPlan::Copy& c : plan_.copies) {
    c.columns == node ? copy_rows(c, node) : copy_rows(c, c.columns);
  }
  for (std::size_t place = 0; place < least_.size(); ++place) {
    const std::size_t diagonal = rows_[index(plan_.unknown[place])].diagonal;
    least_[place] = diagonal == none ? 0.0 : rounding * std::abs(values[diagonal]);
  }
}

bool BlockLu::eliminate(const BlockPlan::Panel& panel) {
  if (!(panel.size == node ? factor_panel(panel, node) : factor_panel(panel, panel.size))) {
    return false;
  }
  const auto number = static_cast<std::size_t>(&panel - plan_.panels.data());
  update(panel, number == 0 ? 0 : plan_.panels[number - 1].updates);
  return true;
}

// Puts D^-1 U in the place of U.
template <class Size>
bool BlockLu::factor_panel(const BlockPlan::Panel& panel, Size size) {
  double* D = values_.data() + panel.pivot;
  double* U = D + panel.size;
  const int stride = panel.stride();
  int* exchanged = exchanged_.data() + panel.first;
  if (!factor_block(D, stride, size, least_.data() + panel.first, exchanged)) return false;
  if (panel.width == node) {
    solve_block(D, stride, size, exchanged, U, stride, node);
  } else {
    solve_block(D, stride, size, exchanged, U, stride, panel.width);
  }
  return true;
}

void BlockLu::update(const BlockPlan::Panel& panel, std::size_t from) {
  double* v = values_.data();
  const int stride = panel.stride();
  for (std::size_t k = from; k < panel.updates; ++k) {
    const BlockPlan::Update& u = plan_.updates[k];
    const double* L = v + u.below;
    const double* V = v + u.beside;
    double* target = v + u.target;
    if (panel.size == node && u.rows == node && u.columns == node) {
      subtract_product(L, V, stride, target, u.stride, node, node, node);
    } else if (panel.size == node) {
      subtract_product(L, V, stride, target, u.stride, u.rows, node, u.columns);
    } else {
      subtract_product(L, V, stride, target, u.stride, u.rows, panel.size, u.columns);
    }
  }
}

void BlockLu::solve(std::span<double> x) {
  for (std::size_t place = 0; place < x_.size(); ++place) {
    x_[place] = x[index(plan_.unknown[place])];
  }
  const double* v = values_.data();
  for (const BlockPlan::Panel& panel : plan_.panels) {
    double* mine = x_.data() + panel.first;
    const int* beside = plan_.beside.data() + panel.beside;
    solve_block(v + panel.pivot, panel.stride(), panel.size, exchanged_.data() + panel.first, mine,
                1, Fixed<1>());
    const double* L = v + panel.below;
    for (int i = 0; i < panel.width; ++i, L += panel.size) {
      double sum = 0.0;
      for (int k = 0; k < panel.size; ++k) sum += L[k] * mine[k];
      x_[index(beside[i])] -= sum;
    }
  }
  for (auto panel = plan_.panels.rbegin(); panel != plan_.panels.rend(); ++panel) {
    double* mine = x_.data() + panel->first;
    const int* beside = plan_.beside.data() + panel->beside;
    for (int k = 0; k < panel->width; ++k) beside_[index(k)] = x_[index(beside[k])];
    const double* V = v + panel->pivot + panel->size;
    for (int i = 0; i < panel->size; ++i, V += panel->stride()) {
      double sum = 0.0;
      for (int k = 0; k < panel->width; ++k) sum += V[k] * beside_[index(k)];
      mine[i] -= sum;
    }
  }
  for (std::size_t place = 0; place < x_.size(); ++place) {
    x[index(plan_.unknown[place])] = x_[place];
  }
}

// Rows and columns are in the same order, so that only exchanges inside blocks change the sign.
Determinant BlockLu::determinant() const {
  Determinant d{1, 0.0};
  for (const BlockPlan::Panel& panel : plan_.panels) {
    for (int i = 0; i < panel.size; ++i) {
      const double reciprocal = values_[panel.pivot + index(i) * index(panel.stride() + 1)];
      if ((reciprocal < 0.0) != (exchanged_[index(panel.first + i)] != i)) d.sign = -d.sign;
      d.log_size -= std::log(std::abs(reciprocal));
    }
  }
  return d;
}

}  // namespace culm::solver
