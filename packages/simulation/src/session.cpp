#include <culm/simulation/session.hpp>

#include <Tpetra_Core.hpp>
#include <malloc.h>

namespace culm::simulation {

struct Session::Scope {
  Scope(int& argc, char**& argv) : tpetra(&argc, &argv) {}
  Tpetra::ScopeGuard tpetra;
};

Session::Session(int& argc, char**& argv) {
  // keeps the factors of a direct solver from going back to the system after every iteration
  mallopt(M_MMAP_THRESHOLD, 32 << 20);
  mallopt(M_TRIM_THRESHOLD, 64 << 20);
  scope_ = std::make_unique<Scope>(argc, argv);
}

Session::~Session() = default;

}  // namespace culm::simulation
