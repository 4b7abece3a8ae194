/// The messages of a coupling as bytes, for sockets, MPI and records. doc/developer/wire_format.md
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace culm::coupling {

enum class FrameKind : std::uint16_t {
  hello = 1,     ///< who is there; both sides
  attempt = 2,   ///< motion of a window: answer it as if for the first time
  answer = 3,    ///< loads of that attempt
  accept = 4,    ///< the window is over with this motion
  accepted = 5,  ///< energy and heat so far
  save = 6,      ///< keep what you are: the run may go on from here one day
  saved = 7,
  alive = 8,   ///< still busy
  bye = 9,     ///< the end; a reason if it is none to be glad about
  error = 10,  ///< cannot go on; the reason
  // of programs that lead, beside attempt, accept and save
  discard = 11,  ///< forget the attempt
  discarded = 12,
  fail = 13,  ///< forget it because it was not good
  failed = 14,
  restore = 15,  ///< be again what was saved
  restored = 16,
  // of records alone
  step = 17,  ///< motion in one of several steps that the structure made in a window
  // of programs that lead
  keep = 18,  ///< write a checkpoint: the run may go on from here one day
  kept = 19
};

/// One message.
struct Frame {
  FrameKind kind = FrameKind::alive;
  std::uint32_t window = 0;
  std::uint32_t attempt = 0;
  double start = 0.0;  ///< of the window [s]
  double end = 0.0;
  std::string payload = {};
};

constexpr std::size_t frame_header = 64;  ///< bytes
/// What a sane partner sends at most [B].
constexpr std::uint64_t longest_payload = 1ULL << 32U;

std::string encode(const Frame& frame);
/// Length of the payload that follows a header. Throws PartnerError for what is no header of this
/// version.
std::uint64_t payload_size(std::string_view header);
/// Throws PartnerError for what encode() has not made.
Frame decode(std::string_view bytes);

/// A name for messages.
std::string_view name_of(FrameKind kind);

/// Builds payloads.
class Writer {
 public:
  void add(std::uint32_t value) { add_bytes(&value, sizeof value); }
  void add(double value) { add_bytes(&value, sizeof value); }
  void add(std::span<const double> values) { add_bytes(values.data(), values.size_bytes()); }
  void add_text(std::string_view text) { bytes_ += text; }
  std::string take() { return std::move(bytes_); }

 private:
  void add_bytes(const void* data, std::size_t size);
  std::string bytes_;
};

/// Takes payloads apart. Throws PartnerError where they are too short.
class Reader {
 public:
  explicit Reader(std::string_view bytes) : rest_(bytes) {}
  std::uint32_t count();
  double number();
  std::vector<double> numbers(std::size_t count);
  /// All that is left.
  std::string text();
  bool is_at_end() const { return rest_.empty(); }

 private:
  void take(void* to, std::size_t size);
  std::string_view rest_;
};

}  // namespace culm::coupling
