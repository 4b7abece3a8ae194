#include <culm/base/stop_signal.hpp>
#include <culm/coupling/channel.hpp>
#include <culm/coupling/frame.hpp>
#include <culm/coupling/partner_error.hpp>

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <thread>
#include <utility>
#include <vector>

namespace culm::coupling {
namespace {

using Clock = std::chrono::steady_clock;

Clock::time_point after(double seconds) {
  constexpr double forever = 1e9;  // thirty years
  return Clock::now() + std::chrono::duration_cast<Clock::duration>(
                            std::chrono::duration<double>(std::min(seconds, forever)));
}

std::string reason() { return std::strerror(errno); }

// Owns a socket.
class Socket {
 public:
  explicit Socket(int handle = -1) : handle_(handle) {}
  Socket(Socket&& other) noexcept : handle_(std::exchange(other.handle_, -1)) {}
  Socket& operator=(Socket&& other) noexcept {
    std::swap(handle_, other.handle_);
    return *this;
  }
  ~Socket() {
    if (handle_ >= 0) ::close(handle_);
  }
  int get() const { return handle_; }

 private:
  int handle_;
};

// For how long to wait at once [ms]: a signal may wake another thread.
constexpr long long slice = 200;

// @param heed  called now and then, throws where the wait is to end
// @return whether something can be read before the deadline
template <class Heed>
bool wait(int handle, Clock::time_point deadline, Heed heed) {
  for (;;) {
    heed();
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now()).count();
    if (left <= 0) return false;
    pollfd entry{handle, POLLIN, 0};
    const int found = ::poll(&entry, 1, static_cast<int>(std::min<long long>(left, slice)));
    if (found > 0) return true;
    if (found < 0 && errno != EINTR) throw PartnerError("cannot wait: " + reason());
  }
}

void stop_if_nobody_came() { stop_if_asked(0.0, "before a partner came"); }

// A partner that is quick answers before a thread has gone to sleep and been woken again.
constexpr auto wakeful = std::chrono::microseconds(50);

// A whole frame of some hundred points comes in one piece.
constexpr std::size_t ahead_size = 1U << 16U;

class SocketChannel final : public Channel {
 public:
  explicit SocketChannel(Socket socket) : socket_(std::move(socket)) {
    const int on = 1;  // frames are answered: waiting for more would cost; unix sockets refuse it
    ::setsockopt(socket_.get(), IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  }

  void send(const std::string& frame) override {
    std::size_t sent = 0;
    while (sent < frame.size()) {
      const ssize_t n =
          ::send(socket_.get(), frame.data() + sent, frame.size() - sent, MSG_NOSIGNAL);
      if (n < 0 && errno == EINTR) continue;
      if (n < 0) throw PartnerError("it is gone (" + reason() + ")");
      sent += static_cast<std::size_t>(n);
    }
  }

  std::string receive(double patience) override {
    begun_ = Clock::now();
    const auto deadline = after(patience);
    std::string frame(frame_header, '\0');
    is_in_frame_ = false;
    read(frame.data(), frame_header, deadline, patience);
    const std::uint64_t more = payload_size(frame);
    // as it comes, so that a length that is a lie takes no memory
    constexpr std::uint64_t piece = 1U << 24U;
    for (std::uint64_t done = 0; done < more;) {
      const std::uint64_t next = std::min(piece, more - done);
      frame.resize(frame_header + done + next);
      read(frame.data() + frame_header + done, next, deadline, patience);
      done += next;
    }
    return frame;
  }

 private:
  void read(char* to, std::size_t size, Clock::time_point deadline, double patience) {
    while (size > 0) {
      if (ahead_begin_ == ahead_end_ && size < ahead_size) {
        ahead_end_ = fetch(ahead_.data(), ahead_size, deadline, patience);
        ahead_begin_ = 0;
      }
      std::size_t n = std::min(size, ahead_end_ - ahead_begin_);
      if (n > 0) {
        std::memcpy(to, ahead_.data() + ahead_begin_, n);
        ahead_begin_ += n;
      } else {
        n = fetch(to, size, deadline, patience);
      }
      to += n;
      size -= n;
      is_in_frame_ = true;
    }
  }

  // What is there, at least one byte.
  std::size_t fetch(char* to, std::size_t size, Clock::time_point deadline, double patience) {
    const auto sleep = std::min(Clock::now() + wakeful, deadline);
    const auto heed = [this] {
      heed_signal(std::chrono::duration<double>(Clock::now() - begun_).count());
    };
    for (;;) {
      const ssize_t n = ::recv(socket_.get(), to, size, MSG_DONTWAIT);
      if (n > 0) return static_cast<std::size_t>(n);
      if (n == 0) {
        throw PartnerError(is_in_frame_ ? "it is gone in the middle of a frame"
                                        : "it is gone without a word");
      }
      if (errno == EINTR) continue;
      if (errno != EAGAIN && errno != EWOULDBLOCK) {
        throw PartnerError("it is gone (" + reason() + ")");
      }
      if (Clock::now() < sleep) {
        std::this_thread::yield();
      } else if (!wait(socket_.get(), deadline, heed)) {
        throw PartnerError(fmt::format("it said nothing for {:g} s", patience));
      }
    }
  }

  Socket socket_;
  std::vector<char> ahead_ = std::vector<char>(ahead_size);  // read, and not yet asked for
  std::size_t ahead_begin_ = 0;
  std::size_t ahead_end_ = 0;
  bool is_in_frame_ = false;
  Clock::time_point begun_;  // to wait for the present frame
};

// A place in the network or on this machine.
struct Address {
  int family = AF_UNIX;
  sockaddr_storage storage = {};
  socklen_t length = 0;
  std::string path;  // of unix sockets

  const sockaddr* get() const { return reinterpret_cast<const sockaddr*>(&storage); }
};

[[noreturn]] void refuse(const std::string& text, const std::string& why = {}) {
  throw UsageError("'" + text + "' is no address" + (why.empty() ? why : " (" + why + ")") +
                   ": 'unix:PATH', 'tcp:PORT' or 'tcp:ADDRESS:PORT'");
}

Address unix_address(const std::string& text) {
  Address address;
  address.path = text.substr(5);
  auto* unix = reinterpret_cast<sockaddr_un*>(&address.storage);
  unix->sun_family = AF_UNIX;
  if (address.path.empty()) refuse(text);
  if (address.path.size() >= sizeof unix->sun_path) {
    refuse(text, fmt::format("a path of more than {} characters", sizeof unix->sun_path - 1));
  }
  std::memcpy(unix->sun_path, address.path.c_str(), address.path.size() + 1);
  address.length = sizeof(sockaddr_un);
  return address;
}

// Of 'tcp:PORT' or 'tcp:ADDRESS:PORT'.
std::pair<std::string, std::string> host_and_port(const std::string& text) {
  const std::string place = text.substr(4);
  const std::size_t colon = place.rfind(':');
  if (colon == std::string::npos) return {"127.0.0.1", place};
  return {place.substr(0, colon), place.substr(colon + 1)};
}

Address tcp_address(const std::string& text) {
  const auto [host, port] = host_and_port(text);
  addrinfo hints = {};
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  if (port.empty() || host.empty()) refuse(text);
  char* end = nullptr;
  const long number = std::strtol(port.c_str(), &end, 10);  // getaddrinfo takes any, modulo 65536
  if (*end == '\0' && (number < 1 || number > 65535)) refuse(text, "ports are 1 to 65535");
  const int code = ::getaddrinfo(host.c_str(), port.c_str(), &hints, &found);
  if (code != 0) refuse(text, ::gai_strerror(code));
  Address address;
  address.family = found->ai_family;
  address.length = found->ai_addrlen;
  std::memcpy(&address.storage, found->ai_addr, found->ai_addrlen);
  ::freeaddrinfo(found);
  return address;
}

Address find_address(const std::string& text) {
  if (text.starts_with("unix:")) return unix_address(text);
  if (text.starts_with("tcp:")) return tcp_address(text);
  refuse(text);
}

// What a program left behind that was killed; anything else is not ours to remove.
void remove_old_socket(const std::string& path) {
  struct stat info = {};
  if (path.empty() || ::lstat(path.c_str(), &info) != 0) return;
  if (!S_ISSOCK(info.st_mode)) throw FileError(path, "is there and is no socket");
  const Socket probe(::socket(AF_UNIX, SOCK_STREAM, 0));
  const Address address = unix_address("unix:" + path);
  if (::connect(probe.get(), address.get(), address.length) == 0) {
    throw FileError(path, "another program listens here");
  }
  ::unlink(path.c_str());
}

}  // namespace

std::string objection_to_address(const std::string& text) {
  try {
    find_address(text);
  } catch (const UsageError& error) {
    return error.what();
  }
  return {};
}

std::string complete_address(const std::string& text) {
  if (text.starts_with("unix:")) {
    return "unix:" + std::filesystem::absolute(text.substr(5)).lexically_normal().string();
  }
  const auto [host, port] = host_and_port(text);
  return "tcp:" + host + ":" + port;
}

std::unique_ptr<Channel> listen(const std::string& text, double patience) {
  const Address address = find_address(text);
  remove_old_socket(address.path);
  const Socket door(::socket(address.family, SOCK_STREAM | SOCK_CLOEXEC, 0));
  const int on = 1;
  ::setsockopt(door.get(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  if (door.get() < 0 || ::bind(door.get(), address.get(), address.length) != 0 ||
      ::listen(door.get(), 1) != 0) {
    throw FileError(text, "cannot be listened to: " + reason());
  }
  const bool came = wait(door.get(), after(patience), stop_if_nobody_came);
  Socket guest(came ? ::accept4(door.get(), nullptr, nullptr, SOCK_CLOEXEC) : -1);
  if (!address.path.empty()) ::unlink(address.path.c_str());  // one guest, and no second one
  if (guest.get() < 0) {
    throw PartnerError(fmt::format("nobody came to '{}' for {:g} s", text, patience));
  }
  return std::make_unique<SocketChannel>(std::move(guest));
}

std::unique_ptr<Channel> connect(const std::string& text, double patience) {
  const Address address = find_address(text);
  const auto deadline = after(patience);
  do {
    stop_if_nobody_came();
    Socket socket(::socket(address.family, SOCK_STREAM | SOCK_CLOEXEC, 0));
    if (::connect(socket.get(), address.get(), address.length) == 0) {
      return std::make_unique<SocketChannel>(std::move(socket));
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  } while (Clock::now() < deadline);
  throw PartnerError(fmt::format("nobody listens at '{}' ({})", text, reason()));
}

}  // namespace culm::coupling
