/// The ranks that work together.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace culm::parallel {

/// A group of MPI ranks. Rank 0 is the root of all gathers and broadcasts. A value type: copies
/// refer to the same group. One rank alone does without MPI in all but handle().
class Comm {
 public:
  /// All processes that were launched together; this one where MPI is not running, which a
  /// launched process sees to (MpiSession).
  Comm();
  /// Starts MPI, unless it is running.
  explicit Comm(MPI_Comm comm);

  int rank() const { return rank_; }
  int size() const { return size_; }
  bool is_root() const { return rank_ == 0; }
  /// Starts MPI, unless it is running.
  MPI_Comm handle() const;
  /// How many share the memory of one machine: of all machines the most. Collective.
  int most_on_a_machine() const;

  /// Largest value over all ranks; exact, hence independent of their number.
  double max(double value) const;
  int max(int value) const;
  /// Elementwise, in place.
  void max(std::span<double> values) const;
  double sum(double value) const;
  /// Elementwise, in place.
  void sum(std::span<double> values) const;
  /// Of checksums, which wrap around.
  std::uint64_t wrapping_sum(std::uint64_t value) const;

  /// Waits for the root, which may be with another program for long, and leaves the processor to
  /// others meanwhile: in all other calls here, as in MPI's own, a rank that waits keeps it busy.
  void await_root() const;

  /// Text of the root on all ranks.
  std::string broadcast(std::string text) const;
  void broadcast(std::span<double> values) const;
  void broadcast(std::span<std::uint64_t> values) const;

  /// Pieces of all ranks one after the other, on the root; empty elsewhere.
  std::vector<int> gather(std::span<const int> piece) const;
  std::vector<long long> gather(std::span<const long long> piece) const;
  std::vector<double> gather(std::span<const double> piece) const;
  /// The same without all of them in memory at once: take(rank, piece) is called on the root, rank
  /// after rank.
  void gather(std::span<const double> piece,
              const std::function<void(int, std::span<const double>)>& take) const;

 private:
  MPI_Comm comm_ = MPI_COMM_NULL;  // null: this process, without MPI
  int rank_ = 0;
  int size_ = 1;
};

/// Moves numbers between the pieces of all ranks and one array on the root, with counts that are
/// exchanged once. On one rank nothing is copied more than once.
class Funnel {
 public:
  Funnel() = default;
  /// @param count length of this rank's piece
  Funnel(const Comm& comm, int count);

  /// Length of the whole array; on the root.
  int total() const { return total_; }
  /// Pieces one after the other into `whole` (root only).
  void gather(std::span<const double> piece, std::span<double> whole) const;
  /// The reverse.
  void scatter(std::span<const double> whole, std::span<double> piece) const;

 private:
  MPI_Comm comm_ = MPI_COMM_NULL;  // of several
  int count_ = 0;
  int total_ = 0;
  std::vector<int> counts_;
  std::vector<int> starts_;
};

}  // namespace culm::parallel
