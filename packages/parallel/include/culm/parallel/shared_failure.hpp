/// Errors that one rank has alone.
#pragma once

#include <culm/base/error.hpp>
#include <culm/parallel/comm.hpp>

#include <exception>

namespace culm::parallel {

/// What fails on some ranks only, as equations do that a rank has for itself, so that all ranks end
/// it alike: nobody waits for one that is gone, and last results can still be written.
class SharedFailure {
 public:
  /// Does some work, and keeps the error that it ends with. Bugs are thrown at once.
  template <class Work>
  void watch(const Work& work) {
    try {
      work();
    } catch (const InternalError&) {
      throw;
    } catch (const Error&) {
      failure_ = std::current_exception();
    }
  }

  /// Whether this rank has failed.
  bool is_here() const { return failure_ != nullptr; }
  /// Throws the error of the lowest rank that has one, on all ranks. Collective. @pre one has
  [[noreturn]] void throw_everywhere(const Comm& comm) const;

 private:
  std::exception_ptr failure_;
};

/// Does some work that may fail on some ranks only; then all throw the error of the lowest of them.
/// Collective.
template <class Work>
void together(const Comm& comm, const Work& work) {
  if (comm.size() == 1) return work();
  SharedFailure failure;
  failure.watch(work);
  if (comm.max(failure.is_here() ? 1 : 0) != 0) failure.throw_everywhere(comm);
}

}  // namespace culm::parallel
