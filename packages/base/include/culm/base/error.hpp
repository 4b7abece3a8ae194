#pragma once

#include <culm/base/issue.hpp>
#include <culm/base/nearest.hpp>

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace culm {

/// Root of everything culm throws. The exit code is what the program returns to the shell.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
  virtual int exit_code() const noexcept = 0;
};

/// A bug in culm itself. The text says so and asks for a report.
class InternalError final : public Error {
 public:
  // The built-ins, because clang 14 has no std::source_location.
  explicit InternalError(std::string_view text, const char* file = __builtin_FILE(),
                         int line = __builtin_LINE());
  int exit_code() const noexcept override { return 1; }
};

/// The command line is wrong.
class UsageError final : public Error {
 public:
  using Error::Error;
  int exit_code() const noexcept override { return 2; }
};

/// The deck is wrong. what() has one line per issue.
class InputError final : public Error {
 public:
  explicit InputError(std::vector<InputIssue> issues);
  InputError(Where where, std::string message);
  int exit_code() const noexcept override { return 3; }
  const std::vector<InputIssue>& issues() const noexcept { return issues_; }

 private:
  std::vector<InputIssue> issues_;
};

/// A sound deck did not solve: no convergence, singular matrix. The text carries the post-mortem.
class NumericalError final : public Error {
 public:
  using Error::Error;
  int exit_code() const noexcept override { return 4; }
};

/// NaN or infinity appeared. The text says where.
class NonFiniteError final : public Error {
 public:
  using Error::Error;
  int exit_code() const noexcept override { return 5; }
};

/// A file could not be read or written.
class FileError final : public Error {
 public:
  using Error::Error;
  FileError(const std::string& path, const std::string& message) : Error(path + ": " + message) {}
  int exit_code() const noexcept override { return 6; }
};

/// A signal or the end of the time allowed stopped a run before its end. The text says how to go
/// on.
class Stopped final : public Error {
 public:
  using Error::Error;
  int exit_code() const noexcept override { return 7; }
};

/// Throws InternalError with the caller's file and line if `condition` is false; in every build.
inline void internal_check(bool condition, std::string_view text,
                           const char* file = __builtin_FILE(), int line = __builtin_LINE()) {
  if (!condition) throw InternalError(text, file, line);
}

}  // namespace culm

/// Checks an assumption of our own code in debug builds; throws InternalError. In other builds the
/// condition is compiled, so that it does not rot, but never evaluated.
#ifdef NDEBUG
#define CULM_ASSERT(condition) ((void)sizeof(!(condition)))
#else
#define CULM_ASSERT(condition) ::culm::internal_check(static_cast<bool>(condition), #condition)
#endif
