#include "mpi_partner.hpp"

#include <culm/base/error.hpp>
#include <culm/coupling/partner_error.hpp>
#include <culm/coupling/remote_partner.hpp>
#include <culm/parallel/comm.hpp>
#include <culm/parallel/patience.hpp>
#include <culm/simulation/stop_request.hpp>

#include <fmt/format.h>
#include <mpi.h>
#include <unistd.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace culm::simulation {
namespace {

// One message for each frame, to a rank of all that were started together.
class MpiChannel final : public coupling::Channel {
 public:
  explicit MpiChannel(int rank) : rank_(rank) {
    const parallel::Comm launched;
    if (rank < launched.size()) return;
    throw UsageError(fmt::format(
        "the partner is rank {}, and {} processes were started; start both together: culm run DECK "
        "--with PARTNER, or mpiexec -n 1 culm run DECK --ranks 1 : -n 1 PARTNER",
        rank, launched.size()));
  }

  void send(const std::string& frame) override {
    if (frame.size() > std::numeric_limits<int>::max()) {
      throw PartnerError("a frame is too long for a message of MPI");
    }
    MPI_Send(frame.data(), static_cast<int>(frame.size()), MPI_BYTE, rank_, 0, MPI_COMM_WORLD);
  }

  std::string receive(double patience) override {
    const parallel::Patience wait;
    bool listens = false;
    MPI_Status status;
    for (;;) {
      int is_there = 0;
      MPI_Iprobe(rank_, 0, MPI_COMM_WORLD, &is_there, &status);
      if (is_there != 0) break;
      if (wait.is_long() && !std::exchange(listens, true)) StopRequest::listen();
      if (StopRequest::is_ended_by(::getppid())) {
        throw PartnerError(
            "the launcher ends all its programs, as it does when one of them has died");
      }
      heed_signal(wait.waited());
      if (wait.waited() > patience) {
        throw PartnerError(fmt::format("it said nothing for {:g} s", patience));
      }
      wait.pause();
    }
    int size = 0;
    MPI_Get_count(&status, MPI_BYTE, &size);
    std::string frame(static_cast<std::size_t>(std::max(size, 0)), '\0');
    MPI_Recv(frame.data(), size, MPI_BYTE, rank_, 0, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    return frame;
  }

  // MPI is not told of threads, and its launcher ends all programs when one dies
  bool wants_signs_of_life() const override { return false; }

 private:
  int rank_;
};

}  // namespace

std::unique_ptr<coupling::Channel> open_mpi_channel(int rank) {
  return std::make_unique<MpiChannel>(rank);
}

std::unique_ptr<coupling::Channel> open_channel(const std::string& address, double patience) {
  const std::string mpi = "mpi:";
  if (!address.starts_with(mpi)) {
    return coupling::listen(address, patience);
  }
  const std::string rank = address.substr(mpi.size());
  if (rank.empty() || rank.size() > 6 ||
      rank.find_first_not_of("0123456789") != std::string::npos) {
    throw UsageError("'" + address + "' is no address: 'mpi:RANK', such as 'mpi:1'");
  }
  return open_mpi_channel(std::stoi(rank));
}

void register_mpi_partner(coupling::PartnerRegistry& registry) {
  Schema schema("MPI", "Another program in the same mpiexec, which speaks the wire format.");
  schema.add(text("Port", "Where it acts; the only port of the deck if absent.").optional())
      .add(integer("Rank", "Of the partner among all processes; those of culm come first.")
               .at_least(1));
  coupling::add_patience_fields(schema);
  registry.add("MPI", std::move(schema), [](const Options& o) {
    return coupling::make_remote_partner(
        o, [rank = o.integer("Rank")] { return open_mpi_channel(rank); });
  });
}

}  // namespace culm::simulation
