#include "mumps.hpp"

#include <culm/base/error.hpp>

#include <Teuchos_BLAS.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <utility>
#include <vector>

namespace culm::solver {
namespace {

// Names as in the users' guide, which counts from 1.
enum Control {
  error_output = 1,
  diagnostic_output = 2,
  global_output = 3,
  verbosity = 4,
  ordering = 7,
  root_on_one_rank = 13,
  workspace_increase = 14,  // per cent of the estimate
  distribution = 18,
  schur_complement = 19,
  null_pivots = 24,
  half_of_solution = 26,
  analysis = 28,
  determinant_wanted = 33,
};
enum Info {
  status = 1,
  status_detail = 2,
  negative_pivot_count = 12,
  replaced_pivot_count = 25,
  null_pivot_count = 28,
  determinant_exponent = 34,  // of two
};
enum LocalInfo {
  workspace_foreseen = 8,  // entries; less than zero: millions
};
constexpr int determinant_mantissa = 12;  // in RINFOG

constexpr int largest_workspace_increase = 10000;

MUMPS_INT& control(DMUMPS_STRUC_C& mumps, Control which) { return mumps.icntl[which - 1]; }
MUMPS_INT info(const DMUMPS_STRUC_C& mumps, Info which) { return mumps.infog[which - 1]; }
MUMPS_INT local_info(const DMUMPS_STRUC_C& mumps, LocalInfo which) { return mumps.info[which - 1]; }

// OpenBLAS keeps 128 MB of addresses for its products, and asks for them again and again, for ever,
// where the system refuses: they are had before other memory is taken, or none is.
void hold_buffer_of_blas() {
  constexpr std::size_t buffer = (std::size_t{1} << 27) + (std::size_t{1} << 20);
  ::operator delete(::operator new(buffer));
  constexpr int n = 128;  // smaller ones may do without the buffer
  const std::vector<double> zeros(std::size_t{n} * n, 0.0);
  std::vector<double> product = zeros;
  Teuchos::BLAS<int, double>().GEMM(Teuchos::NO_TRANS, Teuchos::NO_TRANS, n, n, n, 1.0,
                                    zeros.data(), n, zeros.data(), n, 0.0, product.data(), n);
}

}  // namespace

Mumps::Mumps(const assembly::CrsMatrix& pattern, Symmetry symmetry, std::vector<int> place,
             const parallel::Comm& comm)
    : symmetry_(symmetry), pivots_(std::move(place)) {
  start(static_cast<int>(pattern.getGlobalNumRows()), comm);
  const auto& rows = *pattern.getRowMap();
  const auto& columns = *pattern.getColMap();
  take_pattern(
      pattern, [&](int row) { return rows.getGlobalElement(row); },
      [&](int column) { return columns.getGlobalElement(column); });
  if (symmetry == Symmetry::none) sources_ = std::vector<std::size_t>();  // {} would keep memory
}

Mumps::Mumps(const BlockRows& pattern, int kept, Symmetry symmetry, std::vector<int> place)
    : symmetry_(symmetry), pivots_(std::move(place)) {
  start(pattern.size(), parallel::Comm(MPI_COMM_SELF));
  const auto same = [](int number) { return number; };
  take_pattern(pattern, same, same);
  if (kept > 0) keep(kept);
}

void Mumps::start(int rows, const parallel::Comm& comm) {
  [[maybe_unused]] static const bool is_held = (hold_buffer_of_blas(), true);
  constexpr int unsymmetric = 0;
  constexpr int symmetric_indefinite = 2;
  mumps_.sym = symmetry_ == Symmetry::symmetric ? symmetric_indefinite : unsymmetric;
  mumps_.par = 1;  // the root works as well
  mumps_.comm_fortran = static_cast<MUMPS_INT>(MPI_Comm_c2f(comm.handle()));
  run(-1);
  for (Control stream : {error_output, diagnostic_output, global_output}) {
    control(mumps_, stream) = -1;
  }
  control(mumps_, verbosity) = 0;
  control(mumps_, analysis) = 1;  // on the root
  control(mumps_, ordering) = 1;  // ours: MUMPS of Debian has neither METIS nor Scotch
  control(mumps_, distribution) = 3;
  control(mumps_, null_pivots) = 1;
  control(mumps_, determinant_wanted) = 1;
  control(mumps_, root_on_one_rank) = 1;  // ScaLAPACK would not report null pivots
  mumps_.n = rows;
  for (MUMPS_INT& pivot : pivots_) ++pivot;
  mumps_.perm_in = pivots_.data();
}

// @param row_number, column_number  in the whole matrix, of a row and a column of the pattern
template <class RowNumber, class ColumnNumber>
void Mumps::take_pattern(const BlockRows& pattern, const RowNumber& row_number,
                         const ColumnNumber& column_number) {
  for (int row = 0; row < pattern.size(); ++row) {
    const auto number = row_number(row) + 1;
    pattern.for_entries(row, [&](int local, std::size_t source) {
      const auto column = column_number(local) + 1;
      if (symmetry_ == Symmetry::symmetric && column > number) return;
      rows_.push_back(static_cast<MUMPS_INT>(number));
      columns_.push_back(static_cast<MUMPS_INT>(column));
      sources_.push_back(source);
    });
  }
  mumps_.nnz_loc = static_cast<MUMPS_INT8>(rows_.size());
  mumps_.irn_loc = rows_.data();
  mumps_.jcn_loc = columns_.data();
}

void Mumps::keep(int rows) {
  constexpr int whole_and_by_rows = 1;
  kept_.resize(static_cast<std::size_t>(rows));
  std::iota(kept_.begin(), kept_.end(), mumps_.n - rows + 1);
  remainder_.resize(kept_.size() * kept_.size());
  reduced_.resize(kept_.size());
  control(mumps_, schur_complement) = whole_and_by_rows;
  mumps_.size_schur = rows;
  mumps_.listvar_schur = kept_.data();
  mumps_.schur = remainder_.data();
  mumps_.redrhs = reduced_.data();
  mumps_.lredrhs = rows;
}

Mumps::~Mumps() {
  mumps_.job = -2;
  dmumps_c(&mumps_);
}

void Mumps::pass_values(const BlockRows& matrix) {
  if (rows_.empty()) return;
  if (sources_.empty()) {
    // MUMPS takes the values as non-const but does not change them
    mumps_.a_loc = const_cast<double*>(matrix.values(0));
    return;
  }
  values_.resize(sources_.size());
  for (std::size_t k = 0; k < sources_.size(); ++k) values_[k] = matrix.value(sources_[k]);
  mumps_.a_loc = values_.data();
}

bool Mumps::factor(const BlockRows& matrix) {
  pass_values(matrix);
  if (!analysed_) run(1);
  if (info(mumps_, status) < 0) throw_error();
  analysed_ = true;
  factor_in_workspace();
  // pivoting may need more than the analysis foresaw
  while (has_run_out_of_workspace() &&
         control(mumps_, workspace_increase) < largest_workspace_increase) {
    control(mumps_, workspace_increase) *= 2;
    factor_in_workspace();
  }
  constexpr int singular = -10;
  if (info(mumps_, status) == singular) return false;
  if (info(mumps_, status) < 0) throw_error();
  if (symmetry_ == Symmetry::symmetric) fill_upper_triangle();
  return info(mumps_, null_pivot_count) == 0 && info(mumps_, replaced_pivot_count) == 0;
}

// Of what is left, MUMPS gives the lower one only.
void Mumps::fill_upper_triangle() {
  const std::size_t n = kept_.size();
  for (std::size_t row = 0; row < n; ++row) {
    for (std::size_t column = 0; column < row; ++column) {
      remainder_[column * n + row] = remainder_[row * n + column];
    }
  }
}

void Mumps::factor_in_workspace() {
  const auto foreseen = static_cast<double>(local_info(mumps_, workspace_foreseen));
  const double entries = (foreseen < 0.0 ? -1e6 * foreseen : foreseen) *
                         (1.0 + 0.01 * static_cast<double>(control(mumps_, workspace_increase)));
  const auto millions = static_cast<MUMPS_INT>(std::ceil(1e-6 * entries));
  if (mumps_.lwk_user != -millions) {
    workspace_.reset();
    const std::size_t bytes = static_cast<std::size_t>(millions) * 1000000 * sizeof(double);
    workspace_.reset(static_cast<double*>(std::malloc(bytes)));
    mumps_.wk_user = workspace_.get();
    // Without memory here, MUMPS asks for its own: what it then lacks it tells all ranks.
    mumps_.lwk_user = workspace_ ? -millions : 0;
  }
  run(2);
}

Determinant Mumps::determinant() const {
  const double mantissa = mumps_.rinfog[determinant_mantissa - 1];
  Determinant d{mantissa > 0.0 ? 1 : (mantissa < 0.0 ? -1 : 0),
                std::log(std::abs(mantissa)) +
                    std::log(2.0) * static_cast<double>(info(mumps_, determinant_exponent))};
  if (symmetry_ == Symmetry::symmetric) d.negative = info(mumps_, negative_pivot_count);
  return d;
}

void Mumps::solve(std::span<double> b) {
  mumps_.rhs = b.data();
  mumps_.nrhs = 1;
  mumps_.lrhs = mumps_.n;
  run(3);
  if (info(mumps_, status) < 0) throw_error();
}

void Mumps::reduce(std::span<double> x) {
  if (kept_.empty()) return;
  constexpr int reduction = 1;
  solve_half(reduction, x);
  std::ranges::copy(reduced_, x.end() - static_cast<std::ptrdiff_t>(kept_.size()));
}

void Mumps::extend(std::span<double> x) {
  if (kept_.empty()) return solve(x);
  constexpr int extension = 2;
  std::ranges::copy(x.last(kept_.size()), reduced_.begin());
  solve_half(extension, x);
}

void Mumps::solve_half(int half, std::span<double> x) {
  control(mumps_, half_of_solution) = half;
  solve(x);
  control(mumps_, half_of_solution) = 0;
}

void Mumps::run(int job) {
  mumps_.job = job;
  dmumps_c(&mumps_);
}

bool Mumps::has_run_out_of_workspace() const {
  const int error = info(mumps_, status);
  return error == -8 || error == -9 || error == -11;  // of integers, of reals, what we hand over
}

void Mumps::throw_error() const {
  constexpr int no_memory = -13;
  if (info(mumps_, status) == no_memory || has_run_out_of_workspace()) {
    throw NumericalError(
        "MUMPS needs more memory than there is to factor the matrix.\n"
        "Try: more ranks on more machines, or a coarser mesh.");
  }
  throw InternalError(fmt::format("MUMPS failed in job {}: INFOG(1) = {}, INFOG(2) = {}",
                                  mumps_.job, info(mumps_, status), info(mumps_, status_detail)));
}

}  // namespace culm::solver
