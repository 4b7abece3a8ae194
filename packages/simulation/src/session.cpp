#include <culm/base/freed_memory.hpp>
#include <culm/parallel/mpi_session.hpp>
#include <culm/simulation/session.hpp>

#include <Kokkos_Core.hpp>

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
  set_freed_memory(FreedMemory::given_back);
  scope_ = std::make_unique<Scope>(argv[0]);
}

Session::~Session() = default;

}  // namespace culm::simulation
