#include <culm/analysis/velocity_rows.hpp>
#include <culm/math/fetch.hpp>
#include <culm/math/vector_units.hpp>

#include <algorithm>

namespace culm::analysis {
namespace {

// Numbers of a row, and the packs they fill.
constexpr std::size_t num_packs = 3;
constexpr std::size_t row_size = num_packs * pack_lanes;

// Numbers where they stand, without the alignment of a pack.
using LoosePack = double
    __attribute__((vector_size(pack_lanes * sizeof(double)), aligned(sizeof(double)), may_alias));

[[gnu::always_inline]] inline const LoosePack& pack_at(const double* numbers, std::size_t at) {
  return *reinterpret_cast<const LoosePack*>(numbers + at);
}

// The last nodes, with nodes that stand still up to a full row.
class LastRow {
 public:
  LastRow(const VelocityRows& rows, std::size_t first, std::size_t count) {
    rows_.num_past = rows.num_past;
    rows_.start = fill(0, rows.start + first, count);
    rows_.mean = fill(1, rows.mean + first, count);
    for (std::size_t k = 0; k < rows.num_past; ++k) {
      rows_.past[k] = fill(2 + k, rows.past[k] + first, count);
    }
  }
  const VelocityRows& rows() const { return rows_; }

 private:
  const double* fill(std::size_t i, const double* from, std::size_t count) {
    std::copy_n(from, count, numbers_[i].begin());
    return numbers_[i].data();
  }

  std::array<std::array<double, row_size>, 2 + max_past> numbers_{};
  VelocityRows rows_;
};

// Calls action(rows, first) for each row of four nodes.
template <class Action>
[[gnu::always_inline]] inline void each_row(const VelocityRows& rows, std::size_t num_nodes,
                                            Action action) {
  const std::size_t count = 6 * num_nodes;
  const std::size_t rest = count % row_size;
  for (std::size_t first = 0; first < count - rest; first += row_size) action(rows, first);
  if (rest > 0) action(LastRow(rows, count - rest, rest).rows(), 0);
}

}  // namespace

CULM_FOR_EACH_VECTOR_UNIT void compare_guesses(const VelocityRows& rows, std::size_t num_nodes,
                                               const std::array<GuessWeights, max_past>& weights,
                                               GuessErrors& errors) {
  const auto compare_row = [&](const VelocityRows& some, std::size_t first)
      __attribute__((always_inline)) {
    for (std::size_t j = 0; j < num_packs; ++j) {
      const std::size_t at = first + pack_lanes * j;
      const Pack mean = pack_at(some.mean, at);
      Pack error = pack_at(some.start, at) - mean;
      for (std::size_t k = 0; k < some.num_past; ++k) {
        fetch(some.past[k] + at + numbers_ahead, sizeof(Pack));
      }
      for (std::size_t p = 0;; ++p) {
        Pack& largest = errors[p][j];
        error = error < 0.0 ? -error : error;
        largest = error > largest ? error : largest;
        if (p == some.num_past) break;
        error = -mean;
        for (std::size_t k = 0; k <= p; ++k) error += weights[p][k] * pack_at(some.past[k], at);
      }
    }
  };
  each_row(rows, num_nodes, compare_row);
}

CULM_FOR_EACH_VECTOR_UNIT void add_changes(const VelocityRows& rows, std::size_t num_nodes,
                                           VelocityChanges& changes) {
  const auto add_row = [&](const VelocityRows& some, std::size_t first)
      __attribute__((always_inline)) {
    for (std::size_t j = 0; j < num_packs; ++j) {
      const std::size_t at = first + pack_lanes * j;
      const Pack before = pack_at(some.start, at) - pack_at(some.past[0], at);
      const Pack after = pack_at(some.mean, at) - pack_at(some.start, at);
      changes.before[j] += before * before;
      changes.after[j] += after * after;
      changes.both[j] += before * after;
    }
  };
  each_row(rows, num_nodes, add_row);
}

}  // namespace culm::analysis
