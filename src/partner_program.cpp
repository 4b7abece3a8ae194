#include "partner_program.hpp"

#include <culm/base/error.hpp>
#include <culm/coupling/channel.hpp>
#include <culm/coupling/frame.hpp>

#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <utility>

namespace culm::app {
namespace {

constexpr auto pause = std::chrono::milliseconds(20);
constexpr int last_pauses = 250;  // until a program has ended that was told to

std::string outcome(int status) {
  return WIFEXITED(status) ? "ended with code " + std::to_string(WEXITSTATUS(status))
                           : "was ended by signal " + std::to_string(WTERMSIG(status));
}

}  // namespace

PartnerProgram::PartnerProgram(std::string command, std::string address)
    : command_(std::move(command)), address_(std::move(address)), process_(fork()) {
  if (process_ < 0) throw FileError(command_, "cannot be started");
  if (process_ == 0) {
    setpgid(0, 0);                     // so that it can be ended with all that it starts
    prctl(PR_SET_PDEATHSIG, SIGTERM);  // also where this program is killed
    execl("/bin/sh", "sh", "-c", command_.c_str(), nullptr);
    _exit(127);
  }
  watcher_ = std::thread([this] { watch(); });
}

PartnerProgram::~PartnerProgram() {
  run_is_over_ = true;
  watcher_.join();
}

bool PartnerProgram::has_ended() { return waitpid(process_, &status_, WNOHANG) != 0; }

void PartnerProgram::watch() {
  while (!run_is_over_) {
    if (has_ended()) {
      tell("'" + command_ + "' " + outcome(status_) + " before it came");
      return;
    }
    std::this_thread::sleep_for(pause);
  }
  for (const int signal : {0, SIGTERM, SIGKILL}) {
    if (signal != 0) kill(-process_, signal);
    for (int i = 0; i < last_pauses; ++i) {
      if (has_ended()) return;
      std::this_thread::sleep_for(pause);
    }
  }
}

// In its place. Nobody listens where it has come before: then culm notices by itself.
void PartnerProgram::tell(const std::string& why) const {
  while (!run_is_over_) {
    try {
      const auto channel = coupling::connect(address_, 0.0);
      channel->send(coupling::encode({coupling::FrameKind::error, 0, 0, 0.0, 0.0, why}));
      return;
    } catch (const Error&) {
      std::this_thread::sleep_for(pause);
    }
  }
}

}  // namespace culm::app
