/// Lists of numbers from each rank to each other one.
#pragma once

#include <culm/parallel/comm.hpp>

#include <mpi.h>

#include <algorithm>
#include <numeric>
#include <vector>

namespace culm::solver {

/// One list for each rank, or from each.
template <class T>
using ByRank = std::vector<std::vector<T>>;

inline MPI_Datatype mpi_type(int) { return MPI_INT; }
inline MPI_Datatype mpi_type(long long) { return MPI_LONG_LONG; }
inline MPI_Datatype mpi_type(double) { return MPI_DOUBLE; }

/// What the other ranks send to this one, by their number. Collective.
template <class T>
ByRank<T> exchange_lists(const ByRank<T>& out, const parallel::Comm& comm) {
  const auto ranks = static_cast<std::size_t>(comm.size());
  if (ranks == 1) return out;
  std::vector<int> send_counts(ranks), counts(ranks), send_starts(ranks), starts(ranks);
  for (std::size_t r = 0; r < ranks; ++r) send_counts[r] = static_cast<int>(out[r].size());
  MPI_Alltoall(send_counts.data(), 1, MPI_INT, counts.data(), 1, MPI_INT, comm.handle());
  std::exclusive_scan(send_counts.begin(), send_counts.end(), send_starts.begin(), 0);
  std::exclusive_scan(counts.begin(), counts.end(), starts.begin(), 0);
  std::vector<T> sent;
  for (const auto& list : out) sent.insert(sent.end(), list.begin(), list.end());
  std::vector<T> got(static_cast<std::size_t>(starts.back() + counts.back()));
  MPI_Alltoallv(sent.data(), send_counts.data(), send_starts.data(), mpi_type(T{}), got.data(),
                counts.data(), starts.data(), mpi_type(T{}), comm.handle());
  ByRank<T> in(ranks);
  for (std::size_t r = 0; r < ranks; ++r) {
    in[r].assign(got.begin() + starts[r], got.begin() + starts[r] + counts[r]);
  }
  return in;
}

/// Where the numbers of each rank begin if they are counted rank after rank, and the end.
inline std::vector<long long> count_by_rank(long long mine, const parallel::Comm& comm) {
  const ByRank<long long> out(static_cast<std::size_t>(comm.size()), {mine});
  std::vector<long long> begin{0};
  for (const auto& count : exchange_lists(out, comm)) begin.push_back(begin.back() + count.front());
  return begin;
}

/// The rank to which a number belongs that is counted in this way.
inline std::size_t owner_of(long long number, const std::vector<long long>& begin) {
  return static_cast<std::size_t>(std::upper_bound(begin.begin(), begin.end(), number) -
                                  begin.begin() - 1);
}

}  // namespace culm::solver
