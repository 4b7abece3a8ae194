/// Work with files, which rank 0 does for all.
#pragma once

#include <culm/base/error.hpp>
#include <culm/parallel/comm.hpp>

#include <filesystem>
#include <string>

namespace culm::simulation {

/// Runs `work` on rank 0; an error with files or a NonFiniteError there is thrown on all ranks.
template <class Work>
void on_root(const parallel::Comm& comm, Work work) {
  std::string error;  // after its kind
  if (comm.is_root()) {
    try {
      work();
    } catch (const FileError& e) {
      error = std::string("f") + e.what();
    } catch (const std::filesystem::filesystem_error& e) {
      error = std::string("f") + e.what();
    } catch (const NonFiniteError& e) {
      error = std::string("n") + e.what();
    }
  }
  if (comm.size() > 1) error = comm.broadcast(error);
  if (error.empty()) return;
  if (error.front() == 'f') throw FileError(error.substr(1));
  throw NonFiniteError(error.substr(1));
}

}  // namespace culm::simulation
