#include "survive_reading.hpp"

#include <culm/base/error.hpp>

#include <hdf5.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <string>

namespace culm::output {

void survive_reading(const std::filesystem::path& path, const std::function<void()>& read) {
  std::array<int, 2> channel{};
  if (::pipe(channel.data()) != 0) return;
  const pid_t parent = ::getpid();
  const pid_t child = ::fork();
  if (child == 0) {
    // it has the lock of the folder as well, which must not outlive who took it
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() != parent) ::_exit(0);
    for (const int signal : {SIGSEGV, SIGBUS, SIGABRT, SIGFPE}) ::signal(signal, SIG_DFL);
    const rlimit none{0, 0};
    ::setrlimit(RLIMIT_CORE, &none);
    ::close(STDERR_FILENO);
    try {
      read();
      H5garbage_collect();  // looks over memory that may be spoilt
    } catch (const std::exception& error) {
      const std::string text = error.what();
      if (::write(channel[1], text.data(), text.size()) < 0) ::abort();
    }
    ::_exit(0);
  }
  ::close(channel[1]);
  std::string text;
  std::array<char, 4096> block{};
  ssize_t count = 0;
  while (child > 0 && (count = ::read(channel[0], block.data(), block.size())) != 0) {
    if (count > 0) text.append(block.data(), static_cast<std::size_t>(count));
    if (count < 0 && errno != EINTR) break;
  }
  ::close(channel[0]);
  if (child < 0) return;
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFSIGNALED(status)) throw FileError(path.string(), "is damaged: HDF5 cannot read it");
  if (!text.empty()) throw FileError(text);
}

}  // namespace culm::output
