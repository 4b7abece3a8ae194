#include "launcher.hpp"

#include <culm/base/error.hpp>
#include <culm/base/read_file.hpp>
#include <culm/base/stop_signal.hpp>
#include <culm/parallel/mpi_session.hpp>

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>

namespace culm::app {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr timespec pause = {0, 20'000'000};
constexpr auto last_grace = std::chrono::seconds(5);  // until a program has ended that was told to
// exit codes
constexpr int file_error = 6;
constexpr int failed_partner = 9;
constexpr int interrupted = 128 + SIGINT;

// Runs the partner. The signal by which culm is told to stop comes to all programs of a launcher.
// How the partner ended is kept, because a launcher may end culm before it could say so.
constexpr const char* partner_script =
    R"(trap "" USR1; (eval "$1"); code=$?; echo $code > "$2"; exit $code)";

// For files that both sides know. Gone with this object.
class TemporaryFolder {
 public:
  TemporaryFolder() : path_(fs::temp_directory_path() / "culm-XXXXXX") {
    std::string name = path_.string();
    if (mkdtemp(name.data()) == nullptr)
      throw FileError(name, "cannot be made, which --with needs");
    path_ = name;
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

// Signals are taken by waiting for them as long as this object lives.
class HeldSignals {
 public:
  HeldSignals() {
    sigemptyset(&held_);
    for (const int signal : {SIGINT, SIGTERM, SIGUSR1}) sigaddset(&held_, signal);
    sigprocmask(SIG_BLOCK, &held_, &before_);
  }
  HeldSignals(const HeldSignals&) = delete;
  HeldSignals& operator=(const HeldSignals&) = delete;
  ~HeldSignals() { give_back(); }
  void give_back() const { sigprocmask(SIG_SETMASK, &before_, nullptr); }
  // Waits for a short time. @return 0 if none came
  int next() const {
    const int signal = sigtimedwait(&held_, nullptr, &pause);
    return signal > 0 ? signal : 0;
  }

 private:
  sigset_t held_{}, before_{};
};

// The command line of the run inside, without what asks for the launcher. The page of the run is
// drawn outside.
std::vector<std::string> words_inside(const std::vector<std::string>& words) {
  std::vector<std::string> inside;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string& word = words[i];
    if (word == "--with" || word == "--ranks") {
      ++i;
    } else if (word != "--report" && !word.starts_with("--with=") &&
               !word.starts_with("--ranks=")) {
      inside.push_back(word);
    }
  }
  return inside;
}

std::vector<std::string> command_of(const Launch& launch, const fs::path& folder) {
  const std::string ranks = std::to_string(launch.ranks);
  std::vector<std::string> words = {CULM_MPIEXEC, CULM_MPIEXEC_NUMBER, ranks,
                                    fs::read_symlink("/proc/self/exe").string()};
  const std::vector<std::string> inside = words_inside(launch.words);
  words.insert(words.end(), inside.begin(), inside.end());
  words.insert(words.end(), {"--ranks", ranks, "--verdict", (folder / "verdict").string()});
  if (isatty(STDOUT_FILENO) == 0) words.emplace_back("--plain");
  words.insert(words.end(), {":", CULM_MPIEXEC_NUMBER, "1", "/bin/sh", "-c", partner_script, "sh",
                             launch.partner, (folder / "partner").string()});
  return words;
}

std::vector<char*> pointers_to(std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  for (std::string& text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  return pointers;
}

// Replaces a process that was just made. Between here and there nothing may be allocated.
[[noreturn]] void become(const std::vector<char*>& command, const std::vector<char*>& environment,
                         const HeldSignals& signals, const rlimit& memory) {
  setpgid(0, 0);                     // Ctrl-C comes to the one outside, which says it once
  prctl(PR_SET_PDEATHSIG, SIGTERM);  // also where that one is killed
  setrlimit(RLIMIT_DATA, &memory);
  for (const int signal : {SIGTERM, SIGUSR1}) ::signal(signal, SIG_DFL);  // none is for culm
  const int nothing = open("/dev/null", O_RDONLY);
  dup2(nothing, STDIN_FILENO);  // whoever is in the background must not read from a terminal
  signals.give_back();
  execve(command.front(), command.data(), environment.data());
  _exit(127);
}

// A file that tells that culm has come to the partner's MPI.
fs::path begun(const fs::path& verdict) { return verdict.string() + ".begun"; }

std::vector<pid_t> children() {
  std::vector<pid_t> found;
  std::error_code ignored;
  for (const auto& task : fs::directory_iterator("/proc/self/task", ignored)) {
    std::ifstream file(task.path() / "children");
    for (pid_t child = 0; file >> child;) found.push_back(child);
  }
  return found;
}

// Ends what a launcher left behind: it came to this process, the nearest that takes orphans.
void end_children() {
  for (int i = 0; i < 250 && waitpid(-1, nullptr, WNOHANG) >= 0; ++i) {
    for (const pid_t child : children()) kill(child, SIGKILL);
    nanosleep(&pause, nullptr);
  }
}

// Waits for the launcher, hands on signals, and ends it where it outlasts culm's last word.
// @return its exit code, or that of Ctrl-C
int wait_for(pid_t launcher, const HeldSignals& signals, const fs::path& verdict) {
  int status = 0;
  bool was_stopped = false, was_interrupted = false;
  std::optional<Clock::time_point> last_word;
  int last_signal = 0;
  std::error_code ignored;
  while (waitpid(launcher, &status, WNOHANG) == 0) {
    const int signal = signals.next();
    // launchers hand SIGUSR1 on to their programs, and end them on the others
    was_interrupted = was_interrupted || signal == SIGINT;
    if (signal == SIGINT || (signal != 0 && was_stopped)) kill(launcher, SIGTERM);
    if (signal == SIGTERM || signal == SIGUSR1) {
      if (!was_stopped) kill(launcher, SIGUSR1);
      was_stopped = true;
    }
    if (!last_word && fs::exists(verdict, ignored)) last_word = Clock::now();
    // MPI_Init of culm waits without an end for a partner that has left without its own
    const bool is_alone = fs::exists(verdict.parent_path() / "partner", ignored) &&
                          !fs::exists(begun(verdict), ignored);
    if (!last_word && is_alone) last_word = Clock::now();
    if (!last_word || Clock::now() - *last_word < last_grace) continue;
    last_signal = last_signal == 0 ? SIGTERM : SIGKILL;
    kill(launcher, last_signal);
    last_word = Clock::now();
  }
  if (was_interrupted) return interrupted;
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

std::optional<Verdict> find_verdict(const fs::path& file) {
  std::istringstream text(find_text(file).text);
  Verdict verdict;
  std::string started;
  if (!(text >> verdict.code)) return {};
  text.ignore();
  std::getline(text, started);
  verdict.started = started;
  return verdict;
}

Verdict read_verdict(const fs::path& folder, const Launch& launch, int code) {
  if (const auto said = find_verdict(folder / "verdict")) {
    if (said->code == 0 && code != 0 && code != interrupted) {
      std::fprintf(stderr, "warning: the launcher returned %d after culm was done\n", code);
    }
    return *said;
  }
  if (code == interrupted) {
    std::fprintf(stderr, "interrupted, before culm could say how far it is\n");
    return {interrupted, {}};
  }
  if (const auto partner = find_verdict(folder / "partner")) {
    std::fprintf(stderr,
                 "the partner '%s' ended with code %d, and the launcher ended culm with it before "
                 "it could say more\n",
                 launch.partner.c_str(), partner->code);
    return {failed_partner, {}};
  }
  std::fprintf(stderr,
               "culm left no exit code of its own: this one, %d, is that of the launcher, %s\n",
               code == 0 ? file_error : code, CULM_MPIEXEC);
  return {code == 0 ? file_error : code, {}};
}

}  // namespace

void tell_begin(const fs::path& verdict) {
  if (!verdict.empty()) std::ofstream(begun(verdict)) << '\n';
}

void leave_verdict(const fs::path& file, const Verdict& verdict) {
  if (file.empty()) return;
  const fs::path part = file.string() + "." + std::to_string(getpid());
  std::ofstream(part) << verdict.code << '\n' << verdict.started.string() << '\n';
  std::error_code ignored;
  fs::rename(part, file, ignored);
}

Launcher::Launcher() : is_inside_(parallel::was_launched(environ)) {
  for (const char* const* variable = environ; *variable != nullptr; ++variable) {
    environment_.emplace_back(*variable);
  }
  getrlimit(RLIMIT_DATA, &memory_);
}

Verdict Launcher::run(const Launch& launch) const {
  if (access(CULM_MPIEXEC, X_OK) != 0) {
    throw FileError(CULM_MPIEXEC, "cannot be started, which --with needs for a partner by MPI");
  }
  const TemporaryFolder folder;
  std::vector<std::string> words = command_of(launch, folder.path());
  std::vector<std::string> variables = environment_;
  const std::vector<char*> command = pointers_to(words);
  const std::vector<char*> environment = pointers_to(variables);
  prctl(PR_SET_CHILD_SUBREAPER, 1);
  const HeldSignals signals;
  stop_if_asked(0.0, "before the partner was started");
  const pid_t launcher = fork();
  if (launcher < 0) throw FileError(CULM_MPIEXEC, "cannot be started");
  if (launcher == 0) become(command, environment, signals, memory_);
  const int code = wait_for(launcher, signals, folder.path() / "verdict");
  end_children();
  return read_verdict(folder.path(), launch, code);
}

}  // namespace culm::app
