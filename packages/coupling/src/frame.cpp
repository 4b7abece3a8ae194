#include <culm/coupling/frame.hpp>
#include <culm/coupling/partner_error.hpp>

#include <fmt/format.h>
#include <zlib.h>

#include <array>
#include <bit>
#include <cstring>

namespace culm::coupling {
namespace {

static_assert(std::endian::native == std::endian::little, "frames are little-endian");

constexpr std::uint32_t magic = 0x4D4C5543;  // "CULM"
constexpr std::uint16_t format_version = 1;

// As it lies in memory and on the wire.
struct Header {
  std::uint32_t magic;
  std::uint16_t version;
  std::uint16_t kind;
  std::uint32_t window;
  std::uint32_t attempt;
  double start;
  double end;
  std::uint64_t size;
  std::uint32_t checksum;  // of all before it, and of the payload
  std::array<std::uint8_t, 20> reserved;
};
static_assert(sizeof(Header) == frame_header);
constexpr std::size_t checked = offsetof(Header, checksum);

std::uint32_t sum_of(const Header& header, std::string_view payload) {
  const auto* bytes = reinterpret_cast<const Bytef*>(&header);
  const auto* rest = reinterpret_cast<const Bytef*>(payload.data());
  return static_cast<std::uint32_t>(crc32_z(crc32_z(0, bytes, checked), rest, payload.size()));
}

Header read_header(std::string_view bytes) {
  if (bytes.size() < frame_header) throw PartnerError("what came is shorter than a frame");
  Header header;
  std::memcpy(&header, bytes.data(), frame_header);
  if (header.magic != magic) throw PartnerError("what came is no frame of culm");
  if (header.version != format_version) {
    throw PartnerError(fmt::format("the frames are of version {}, those of culm of version {}",
                                   header.version, format_version));
  }
  if (header.size > longest_payload) {
    throw PartnerError(fmt::format("a frame says that it has {} bytes", header.size));
  }
  return header;
}

}  // namespace

std::string encode(const Frame& frame) {
  Header header{magic,
                format_version,
                static_cast<std::uint16_t>(frame.kind),
                frame.window,
                frame.attempt,
                frame.start,
                frame.end,
                frame.payload.size(),
                0,
                {}};
  header.checksum = sum_of(header, frame.payload);
  std::string bytes(frame_header, '\0');
  std::memcpy(bytes.data(), &header, frame_header);
  return bytes + frame.payload;
}

std::uint64_t payload_size(std::string_view header) { return read_header(header).size; }

Frame decode(std::string_view bytes) {
  const Header header = read_header(bytes);
  bytes.remove_prefix(frame_header);
  if (bytes.size() != header.size) throw PartnerError("a frame is not as long as it says");
  if (header.checksum != sum_of(header, bytes)) throw PartnerError("a frame is damaged");
  return {static_cast<FrameKind>(header.kind),
          header.window,
          header.attempt,
          header.start,
          header.end,
          std::string(bytes)};
}

std::string_view name_of(FrameKind kind) {
  constexpr std::array<std::string_view, 20> names = {
      "nothing", "hello",   "attempt",  "answer", "accept",  "accepted",  "save",
      "saved",   "alive",   "bye",      "error",  "discard", "discarded", "fail",
      "failed",  "restore", "restored", "step",   "keep",    "kept"};
  const auto number = static_cast<std::size_t>(kind);
  return number < names.size() ? names[number] : "what is unknown";
}

void Writer::add_bytes(const void* data, std::size_t size) {
  if (size > 0) bytes_.append(static_cast<const char*>(data), size);
}

void Reader::take(void* to, std::size_t size) {
  if (rest_.size() < size) throw PartnerError("a frame holds less than it must");
  if (size > 0) std::memcpy(to, rest_.data(), size);
  rest_.remove_prefix(size);
}

std::uint32_t Reader::count() {
  std::uint32_t value = 0;
  take(&value, sizeof value);
  return value;
}

double Reader::number() {
  double value = 0.0;
  take(&value, sizeof value);
  return value;
}

std::vector<double> Reader::numbers(std::size_t count) {
  if (rest_.size() / sizeof(double) < count) {
    throw PartnerError("a frame holds less than it must");
  }
  std::vector<double> values(count);
  take(values.data(), count * sizeof(double));
  return values;
}

std::string Reader::text() {
  std::string all(rest_);
  rest_ = {};
  return all;
}

}  // namespace culm::coupling
