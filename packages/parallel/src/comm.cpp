#include <culm/parallel/comm.hpp>
#include <culm/parallel/mpi_session.hpp>
#include <culm/parallel/patience.hpp>

#include <algorithm>
#include <numeric>

namespace culm::parallel {
namespace {

template <class T>
std::vector<T> gather_pieces(MPI_Comm comm, int ranks, std::span<const T> piece,
                             MPI_Datatype type) {
  if (ranks == 1) return {piece.begin(), piece.end()};
  const int count = static_cast<int>(piece.size());
  std::vector<int> counts(static_cast<std::size_t>(ranks));
  MPI_Gather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, 0, comm);
  std::vector<int> starts(counts.size());
  std::exclusive_scan(counts.begin(), counts.end(), starts.begin(), 0);
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  const int total = rank == 0 ? std::accumulate(counts.begin(), counts.end(), 0) : 0;
  std::vector<T> whole(static_cast<std::size_t>(total));
  MPI_Gatherv(piece.data(), count, type, whole.data(), counts.data(), starts.data(), type, 0, comm);
  return whole;
}

}  // namespace

Comm::Comm() {
  if (is_mpi_running()) *this = Comm(MPI_COMM_WORLD);
}

Comm::Comm(MPI_Comm comm) : comm_(comm) {
  start_mpi();
  MPI_Comm_rank(comm_, &rank_);
  MPI_Comm_size(comm_, &size_);
}

MPI_Comm Comm::handle() const {
  if (comm_ != MPI_COMM_NULL) return comm_;
  start_mpi();
  return MPI_COMM_SELF;
}

int Comm::most_on_a_machine() const {
  if (size_ == 1) return 1;
  MPI_Comm machine = MPI_COMM_NULL;
  MPI_Comm_split_type(comm_, MPI_COMM_TYPE_SHARED, rank_, MPI_INFO_NULL, &machine);
  int here = 1;
  MPI_Comm_size(machine, &here);
  MPI_Comm_free(&machine);
  return max(here);
}

double Comm::max(double value) const {
  max(std::span(&value, 1));
  return value;
}

int Comm::max(int value) const {
  if (size_ == 1) return value;
  MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_INT, MPI_MAX, comm_);
  return value;
}

void Comm::max(std::span<double> values) const {
  if (size_ == 1) return;
  MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), MPI_DOUBLE, MPI_MAX,
                comm_);
}

double Comm::sum(double value) const {
  if (size_ == 1) return value;
  MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_DOUBLE, MPI_SUM, comm_);
  return value;
}

void Comm::sum(std::span<double> values) const {
  if (size_ == 1) return;
  MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), MPI_DOUBLE, MPI_SUM,
                comm_);
}

std::uint64_t Comm::wrapping_sum(std::uint64_t value) const {
  if (size_ == 1) return value;
  MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_UINT64_T, MPI_SUM, comm_);
  return value;
}

void Comm::await_root() const {
  if (size_ == 1) return;
  char word = 0;
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Ibcast(&word, 1, MPI_CHAR, 0, comm_, &request);
  const Patience patience;
  for (int has_come = 0;;) {
    MPI_Test(&request, &has_come, MPI_STATUS_IGNORE);
    if (has_come != 0) return;
    patience.pause();
  }
}

std::string Comm::broadcast(std::string text) const {
  if (size_ == 1) return text;
  auto length = static_cast<unsigned long long>(text.size());
  MPI_Bcast(&length, 1, MPI_UNSIGNED_LONG_LONG, 0, comm_);
  text.resize(length);
  // MPI counts with int
  constexpr std::size_t most = std::size_t{1} << 30;
  for (std::size_t from = 0; from < text.size(); from += most) {
    MPI_Bcast(text.data() + from, static_cast<int>(std::min(most, text.size() - from)), MPI_CHAR, 0,
              comm_);
  }
  return text;
}

void Comm::broadcast(std::span<double> values) const {
  if (size_ == 1) return;
  MPI_Bcast(values.data(), static_cast<int>(values.size()), MPI_DOUBLE, 0, comm_);
}

void Comm::broadcast(std::span<std::uint64_t> values) const {
  if (size_ == 1) return;
  MPI_Bcast(values.data(), static_cast<int>(values.size()), MPI_UINT64_T, 0, comm_);
}

std::vector<int> Comm::gather(std::span<const int> piece) const {
  return gather_pieces(comm_, size_, piece, MPI_INT);
}

std::vector<long long> Comm::gather(std::span<const long long> piece) const {
  return gather_pieces(comm_, size_, piece, MPI_LONG_LONG);
}

std::vector<double> Comm::gather(std::span<const double> piece) const {
  return gather_pieces(comm_, size_, piece, MPI_DOUBLE);
}

void Comm::gather(std::span<const double> piece,
                  const std::function<void(int, std::span<const double>)>& take) const {
  if (size_ == 1) {
    take(0, piece);
    return;
  }
  const int mine = static_cast<int>(piece.size());
  const std::vector<int> counts = gather(std::span<const int>(&mine, 1));
  if (!is_root()) {
    MPI_Send(piece.data(), mine, MPI_DOUBLE, 0, 0, comm_);
    return;
  }
  take(0, piece);
  std::vector<double> received;
  for (int rank = 1; rank < size_; ++rank) {
    received.resize(static_cast<std::size_t>(counts[static_cast<std::size_t>(rank)]));
    MPI_Recv(received.data(), static_cast<int>(received.size()), MPI_DOUBLE, rank, 0, comm_,
             MPI_STATUS_IGNORE);
    take(rank, received);
  }
}

Funnel::Funnel(const Comm& comm, int count)
    : comm_(comm.size() > 1 ? comm.handle() : MPI_COMM_NULL), count_(count) {
  counts_ = comm.gather(std::span<const int>(&count, 1));
  starts_.resize(counts_.size());
  std::exclusive_scan(counts_.begin(), counts_.end(), starts_.begin(), 0);
  total_ = std::accumulate(counts_.begin(), counts_.end(), 0);
}

void Funnel::gather(std::span<const double> piece, std::span<double> whole) const {
  if (comm_ == MPI_COMM_NULL) {
    std::copy_n(piece.begin(), count_, whole.begin());
    return;
  }
  MPI_Gatherv(piece.data(), count_, MPI_DOUBLE, whole.data(), counts_.data(), starts_.data(),
              MPI_DOUBLE, 0, comm_);
}

void Funnel::scatter(std::span<const double> whole, std::span<double> piece) const {
  if (comm_ == MPI_COMM_NULL) {
    std::copy_n(whole.begin(), count_, piece.begin());
    return;
  }
  MPI_Scatterv(whole.data(), counts_.data(), starts_.data(), MPI_DOUBLE, piece.data(), count_,
               MPI_DOUBLE, 0, comm_);
}

}  // namespace culm::parallel
