/// Checksums of what a result file says, whatever its bytes look like.
#pragma once

#include <hdf5.h>

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace culm::output {

class Hdf5File;

/// The attribute in which a group may carry its own sum.
inline constexpr const char* sum_attribute = "content_sum";

/// Adds up groups, datasets and attributes but sum_attribute; their order does not matter.
class ContentSum {
 public:
  /// A group; its content is added by itself.
  void add_group(std::string_view name);
  void add_dataset(std::string_view name, std::span<const hsize_t> shape,
                   std::span<const int> numbers);
  /// @param sum  of doubles, by sum_of_numbers()
  void add_dataset(std::string_view name, std::span<const hsize_t> shape, std::uint64_t sum);
  void add_attribute(std::string_view name, std::span<const std::byte> content);

  std::uint64_t value() const { return value_; }

 private:
  void add(char kind, std::string_view name, std::uint64_t shape,
           std::span<const std::byte> content);
  void add_sum(char kind, std::string_view name, std::uint64_t shape, std::uint64_t sum);

  std::uint64_t value_ = 0;
};

/// One after the other; here the order matters.
std::uint64_t chain(std::uint64_t sum, std::span<const std::byte> content);

/// As the attribute says it: 16 hexadecimal digits.
std::string sum_text(std::uint64_t sum);

/// Texts as bytes, each with its end.
std::string joined(std::span<const std::string> texts);

/// The sum of a group with all in it, as it was when Hdf5File wrote it. Throws FileError.
std::uint64_t sum_of_group(const Hdf5File& file, hid_t where, const std::string& name);

}  // namespace culm::output
