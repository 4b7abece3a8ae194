#include "partner_program.hpp"

#include <culm/base/error.hpp>
#include <culm/coupling/channel.hpp>
#include <culm/coupling/frame.hpp>

#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
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

// The one that --with is to start.
const Options& partner_to_start(const Options& deck) {
  const Options* found = nullptr;
  if (deck.has_list("Coupling")) {
    for (const Options& partner : deck.list("Coupling").list("Partners").entries()) {
      if (partner.text("Type") != "Socket" && partner.text("Type") != "MPI") continue;
      if (found != nullptr) throw UsageError("--with starts one partner, and the deck has several");
      found = &partner;
    }
  }
  if (found == nullptr) throw UsageError("--with needs a partner of type 'Socket' or 'MPI'");
  return *found;
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

bool needs_launcher(const Options& deck, const PartnerArguments& arguments) {
  if (arguments.partner_command.empty()) return false;
  const Options& partner = partner_to_start(deck);
  if (partner.text("Type") != "MPI") return false;
  const int rank = std::max(arguments.ranks, 1);
  if (partner.integer("Rank") == rank) return true;
  throw UsageError(fmt::format(
      "--with starts the partner '{}' after {} process{} of culm (--ranks), as rank {}; its 'Rank' "
      "is {}",
      partner.name(), rank, rank == 1 ? "" : "es", rank, partner.integer("Rank")));
}

std::unique_ptr<PartnerProgram> start_partner(const parallel::Comm& comm, const Options& deck,
                                              const PartnerArguments& arguments) {
  if (arguments.partner_command.empty()) return nullptr;
  const Options& partner = partner_to_start(deck);
  if (arguments.ranks > comm.size()) {
    throw UsageError(
        "--ranks says how many processes the launcher takes for culm beside a partner of type "
        "'MPI'; beside one of type 'Socket' start culm by mpiexec");
  }
  if (!comm.is_root()) return nullptr;
  return std::make_unique<PartnerProgram>(arguments.partner_command, partner.text("Address"));
}

bool is_on_terminal(const PartnerArguments& arguments) {
  return !arguments.plain && isatty(STDOUT_FILENO) != 0;
}

}  // namespace culm::app
