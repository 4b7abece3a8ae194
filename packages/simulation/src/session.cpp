#include <culm/model/coordinates.hpp>
#include <culm/parallel/comm.hpp>
#include <culm/parallel/mpi_session.hpp>
#include <culm/simulation/session.hpp>

#include <Kokkos_Core.hpp>
#include <malloc.h>

#include <array>

namespace culm::simulation {

struct Session::Scope {
  // Kokkos gets no arguments: it would add its own help to ours, and options nobody documents.
  explicit Scope(char* program) : arguments{program, nullptr}, kokkos(count, values) {}
  int count = 1;
  std::array<char*, 2> arguments;
  char** values = arguments.data();
  parallel::MpiSession mpi;
  Kokkos::ScopeGuard kokkos;
};

Session::Session(int& /*argc*/, char**& argv) {
  // keeps the factors of a direct solver from going back to the system after every iteration
  mallopt(M_MMAP_THRESHOLD, 32 << 20);
  mallopt(M_TRIM_THRESHOLD, 64 << 20);
  scope_ = std::make_unique<Scope>(argv[0]);
  model::Coordinates::expect_all(parallel::Comm().size() == 1);
}

Session::~Session() = default;

}  // namespace culm::simulation
