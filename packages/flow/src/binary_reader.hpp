/// Binary files, value by value.
#pragma once

#include <culm/base/error.hpp>

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <utility>

namespace culm::flow {

// files are little endian, and are copied as they are
static_assert(std::endian::native == std::endian::little);

/// Takes values one after the other, and refuses what cannot be with the path of the file.
class BinaryReader {
 public:
  BinaryReader(const std::string& bytes, std::string path)
      : bytes_(bytes), path_(std::move(path)) {}

  template <class Number>
  Number take() {
    need(sizeof(Number));
    Number number;
    std::memcpy(&number, bytes_.data() + at_, sizeof(Number));
    at_ += sizeof(Number);
    return number;
  }
  void skip(std::size_t bytes) {
    need(bytes);
    at_ += bytes;
  }
  std::size_t left() const { return bytes_.size() - at_; }
  [[noreturn]] void fail(const std::string& what) const { throw InputError({path_, 0, {}}, what); }

  int count(const char* what, int least) {
    const auto number = take<std::int32_t>();
    if (number < least) fail(fmt::format("{} must be at least {}, got {}", what, least, number));
    return number;
  }
  double positive(const char* what) {
    const double number = finite(what);
    if (number <= 0.0) fail(fmt::format("{} must be > 0, got {:g}", what, number));
    return number;
  }
  // A number that must not be infinite or not a number.
  double finite(const char* what) {
    const auto number = static_cast<double>(take<float>());
    if (!std::isfinite(number)) fail(fmt::format("{} is not a number", what));
    return number;
  }

 private:
  void need(std::size_t bytes) const {
    if (bytes > left())
      fail(fmt::format("ends in its header, after {} bytes: it is truncated", bytes_.size()));
  }

  const std::string& bytes_;
  std::string path_;
  std::size_t at_ = 0;
};

}  // namespace culm::flow
