/// A program that is started as the partner of a run.
#pragma once

#include <culm/base/options.hpp>
#include <culm/parallel/comm.hpp>

#include "command.hpp"

#include <sys/types.h>

#include <atomic>
#include <memory>
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

/// Whether the partner that a command is to start comes by MPI: culm and the partner are then
/// started together, by a launcher. Throws UsageError where there is nobody to start, or several,
/// or where its rank is another one than it will have.
bool needs_launcher(const Options& deck, const PartnerArguments& arguments);

/// Starts the partner of type Socket by the command, on the root; nobody where there is none.
std::unique_ptr<PartnerProgram> start_partner(const parallel::Comm& comm, const Options& deck,
                                              const PartnerArguments& arguments);

/// Whether a line may be rewritten. Some launchers show their programs a terminal where there is
/// none.
bool is_on_terminal(const PartnerArguments& arguments);

}  // namespace culm::app
