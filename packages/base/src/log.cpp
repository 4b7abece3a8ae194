#include <culm/base/log.hpp>

#include <spdlog/logger.h>
#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/sinks/stdout_sinks.h>

namespace culm {
namespace {

spdlog::level::level_enum threshold(LogLevel level, int rank) {
  if (rank != 0) return spdlog::level::off;
  switch (level) {
    case LogLevel::debug:
      return spdlog::level::debug;
    case LogLevel::info:
      return spdlog::level::info;
    case LogLevel::quiet:
      return spdlog::level::warn;
  }
  return spdlog::level::info;
}

spdlog::logger make_logger(spdlog::sink_ptr sink, const char* pattern, LogLevel level, int rank) {
  sink->set_pattern(pattern);
  spdlog::logger logger("culm", std::move(sink));
  logger.set_level(threshold(level, rank));
  // A run that is killed must not take its last lines with it.
  logger.flush_on(spdlog::level::debug);
  return logger;
}

constexpr const char* plain = "%v";
constexpr const char* with_level = "%l: %v";

}  // namespace

/// Loggers by destination and layout; spdlog's global registry stays out of it.
struct Log::Sinks {
  spdlog::logger messages;
  spdlog::logger details;
  spdlog::logger alarms;
};

Log::Log(LogLevel level, int rank)
    : sinks_(std::make_shared<Sinks>(Sinks{
          make_logger(std::make_shared<spdlog::sinks::stdout_sink_mt>(), plain, level, rank),
          make_logger(std::make_shared<spdlog::sinks::stdout_sink_mt>(), with_level, level, rank),
          make_logger(std::make_shared<spdlog::sinks::stderr_sink_mt>(), with_level, level,
                      rank)})) {}

Log::Log(std::ostream& stream, LogLevel level, int rank)
    : sinks_(std::make_shared<Sinks>(Sinks{
          make_logger(std::make_shared<spdlog::sinks::ostream_sink_mt>(stream), plain, level, rank),
          make_logger(std::make_shared<spdlog::sinks::ostream_sink_mt>(stream), with_level, level,
                      rank),
          make_logger(std::make_shared<spdlog::sinks::ostream_sink_mt>(stream), with_level, level,
                      rank)})) {}

void Log::debug(std::string_view message) const { sinks_->details.debug(message); }
void Log::info(std::string_view message) const { sinks_->messages.info(message); }
void Log::warning(std::string_view message) const { sinks_->alarms.warn(message); }
void Log::error(std::string_view message) const { sinks_->alarms.error(message); }
bool Log::shows_debug() const { return sinks_->details.should_log(spdlog::level::debug); }

}  // namespace culm
