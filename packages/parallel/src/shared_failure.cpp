#include <culm/parallel/shared_failure.hpp>

#include <string>
#include <vector>

namespace culm::parallel {
namespace {

struct Told {
  int exit_code = 0;  ///< 0 of a rank without an error
  std::string text;
};

Told tell(const std::exception_ptr& failure) {
  try {
    if (failure) std::rethrow_exception(failure);
  } catch (const Error& error) {
    return {error.exit_code(), error.what()};
  }
  return {};
}

// Of the one rank that says something, on all.
std::string share(const std::string& text, const Comm& comm) {
  const std::vector<int> letters(text.begin(), text.end());
  const std::vector<int> gathered = comm.gather(std::span<const int>(letters));
  return comm.broadcast(std::string(gathered.begin(), gathered.end()));
}

// The type follows from the exit code.
[[noreturn]] void throw_as(int exit_code, const std::string& text) {
  switch (exit_code) {
    case 2:
      throw UsageError(text);
    case 3:
      throw InputError(Where{}, text);
    case 5:
      throw NonFiniteError(text);
    case 6:
      throw FileError(text);
    default:
      throw NumericalError(text);
  }
}

}  // namespace

void SharedFailure::throw_everywhere(const Comm& comm) const {
  if (comm.size() == 1) std::rethrow_exception(failure_);
  const Told mine = tell(failure_);
  const int first = comm.size() - comm.max(is_here() ? comm.size() - comm.rank() : 0);
  const bool speaks = comm.rank() == first;
  const int exit_code = comm.max(speaks ? mine.exit_code : 0);
  throw_as(exit_code, share(speaks ? mine.text : std::string(), comm));
}

}  // namespace culm::parallel
