#include "substructures.hpp"

#include <culm/base/error.hpp>
#include <culm/math/types.hpp>

#include "blocks.hpp"
#include "serial_rows.hpp"

#include <Teuchos_Array.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace culm::solver {
namespace {

using assembly::CrsMatrix;
using assembly::GlobalIndex;
using assembly::Vector;

constexpr const char* symmetric_pattern = "substructures need a symmetric pattern";

std::span<double> values_of(const CrsMatrix& matrix) {
  const auto values = matrix.getLocalMatrixHost().values;
  return {values.data(), values.extent(0)};
}

}  // namespace

Substructures::Substructures(Teuchos::RCP<const CrsMatrix> matrix, const parallel::Comm& comm,
                             int widest)
    : matrix_(std::move(matrix)), local_(matrix_->getLocalMatrixHost()), comm_(comm) {
  const std::vector<int> owners = owners_of_columns();
  const std::vector<bool> is_interface = find_interface(owners);
  find_rows(is_interface);
  interface_size_ = static_cast<int>(comm.sum(static_cast<double>(boundary_.size())));
  if (interface_size_ > widest) return;
  build_piece(owners, is_interface);
  build_interface(is_interface);
}

// @param visit (column, place of the value)
template <class Visit>
void Substructures::for_entries(int row, const Visit& visit) const {
  const auto& graph = local_.graph;
  for (auto k = graph.row_map(index(row)); k < graph.row_map(index(row) + 1); ++k) {
    visit(graph.entries(k), static_cast<std::size_t>(k));
  }
}

// By global numbers.
std::size_t Substructures::find_entry(long long row, long long column) const {
  const int wanted = matrix_->getColMap()->getLocalElement(column);
  std::size_t found = 0;
  bool is_there = false;
  for_entries(matrix_->getRowMap()->getLocalElement(row), [&](int here, std::size_t place) {
    if (here != wanted) return;
    found = place;
    is_there = true;
  });
  internal_check(is_there, symmetric_pattern);
  return found;
}

std::vector<int> Substructures::owners_of_columns() const {
  const auto ids = matrix_->getColMap()->getNodeElementList();
  Teuchos::Array<int> owners(ids.size());
  matrix_->getRowMap()->getRemoteIndexList(ids, owners());
  return {owners.begin(), owners.end()};
}

// Of each local column.
std::vector<bool> Substructures::find_interface(const std::vector<int>& owners) const {
  Vector rows(assembly::rows_of(matrix_->getRowMap()));
  for (std::size_t row = 0; row < rows.values().size(); ++row) {
    for_entries(static_cast<int>(row), [&](int column, std::size_t) {
      if (owners[index(column)] < comm_.rank()) rows.values()[row] = 1.0;
    });
  }
  add_followers(rows.values());
  Vector columns(assembly::rows_of(matrix_->getColMap()));
  const auto importer = matrix_->getGraph()->getImporter();
  if (importer.is_null()) {
    columns = std::move(rows);
  } else {
    assembly::tpetra(columns).doImport(assembly::tpetra(rows), *importer, Tpetra::INSERT);
  }
  const auto values = columns.values();
  return {values.begin(), values.end()};
}

// What meets one node of this rank and nothing else, as the forces that keep its directors rigid,
// has no pivots without it. @param is_interface  of each row, 0 or 1
void Substructures::add_followers(std::span<double> is_interface) const {
  const Blocks blocks = find_blocks(BlockRows(*matrix_));
  const std::vector<int> block_of = block_of_row(blocks);
  constexpr int none = -1, several = -2;
  int row = 0;
  auto column = blocks.columns.begin();
  for (int b = 0; b < static_cast<int>(blocks.sizes.size()); ++b) {
    int leader = none;  // the first row of the only block that this one meets
    for (int k = 0; k < blocks.widths[index(b)]; ++k, ++column) {
      const int met = matrix_->getRowMap()->getLocalElement(
          matrix_->getColMap()->getGlobalElement(static_cast<int>(*column)));
      if (met >= 0 && block_of[index(met)] == b) continue;
      if (leader == none && met >= 0) leader = met;
      const bool is_same =
          met >= 0 && leader >= 0 && block_of[index(met)] == block_of[index(leader)];
      if (!is_same) leader = several;
    }
    const bool follows = leader >= 0 && is_interface[index(leader)] != 0.0;
    for (int i = 0; i < blocks.sizes[index(b)]; ++i, ++row) {
      if (follows) is_interface[index(row)] = 1.0;
    }
  }
}

// Of this rank, those of the interface and those of the interior.
void Substructures::find_rows(const std::vector<bool>& is_interface) {
  const auto& rows = *matrix_->getRowMap();
  const auto& columns = *matrix_->getColMap();
  piece_.place.assign(is_interface.size(), -1);
  piece_.rows.reserve(rows.getNodeNumElements());
  for (int row = 0; row < static_cast<int>(rows.getNodeNumElements()); ++row) {
    const std::size_t column = index(columns.getLocalElement(rows.getGlobalElement(row)));
    if (is_interface[column]) {
      boundary_.push_back(row);
    } else {
      piece_.place[column] = static_cast<int>(piece_.rows.size());
      piece_.rows.push_back(row);
    }
  }
}

void Substructures::build_piece(const std::vector<int>& owners,
                                const std::vector<bool>& is_interface) {
  const auto& rows = *matrix_->getRowMap();
  const auto& columns = *matrix_->getColMap();
  const std::vector<int>& interior = piece_.rows;
  std::vector<int>& place = piece_.place;
  std::vector<int> kept;  // local columns
  for (int row : interior) {
    for_entries(row, [&](int column, std::size_t) {
      if (is_interface[index(column)]) kept.push_back(column);
    });
  }
  std::ranges::sort(kept, {}, [&](int column) { return columns.getGlobalElement(column); });
  kept.erase(std::unique(kept.begin(), kept.end()), kept.end());
  for (std::size_t k = 0; k < kept.size(); ++k) {
    place[index(kept[k])] = static_cast<int>(interior.size() + k);
    kept_.push_back(columns.getGlobalElement(kept[k]));
  }

  Lists rows_below(kept.size());
  ByRank<long long> wanted(index(comm_.size()));  // row and column of each value
  std::vector<int> owner_of_wanted;
  const std::size_t from_others = values_of(*matrix_).size();  // sources above it are wanted
  for (std::size_t i = 0; i < interior.size(); ++i) {
    const GlobalIndex here = rows.getGlobalElement(interior[i]);
    for_entries(interior[i], [&](int column, std::size_t) {
      const int there = place[index(column)];
      internal_check(there >= 0, symmetric_pattern);
      if (!is_interface[index(column)]) return;
      std::vector<Entry>& below = rows_below[index(there) - interior.size()];
      const int owner = owners[index(column)];
      const GlobalIndex other = columns.getGlobalElement(column);
      if (owner == comm_.rank()) {
        below.push_back({static_cast<int>(i), find_entry(other, here)});
        return;
      }
      below.push_back({static_cast<int>(i), from_others + owner_of_wanted.size()});
      owner_of_wanted.push_back(owner);
      wanted[index(owner)].insert(wanted[index(owner)].end(), {other, here});
    });
  }
  std::vector<int> place_of_wanted(owner_of_wanted.size());
  SerialRows added;
  for (std::vector<Entry>& row : rows_below) {
    added.add(row, [&](std::size_t source, std::size_t to) {
      if (source >= from_others) {
        place_of_wanted[source - from_others] = static_cast<int>(to);
      } else {
        values_here_.emplace_back(source, to);
      }
    });
  }
  piece_.begin = added.begin();
  piece_.columns = added.columns();
  piece_.values.assign(piece_.columns.size(), 0.0);
  values_in_.resize(wanted.size());
  for (std::size_t k = 0; k < owner_of_wanted.size(); ++k) {
    values_in_[index(owner_of_wanted[k])].push_back(place_of_wanted[k]);
  }
  for (const std::vector<long long>& requests : exchange_lists(wanted, comm_)) {
    std::vector<int>& out = values_out_.emplace_back();
    for (std::size_t k = 0; k < requests.size(); k += 2) {
      out.push_back(static_cast<int>(find_entry(requests[k], requests[k + 1])));
    }
  }
}

void Substructures::build_interface(const std::vector<bool>& is_interface) {
  std::vector<long long> boundary;  // global numbers
  std::vector<long long> entries;   // row and column of each
  for (int row : boundary_) {
    boundary.push_back(matrix_->getRowMap()->getGlobalElement(row));
    for_entries(row, [&](int column, std::size_t source) {
      if (!is_interface[index(column)]) return;
      entries.push_back(boundary.back());
      entries.push_back(matrix_->getColMap()->getGlobalElement(column));
      interface_values_.push_back(source);
    });
  }
  const std::array<int, 3> mine = {static_cast<int>(kept_.size()),
                                   static_cast<int>(boundary.size()),
                                   static_cast<int>(interface_values_.size())};
  value_funnel_ = parallel::Funnel(comm_, mine[0] * mine[0] + mine[2]);
  row_funnel_ = parallel::Funnel(comm_, mine[0] + mine[1]);
  const auto counts = comm_.gather(std::span<const int>(mine));
  const auto all_kept = comm_.gather(std::span<const long long>(kept_));
  const auto all_boundary = comm_.gather(std::span<const long long>(boundary));
  const auto all_entries = comm_.gather(std::span<const long long>(entries));
  if (!comm_.is_root()) return;

  std::vector<long long> numbers = all_boundary;
  std::ranges::sort(numbers);
  const auto place = [&](long long number) {
    return static_cast<int>(std::ranges::lower_bound(numbers, number) - numbers.begin());
  };
  auto kept = all_kept.begin();
  auto bound = all_boundary.begin();
  auto entry = all_entries.begin();
  for (std::size_t k = 0; k < counts.size(); k += 3) {
    Share& share = shares_.emplace_back();
    for (int i = 0; i < counts[k]; ++i) share.kept.push_back(place(*kept++));
    for (int i = 0; i < counts[k + 2]; ++i, entry += 2) {
      share.entries.emplace_back(place(entry[0]), place(entry[1]));
    }
    row_place_.insert(row_place_.end(), share.kept.begin(), share.kept.end());
    for (int i = 0; i < counts[k + 1]; ++i) row_place_.push_back(place(*bound++));
  }
}

void Substructures::gather_values() {
  const std::span<const double> from = values_of(*matrix_);
  std::vector<double>& to = piece_.values;
  for (const auto& [source, place] : values_here_) to[place] = from[source];
  if (comm_.size() == 1) return;
  ByRank<double> out(values_out_.size());
  for (std::size_t rank = 0; rank < out.size(); ++rank) {
    for (int k : values_out_[rank]) out[rank].push_back(from[index(k)]);
  }
  const ByRank<double> in = exchange_lists(out, comm_);
  for (std::size_t rank = 0; rank < in.size(); ++rank) {
    for (std::size_t k = 0; k < in[rank].size(); ++k) to[index(values_in_[rank][k])] = in[rank][k];
  }
}

void Substructures::gather_interface(std::span<const double> remainder) {
  const std::span<const double> from = values_of(*matrix_);
  mine_of_interface_.assign(remainder.begin(), remainder.end());
  for (std::size_t k : interface_values_) mine_of_interface_.push_back(from[k]);
  of_interface_.resize(index(value_funnel_.total()));
  value_funnel_.gather(mine_of_interface_, of_interface_);
}

Determinant Substructures::join(Determinant piece,
                                const std::optional<Determinant>& interface) const {
  if (interface) {
    piece.sign *= interface->sign;
    piece.log_size += interface->log_size;
    if (piece.negative && interface->negative) {
      *piece.negative += *interface->negative;
    } else {
      piece.negative.reset();
    }
  }
  std::array<double, 4> sums = {piece.sign < 0 ? 1.0 : 0.0, piece.log_size,
                                piece.negative ? 0.0 : 1.0,
                                static_cast<double>(piece.negative.value_or(0))};
  comm_.sum(sums);
  const auto [odd, log_size, unknown, negative] = sums;
  Determinant all{std::fmod(odd, 2.0) == 0.0 ? 1 : -1, log_size};
  if (unknown == 0.0) all.negative = static_cast<int>(negative);
  return all;
}

std::string Substructures::remark() const {
  return fmt::format("factors on {} ranks, {} unknowns between them", comm_.size(),
                     interface_size_);
}

void Substructures::take(std::span<const double> b, std::span<double> piece) const {
  std::ranges::fill(piece, 0.0);
  for (std::size_t i = 0; i < piece_.rows.size(); ++i) piece[i] = b[index(piece_.rows[i])];
}

void Substructures::gather(std::span<const double> b, std::span<const double> piece,
                           std::span<double> whole) {
  const auto ends = piece.subspan(piece_.rows.size());
  mine_.assign(ends.begin(), ends.end());
  for (int row : boundary_) mine_.push_back(b[index(row)]);
  all_.resize(index(row_funnel_.total()));
  row_funnel_.gather(mine_, all_);
  std::ranges::fill(whole, 0.0);
  for (std::size_t k = 0; k < row_place_.size(); ++k) whole[index(row_place_[k])] += all_[k];
}

void Substructures::scatter(std::span<const double> whole, std::span<double> piece,
                            std::span<double> x) {
  all_.resize(index(row_funnel_.total()));
  for (std::size_t k = 0; k < row_place_.size(); ++k) all_[k] = whole[index(row_place_[k])];
  mine_.resize(kept_.size() + boundary_.size());
  row_funnel_.scatter(all_, mine_);
  const auto own = mine_.begin() + static_cast<std::ptrdiff_t>(kept_.size());
  std::copy(mine_.begin(), own, piece.begin() + static_cast<std::ptrdiff_t>(piece_.rows.size()));
  for (std::size_t k = 0; k < boundary_.size(); ++k) {
    x[index(boundary_[k])] = own[static_cast<std::ptrdiff_t>(k)];
  }
}

void Substructures::put(std::span<const double> piece, std::span<double> x) const {
  for (std::size_t i = 0; i < piece_.rows.size(); ++i) x[index(piece_.rows[i])] = piece[i];
}

}  // namespace culm::solver
