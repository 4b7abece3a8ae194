/// A program that is started as the partner of a run.
#pragma once

#include <sys/types.h>

#include <atomic>
#include <string>
#include <thread>

namespace culm::app {

/// Runs as long as this object lives. If it ends before it has come to the address, whoever listens
/// there is told so at once.
class PartnerProgram {
 public:
  /// @param command  for the shell
  /// @param address  where culm will listen
  /// Throws FileError where no process can be started.
  PartnerProgram(std::string command, std::string address);
  PartnerProgram(const PartnerProgram&) = delete;
  PartnerProgram& operator=(const PartnerProgram&) = delete;
  /// Waits some seconds until it has ended by itself, as after culm's last word, then ends it.
  ~PartnerProgram();

 private:
  void watch();
  bool has_ended();
  void tell(const std::string& why) const;

  std::string command_;
  std::string address_;
  pid_t process_;
  int status_ = 0;
  std::atomic<bool> run_is_over_ = false;
  std::thread watcher_;
};

}  // namespace culm::app
