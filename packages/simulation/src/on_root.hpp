/// Work with files, which rank 0 does for all.
#pragma once

#include <culm/base/error.hpp>
#include <culm/parallel/comm.hpp>

#include <string>

namespace culm::simulation {

/// Runs `work` on rank 0; a FileError there is thrown on all ranks.
template <class Work>
void on_root(const parallel::Comm& comm, Work work) {
  std::string error;
  if (comm.is_root()) {
    try {
      work();
    } catch (const FileError& e) {
      error = e.what();
    }
  }
  if (comm.size() > 1) error = comm.broadcast(error);
  if (!error.empty()) throw FileError(error);
}

}  // namespace culm::simulation
