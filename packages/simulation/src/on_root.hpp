/// Work with files and with other programs, which rank 0 does for all.
#pragma once

#include <culm/base/error.hpp>
#include <culm/coupling/partner_error.hpp>
#include <culm/parallel/comm.hpp>

#include <filesystem>
#include <string>

namespace culm::simulation {

/// Runs `work` on rank 0; an error that it has there with files, partners, numbers, usage or a
/// signal is thrown on all ranks.
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
    } catch (const PartnerError& e) {
      error = std::string("p") + e.what();
    } catch (const UsageError& e) {
      error = std::string("u") + e.what();
    } catch (const NonFiniteError& e) {
      error = std::string("n") + e.what();
    } catch (const Stopped& e) {
      error = std::string("s") + e.what();
    }
  }
  if (comm.size() > 1) {
    comm.await_root();
    error = comm.broadcast(error);
  }
  if (error.empty()) return;
  const std::string text = error.substr(1);
  if (error.front() == 'f') throw FileError(text);
  if (error.front() == 'p') throw PartnerError(text);
  if (error.front() == 'u') throw UsageError(text);
  if (error.front() == 's') throw Stopped(text);
  throw NonFiniteError(text);
}

}  // namespace culm::simulation
