#include "content_sum.hpp"

#include <culm/output/checksum.hpp>

#include "hdf5_read.hpp"

#include <fmt/format.h>

#include <array>

namespace culm::output {
namespace {

std::uint64_t fold(std::uint64_t sum, std::uint64_t next) {
  return (sum ^ next) * 0x100000001b3U + 1;
}

std::uint64_t fold_all(std::span<const hsize_t> shape) {
  std::uint64_t extents = shape.size();
  for (const hsize_t extent : shape) extents = fold(extents, extent);
  return extents;
}

template <class T>
std::span<const std::byte> bytes_of(const T& numbers) {
  return std::as_bytes(std::span(numbers));
}

void add_attributes(const Hdf5File& file, hid_t where, ContentSum& sum) {
  for (const std::string& name : list_attributes(file, where)) {
    switch (find_attribute_kind(file, where, name)) {
      case ContentKind::number:
        sum.add_attribute(name, bytes_of(std::array{read_double(file, where, name)}));
        break;
      case ContentKind::integer:
        sum.add_attribute(name, bytes_of(std::array{read_int(file, where, name)}));
        break;
      default:
        sum.add_attribute(name, bytes_of(joined(read_texts(file, where, name))));
    }
  }
}

void add_dataset(const Hdf5File& file, hid_t where, const std::string& name, ContentSum& sum) {
  add_attributes(file, open_dataset(file, where, name).id(), sum);
  const Shape shape = read_shape(file, where, name);
  if (holds_integers(file, where, name)) {
    sum.add_dataset(name, shape, read_ints(file, where, name));
  } else {
    sum.add_dataset(name, shape, sum_of_numbers(read_doubles(file, where, name)));
  }
}

void add_content(const Hdf5File& file, hid_t group, ContentSum& sum) {
  add_attributes(file, group, sum);
  for (const std::string& name : list_links(file, group)) {
    if (is_group(file, group, name)) {
      sum.add_group(name);
      add_content(file, open_group(file, group, name).id(), sum);
    } else {
      add_dataset(file, group, name, sum);
    }
  }
}

}  // namespace

void ContentSum::add_group(std::string_view name) { add('g', name, 0, {}); }

void ContentSum::add_dataset(std::string_view name, std::span<const hsize_t> shape,
                             std::span<const int> numbers) {
  add('i', name, fold_all(shape), std::as_bytes(numbers));
}

void ContentSum::add_dataset(std::string_view name, std::span<const hsize_t> shape,
                             std::uint64_t sum) {
  add_sum('d', name, fold_all(shape), sum);
}

void ContentSum::add_attribute(std::string_view name, std::span<const std::byte> content) {
  if (name == sum_attribute) return;
  add('a', name, 0, content);
}

void ContentSum::add(char kind, std::string_view name, std::uint64_t shape,
                     std::span<const std::byte> content) {
  add_sum(kind, name, shape, fold(content.size(), checksum(content)));
}

void ContentSum::add_sum(char kind, std::string_view name, std::uint64_t shape, std::uint64_t sum) {
  std::uint64_t item =
      fold(static_cast<unsigned char>(kind), checksum(std::as_bytes(std::span(name))));
  item = fold(fold(item, name.size()), shape);
  value_ += mix(fold(item, sum));
}

std::uint64_t chain(std::uint64_t sum, std::span<const std::byte> content) {
  return fold(sum, checksum(content));
}

std::string sum_text(std::uint64_t sum) { return fmt::format("{:016x}", sum); }

std::string joined(std::span<const std::string> texts) {
  std::string all;
  // as HDF5 stores them, to the first zero
  for (const std::string& text : texts) all.append(text.c_str()).push_back('\0');
  return all;
}

std::uint64_t sum_of_group(const Hdf5File& file, hid_t where, const std::string& name) {
  ContentSum sum;
  sum.add_group(name);
  add_content(file, open_group(file, where, name).id(), sum);
  return sum.value();
}

}  // namespace culm::output
