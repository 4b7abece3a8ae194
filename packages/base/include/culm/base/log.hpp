#pragma once

#include <iosfwd>
#include <memory>
#include <string_view>

namespace culm {

/// Messages of lower rank than the chosen level are dropped; `quiet` leaves warnings and errors.
enum class LogLevel { debug, info, quiet };

/// Messages to the user. Only rank 0 prints, the others are silent: whatever is true on one rank
/// alone must be brought to rank 0 first. Copies share their destination.
class Log {
 public:
  /// Prints to standard output, warnings and errors to standard error.
  explicit Log(LogLevel level = LogLevel::info, int rank = 0);
  /// Prints everything to one stream, which must outlive the log.
  Log(std::ostream& stream, LogLevel level, int rank = 0);

  /// Details for developers.
  void debug(std::string_view message) const;
  /// Progress and results; without prefix.
  void info(std::string_view message) const;
  /// Something is probably not meant: "warning: …".
  void warning(std::string_view message) const;
  /// The run cannot go on: "error: …".
  void error(std::string_view message) const;

  /// Whether debug messages are printed; to skip composing them.
  bool shows_debug() const;

 private:
  struct Sinks;
  std::shared_ptr<Sinks> sinks_;
};

}  // namespace culm
